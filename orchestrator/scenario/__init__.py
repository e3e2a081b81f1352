"""The scenario: what is simulated, read and checked."""
