"""Depth table: the film of the aligned journal, looked up."""
