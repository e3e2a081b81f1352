"""Compiled code: where it is kept, and small loops."""
