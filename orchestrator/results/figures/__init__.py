"""Figures of a run or of several: one module a figure, matplotlib without global state.

Every function takes records (see `orchestrator.results.record_files`) and returns a
`matplotlib.figure.Figure`; `orchestrator.results.figures.write.write_figures` makes and writes all of them.
"""
