"""Calibration of the bundled turbine train to the published figures."""
