"""Tests of the module `bladeloss`."""
