"""The interactive figures of the report: each file makes panels of results."""
