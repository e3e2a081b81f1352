"""Tests of foreign and own units."""
