"""Static investigations of one bearing: where it carries a load, pressure and flow, stability."""
