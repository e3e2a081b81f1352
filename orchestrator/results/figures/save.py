"""A figure to its files."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure


def save(figure: Figure, paths: Iterable[Path]) -> None:
    """Write a figure in the format of each name.

    Its parts get their places once: matplotlib would draw the whole figure once more for each file, only to
    find them.
    """
    FigureCanvasAgg(figure)
    layout = figure.get_layout_engine()
    if layout is not None:
        layout.execute(figure)
        figure.set_layout_engine(None)
    for path in paths:
        figure.savefig(path)
