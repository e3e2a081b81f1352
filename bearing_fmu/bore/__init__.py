"""The bore: the gap that it leaves to the journal."""
