"""Tests of the linear analyses."""
