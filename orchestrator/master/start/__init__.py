"""The start of a run: journals in their films, static equilibrium, 1X orbit."""
