"""Linear investigations of a train on its linearised films."""
