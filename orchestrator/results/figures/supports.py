"""Motion of the housing of the analysed bearing, and what acts on the foundation, over time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results import quantities, statistics
from orchestrator.results.figures import panels, style
from orchestrator.results.figures.event_marks import draw_events

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_ROWS = (
    ("housing_displacement", quantities.HOUSING),
    ("foundation_force", quantities.FOUNDATION),
)


def has_supports(records: Sequence[xr.Dataset]) -> bool:
    """Whether the housings of these runs move."""
    return all(name in record for record in records for name, _ in _ROWS)


def supports(records: Sequence[xr.Dataset], bearing: str | None = None) -> Figure:
    """Draw the displacement of the housing (top) and the force on the foundation (bottom) of one bearing.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run or several of the same scenario, of which `has_supports` holds.
    bearing : str, optional
        The bearing, by default the analysed bearing of the first record.

    Returns
    -------
    matplotlib.figure.Figure
        Left the whole time, right a few revolutions around the event.
    """
    bearing = bearing or statistics.analysed_bearing(records[0])
    title = f"Housing and foundation, {bearing}"
    figure = style.new_figure(11.0, 6.6, title, style.caption(records))
    grid = figure.subplots(2, 2, sharey="row", squeeze=False, width_ratios=[1.4, 1.0])
    views = panels.whole_run(records), panels.close_up(records)
    for row, (name, shown) in enumerate(_ROWS):
        sizes = [statistics.magnitude(record, name, bearing) for record in records]
        quantity = shown.fitting(max(float(size.max()) for size in sizes))
        for column, view in enumerate(views):
            axes = grid[row, column]
            for record, samples in zip(records, sizes, strict=True):
                time = np.asarray(record["time"].values, dtype=float)
                colour = style.colour_of(style.depth_at(record, bearing))
                label = style.run_name(record, bearing)
                panels.draw_curve(axes, view, panels.Curve(time, samples, colour, label), quantity)
                if column == 0:
                    worst = int(np.argmax(samples))
                    panels.mark(axes, view, float(time[worst]), float(samples[worst]), quantity)
            draw_events(axes, view, records[0], named=column == 0)
            style.dress(axes)
            panels.time_axis(axes, view, labelled=row == 1)
        panels.scale_panels(list(grid[row]))
        grid[row, 0].set_ylabel(quantity.axis)
    panels.legend_below(figure, list(grid.flat))
    return figure
