"""V1 with a mass-conserving film: rupture and reformation in time, its content as state."""
