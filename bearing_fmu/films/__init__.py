"""The films: one folder a way to solve them."""
