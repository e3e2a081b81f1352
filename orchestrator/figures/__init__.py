"""Figures of a run or of several: one module a figure, matplotlib without global state.

Every function takes records (see `orchestrator.record_files`) and returns a
`matplotlib.figure.Figure`; `orchestrator.figures.write.write_figures` makes and writes all of them.
"""
