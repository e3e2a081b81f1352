"""Tests of the FMI side."""
