"""Largest vibration amplitude and normal stress in the shaft over time (Figures 8 and 9 of the paper)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results import quantities
from orchestrator.results.figures import panels, style
from orchestrator.results.figures.event_marks import draw_events

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def vibration_amplitude(records: Sequence[xr.Dataset]) -> Figure:
    """Draw the largest vibration amplitude along the shaft, from the static line, over time."""
    title = "Largest vibration amplitude in the shaft"
    return _shaft_maximum(records, "vibration_amplitude", quantities.AMPLITUDE, title)


def normal_stress(records: Sequence[xr.Dataset]) -> Figure:
    """Draw the largest normal stress from bending along the shaft over time."""
    return _shaft_maximum(records, "normal_stress", quantities.STRESS, "Largest normal stress in the shaft")


def _shaft_maximum(
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
        style.caption(records),
    )
    grid = figure.subplots(rows, 2, sharey=True, sharex="col", squeeze=False, width_ratios=[1.5, 1.0])
    whole, near = panels.whole_run(records), panels.close_up(records)
    for row, record in enumerate(records):
        time = np.asarray(record["time"].values, dtype=float)
        samples = np.asarray(record[f"{name}_max"].values, dtype=float)
        depth = style.depth_at(record)
        look = style.colour_of(depth), style.run_name(record)
        curve = panels.Curve(time, samples, *look, width=0.9, dash=style.dash_of(depth))
        left, right = grid[row]
        for axes, view in ((left, whole), (right, near)):
            panels.draw_curve(axes, view, curve, quantity)
            draw_events(axes, view, record, named=axes is left)
            style.dress(axes)
            panels.time_axis(axes, view, labelled=row == rows - 1)
        means = panels.draw_means(left, whole, record, samples, quantity)
        worst = int(np.argmax(samples))
        panels.mark(left, whole, float(time[worst]), float(samples[worst]), quantity)
        where = float(record[f"{name}_position"].values[worst])
        left.set_title(
            f"{style.row_prefix(records, record)}{means}; largest at z = {where:.1f} m",
            loc="left",
            fontsize=style.FONT,
        )
        left.set_ylabel(quantity.axis)
    panels.scale_panels(list(grid.flat))
    panels.legend_below(figure, list(grid.flat))
    return figure
