"""A spring with a damper as a unit: the least that has every kind of variable and a hidden state."""
