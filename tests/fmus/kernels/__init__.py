"""Compiled code of the units and of the master."""
