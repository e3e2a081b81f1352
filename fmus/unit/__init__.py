"""A unit while it runs: values, state, failures, the FMI slave."""
