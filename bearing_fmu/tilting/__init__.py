"""Tilting pads: each with its own film, and where that holds it."""
