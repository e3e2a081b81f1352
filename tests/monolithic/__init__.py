"""The train as one system of ordinary differential equations: reference for every coupling."""
