"""V3: the short-bearing film in closed form."""
