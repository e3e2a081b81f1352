"""The reduction of the shaft, and what it costs."""
