"""What each command does, from its options to an exit status."""
