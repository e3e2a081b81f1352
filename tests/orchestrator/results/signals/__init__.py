"""Tests of `orchestrator.results.signals`."""
