"""The FMUs and the SSP in other people's tools."""
