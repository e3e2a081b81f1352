"""The bearing as stiffness and damping."""
