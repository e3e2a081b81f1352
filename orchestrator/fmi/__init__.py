"""FMUs as files and as running units, on fmpy."""
