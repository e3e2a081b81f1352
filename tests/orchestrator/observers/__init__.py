"""Tests of what watches a run."""
