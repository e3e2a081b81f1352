"""What comes out of the rows: dataset, table, sensitivities, the worst runs made again, and words."""
