"""What is varied: the study's file, its samples, and how a value gets into scenario or train."""
