"""The master: system, coupling, run, record, figures and the command line ``bladeloss``."""
