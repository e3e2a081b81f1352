"""V2: the film of the aligned journal."""
