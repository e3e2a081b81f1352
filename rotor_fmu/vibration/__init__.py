"""The vibrating shaft in time: coordinates, exact step under affine laws, energies."""
