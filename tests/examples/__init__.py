"""For readers to copy."""
