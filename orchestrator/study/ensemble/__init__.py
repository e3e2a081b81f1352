"""Studies: many runs of one scenario, over samples of its parameters."""
