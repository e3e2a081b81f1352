"""The command line ``bladeloss``: options, their help, and how a command ends."""
