"""Least gap of the analysed bearing over time, film and centre line (Figure 7 of the paper)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results import quantities, statistics
from orchestrator.results.figures import panels, style
from orchestrator.results.figures.event_marks import draw_events
from orchestrator.results.windows import phases

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CEILING = 1.5
"""Upper end of close-ups of gaps, in terms of the largest gap before the event."""


def _curves(record: xr.Dataset, bearing: str) -> list[panels.Curve]:
    """Least gap of the centre line, where it differs, and of the whole film."""
    time = np.asarray(record["time"].values, dtype=float)
    film = statistics.series(record, "least_gap", bearing)
    centre = statistics.series(record, "centre_line_gap", bearing)
    depth = style.depth_at(record, bearing)
    curves = []
    if not np.array_equal(film, centre):
        least = statistics.interval_extreme(record, "centre_line_gap_min", bearing, centre)
        curves.append(panels.Curve(time, centre, style.CENTRE_LINE, "centre line", least, dash=":"))
    least = statistics.interval_extreme(record, "least_gap_min", bearing, film)
    label = f"whole film, {style.run_name(record, bearing)}"
    return [*curves, panels.Curve(time, film, style.colour_of(depth), label, least)]


def draw_contact(
    axes: Axes, view: panels.View, record: xr.Dataset, bearing: str, *, height: float = 0.035
) -> None:
    """Strip along the bottom where asperities carry load."""
    threshold = statistics.contact_threshold(record, bearing, phases(record))
    samples = statistics.series(record, "contact_force", bearing)
    contact = statistics.interval_extreme(record, "contact_force_max", bearing, samples)
    touching = contact > threshold
    if touching.any():
        # A sample speaks for the interval that it closes, so the strip reaches back to the one before.
        touching[:-1] |= touching[1:]
        axes.fill_between(
            view.shown_all(np.asarray(record["time"].values, dtype=float)),
            0.0,
            height,
            where=touching,
            transform=axes.get_xaxis_transform(),
            color=style.CONTACT,
            linewidth=0.5,
            label="solid contact",
            zorder=3,
        )


def gap_ceiling(records: Sequence[xr.Dataset], bearings: Sequence[str], names: Sequence[str]) -> float | None:
    """Largest gap worth showing near the surfaces, in µm: `CEILING` times the gaps before the event."""
    largest = 0.0
    for record in records:
        found = phases(record)
        if len(found) == 1:
            return None
        inside = found[0].mean.mask(record["time"].values)
        for bearing in bearings:
            largest = max(
                largest, *(statistics.series(record, name, bearing)[inside].max() for name in names)
            )
    return CEILING * largest * quantities.GAP.factor


def _title(record: xr.Dataset, bearing: str) -> str:
    found = phases(record)
    threshold = statistics.contact_threshold(record, bearing, found)
    parts = []
    for phase in found:
        figures = statistics.bearing_statistics(record, bearing, phase, contact_from=threshold)
        text = (
            f"{phase.name}: mean {quantities.GAP.text(figures.least_gap_mean)}"
            f" ± {figures.least_gap_harmonic * quantities.GAP.factor:.1f},"
            f" least {quantities.GAP.text(figures.least_gap_min)}"
        )
        if figures.contact_first is not None:
            share = f"{100 * figures.contact_share:.0f} % of the time"
            text += f", contact from {figures.contact_first:.3f} s, {share}"
        parts.append(text)
    return "\n".join(parts)


def least_gap(records: Sequence[xr.Dataset], bearing: str | None = None) -> Figure:
    """Draw the least gap of the whole film and of the centre line of one bearing.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run or several of the same scenario; each has its row.
    bearing : str, optional
        The bearing, by default the analysed bearing of the first record.

    Returns
    -------
    matplotlib.figure.Figure
        Left the whole time, right a few revolutions around the event, near the surfaces; a
        strip along the bottom marks solid contact.
    """
    bearing = bearing or statistics.analysed_bearing(records[0])
    rows = len(records)
    figure = style.new_figure(
        12.0,
        1.6 + 3.0 * rows,
        f"Least gap, {bearing}",
        style.caption(records),
    )
    grid = figure.subplots(rows, 2, sharey="col", sharex="col", squeeze=False, width_ratios=[1.5, 1.0])
    views = (panels.whole_run(records), panels.close_up(records))
    for row, record in enumerate(records):
        for column, view in enumerate(views):
            axes = grid[row, column]
            for curve in _curves(record, bearing):
                panels.draw_curve(axes, view, curve, quantities.GAP)
            draw_contact(axes, view, record, bearing)
            draw_events(axes, view, record, named=column == 0)
            style.dress(axes)
            panels.time_axis(axes, view, labelled=row == rows - 1)
        grid[row, 0].set_ylabel(quantities.GAP.axis)
        grid[row, 0].set_title(
            style.row_prefix(records, record, bearing) + _title(record, bearing),
            loc="left",
            fontsize=style.FONT - 0.5,
        )
    grid[0, 1].set_title("close to the surfaces", loc="left", fontsize=style.FONT - 0.5)
    panels.scale_panels(list(grid[:, 0]), above=0.08, below=0.06)
    ceiling = gap_ceiling(records, [bearing], ("least_gap", "centre_line_gap"))
    panels.scale_panels(list(grid[:, 1]), above=0.08, below=0.06, ceiling=ceiling)
    panels.legend_below(figure, list(grid.flat))
    return figure
