"""What the bearings stand on: pedestals, or the modes of a foundation."""
