"""Tests of the rotor's steps."""
