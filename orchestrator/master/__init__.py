"""The master: units joined to a system, coupled and stepped to the end time."""
