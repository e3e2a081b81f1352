"""One case: a scenario prepared, executed and concluded, wherever it came from."""
