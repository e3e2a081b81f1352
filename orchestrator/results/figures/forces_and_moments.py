"""Force and moment of the analysed bearing over time (Figure 6 of the paper)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results import quantities, statistics
from orchestrator.results.figures import panels, style
from orchestrator.results.figures.event_marks import draw_events

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ROWS = (("force", quantities.FORCE), ("moment", quantities.MOMENT))


def _curve(record: xr.Dataset, name: str, bearing: str) -> panels.Curve:
    samples = statistics.magnitude(record, name, bearing)
    extremes = statistics.interval_extreme(record, f"{name}_magnitude_max", bearing, samples)
    depth = style.depth_at(record, bearing)
    return panels.Curve(
        np.asarray(record["time"].values, dtype=float),
        samples,
        style.colour_of(depth),
        style.run_name(record, bearing),
        extremes,
        dash=style.dash_of(depth),
    )


def _whole(
    axes: Axes,
    view: panels.View,
    record: xr.Dataset,
    name: str,
    quantity: quantities.Quantity,
    bearing: str,
    prefix: str,
) -> None:
    curve = _curve(record, name, bearing)
    panels.draw_curve(axes, view, curve, quantity)
    means = panels.draw_means(axes, view, record, curve.samples, quantity)
    axes.set_title(prefix + means, loc="left", fontsize=style.FONT)
    if curve.extremes is None or curve.extremes.max() <= 0:
        axes.text(
            0.03,
            0.5,
            "none: a film of this depth\ncarries no moment",
            transform=axes.transAxes,
            fontsize=style.FONT - 1,
        )
    else:
        worst = int(np.argmax(curve.extremes))
        panels.mark(axes, view, float(curve.time[worst]), float(curve.extremes[worst]), quantity)


def forces_and_moments(records: Sequence[xr.Dataset], bearing: str | None = None) -> Figure:
    """Draw the magnitude of force (top) and moment (bottom) of one bearing.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run or several of the same scenario; each has its column over the whole time, the
        last column shows all of them around the event.
    bearing : str, optional
        The bearing, by default the analysed bearing of the first record.

    Returns
    -------
    matplotlib.figure.Figure
    """
    bearing = bearing or statistics.analysed_bearing(records[0])
    columns = len(records) + 1
    figure = style.new_figure(
        4.6 * columns if columns > 2 else 11.0,
        6.6,
        f"Bearing force and moment, {bearing}",
        style.caption(records),
    )
    ratios = [1.4] * len(records) + [1.0]
    grid = figure.subplots(2, columns, sharey="row", squeeze=False, width_ratios=ratios)
    whole, near = panels.whole_run(records), panels.close_up(records)
    quantity = quantities.FORCE
    for row, (name, shown) in enumerate(_ROWS):
        largest = max(float(statistics.magnitude(record, name, bearing).max()) for record in records)
        # an axis without any moment has the unit that goes with the forces above it
        quantity = shown.fitting(largest or 1.0 / quantity.factor)
        for column, record in enumerate(records):
            _whole(
                grid[row, column],
                whole,
                record,
                name,
                quantity,
                bearing,
                style.row_prefix(records, record, bearing),
            )
            panels.draw_curve(grid[row, -1], near, _curve(record, name, bearing), quantity)
            draw_events(grid[row, column], whole, record)
        draw_events(grid[row, -1], near, records[0], named=False)
        panels.scale_panels(list(grid[row]))
        grid[row, 0].set_ylabel(quantity.axis)
        for column, axes in enumerate(grid[row]):
            style.dress(axes)
            panels.time_axis(axes, near if column == columns - 1 else whole, labelled=row == 1)
    panels.legend_below(figure, list(grid.flat))
    return figure
