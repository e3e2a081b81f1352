"""Marks for single cases of a test."""

import pytest


def slow(*values):
    """A case that only the longer proofs run."""
    return pytest.param(*values, marks=pytest.mark.slow)
