"""Tests of the contact."""
