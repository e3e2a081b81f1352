"""All bearings at a glance: force and least gap over time, one row a bearing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results import quantities, statistics
from orchestrator.results.figures import panels, style
from orchestrator.results.figures.event_marks import draw_events
from orchestrator.results.figures.least_gap import draw_contact, gap_ceiling

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def overview(records: Sequence[xr.Dataset], bearing: str | None = None) -> Figure:
    """Draw force (left) and least gap (right) of every bearing over the whole time.

    Gaps are cut off at a multiple of those before the event: what matters happens near zero.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run or several of the same scenario, drawn over one another.  All rows of a
        column share their scale, so that bearings compare.
    bearing : str, optional
        The bearing whose name is bold, by default the analysed bearing of the first record.

    Returns
    -------
    matplotlib.figure.Figure
    """
    names = [str(name) for name in records[0]["bearing"].values]
    analysed = bearing or statistics.analysed_bearing(records[0])
    view = panels.whole_run(records)
    forces = quantities.FORCE.fitting(max(float(abs(record["force"]).max()) for record in records))
    figure = style.new_figure(
        12.0,
        1.8 + 0.95 * len(names),
        "All bearings: force and least gap",
        style.caption(records),
    )
    grid = figure.subplots(len(names), 2, sharex=True, sharey="col", squeeze=False)
    for row, name in enumerate(names):
        for record in records:
            time = np.asarray(record["time"].values, dtype=float)
            depth = style.depth_at(record, name)
            colour, label, dash = style.colour_of(depth), style.depth_name(depth), style.dash_of(depth)
            force = statistics.magnitude(record, "force", name)
            gap = statistics.series(record, "least_gap", name)
            for axes, samples, extreme, quantity in (
                (grid[row, 0], force, "force_magnitude_max", forces),
                (grid[row, 1], gap, "least_gap_min", quantities.GAP),
            ):
                extremes = statistics.interval_extreme(record, extreme, name, samples)
                curve = panels.Curve(time, samples, colour, label, extremes, width=0.5, dash=dash)
                panels.draw_curve(axes, view, curve, quantity)
            draw_contact(grid[row, 1], view, record, name, height=0.08)
        for axes in grid[row]:
            draw_events(axes, view, records[0], named=False)
            style.dress(axes)
            panels.time_axis(axes, view, labelled=row == len(names) - 1)
        grid[row, 0].set_ylabel(
            name, rotation=0, ha="right", va="center", fontweight="bold" if name == analysed else "normal"
        )
    for column, quantity in enumerate((forces, quantities.GAP)):
        grid[0, column].set_title(quantity.axis, loc="left", fontsize=style.FONT)
    panels.scale_panels(list(grid[:, 0]), above=0.05)
    ceiling = gap_ceiling(records, names, ("least_gap",))
    panels.scale_panels(list(grid[:, 1]), above=0.05, below=0.1, ceiling=ceiling)
    panels.legend_below(figure, list(grid.flat))
    return figure
