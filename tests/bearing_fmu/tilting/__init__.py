"""Tests of tilting pads."""
