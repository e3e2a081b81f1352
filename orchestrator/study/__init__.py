"""Several runs of one question."""
