"""The journal bearing: gap, Reynolds equation, contact, wrench and tangent, as an FMU."""
