"""Largest value along the shaft over time: what the figures of amplitude and stress share."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results import quantities
from orchestrator.results.figures import panels, style
from orchestrator.results.statistics import time_mean
from orchestrator.results.windows import phases

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def shaft_maximum(
    records: Sequence[xr.Dataset], name: str, quantity: quantities.Quantity, title: str
) -> Figure:
    """Draw ``<name>_max`` over time, one row a run, the close-ups of all runs to the right.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run or several of the same scenario.
    name : str
        Stem of the record's variables ``<name>_max`` and ``<name>_position``.
    quantity : Quantity
        How it is drawn.
    title : str
        Headline of the figure.
    """
    rows = len(records)
    figure = style.new_figure(
        12.0,
        1.8 + 2.6 * rows,
        title,
        style.run_caption(records[0]) if rows == 1 else str(records[0].attrs.get("title", "")),
    )
    grid = figure.subplots(rows, 2, sharey=True, sharex="col", squeeze=False, width_ratios=[1.5, 1.0])
    whole, near = panels.whole_run(records), panels.close_up(records)
    for row, record in enumerate(records):
        time = np.asarray(record["time"].values, dtype=float)
        samples = np.asarray(record[f"{name}_max"].values, dtype=float)
        curve = panels.Curve(
            time, samples, style.colour_of(style.depth_at(record)), style.run_name(record), width=0.9
        )
        left, right = grid[row]
        for axes, view in ((left, whole), (right, near)):
            panels.draw_curve(axes, view, curve, quantity)
            panels.draw_event(axes, view, record, named=axes is left)
            style.dress(axes)
            panels.time_axis(axes, view, labelled=row == rows - 1)
        found = phases(record)
        means = []
        for phase in found:
            inside = phase.mean.mask(time)
            means.append(time_mean(time[inside], samples[inside]))
        panels.draw_means(left, whole, found, means, quantity)
        worst = int(np.argmax(samples))
        panels.mark(left, whole, float(time[worst]), float(samples[worst]), quantity)
        parts = [f"{phase.name} {quantity.text(mean)}" for phase, mean in zip(found, means, strict=True)]
        where = float(record[f"{name}_position"].values[worst])
        left.set_title(
            f"{style.row_prefix(records, record)}mean {', '.join(parts)}; largest at z = {where:.1f} m",
            loc="left",
            fontsize=style.FONT,
        )
        left.set_ylabel(quantity.axis)
    panels.scale_panels(list(grid.flat))
    panels.legend_below(figure, list(grid.flat))
    return figure
