"""Tests of SSP files."""
