"""Solid contact of journal and bore."""
