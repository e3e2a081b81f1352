"""What a run is held against: limits with their sources, and how far each is used."""
