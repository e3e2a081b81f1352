"""Runs: what one is, how it is carried out in processes that stay or on a cluster, and its row."""
