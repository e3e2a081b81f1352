"""Numerical kernels that the films share, and how they are compiled."""
