"""What is in a signal: spectra, orders of the speed, probes, envelopes; pure functions of arrays."""
