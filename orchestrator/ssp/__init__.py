"""System Structure and Parameterization (SSP 1.0): the train as a system that other tools open, and back."""
