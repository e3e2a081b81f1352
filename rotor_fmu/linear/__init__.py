"""Linear analysis of the shaft: whirl, unbalance response, what reductions cost."""
