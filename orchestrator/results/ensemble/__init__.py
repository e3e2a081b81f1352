"""Results of an ensemble of runs: its figures, what follows from them, its files."""
