"""Tests of the bearing."""
