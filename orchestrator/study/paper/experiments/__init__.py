"""Controlled experiments: why some published figures resist."""
