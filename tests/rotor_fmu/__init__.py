"""Tests of the rotor."""
