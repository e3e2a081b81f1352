"""From a recipe to an FMU archive."""
