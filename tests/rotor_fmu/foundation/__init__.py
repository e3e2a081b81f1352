"""Tests of what the bearings stand on."""
