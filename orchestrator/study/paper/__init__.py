"""The same scenario at every modelling depth, held against the published figures."""
