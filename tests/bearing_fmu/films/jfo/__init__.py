"""Tests of the mass-conserving film."""
