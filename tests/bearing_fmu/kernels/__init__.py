"""Tests of the numerical kernels."""
