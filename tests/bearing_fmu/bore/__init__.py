"""Tests of the bore."""
