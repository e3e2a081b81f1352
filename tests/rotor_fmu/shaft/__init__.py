"""Tests of the shaft."""
