"""The report: one page that says what was run, how far to trust it, and what follows."""
