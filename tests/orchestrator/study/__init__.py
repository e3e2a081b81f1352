"""Comparing the depths, and the study of the paper."""
