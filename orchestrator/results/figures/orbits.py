"""Orbits of the journals in their clearances."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from orchestrator.results import journals, statistics
from orchestrator.results.figures import panels, style
from orchestrator.results.relative_motion import journal_motion, room_of
from orchestrator.results.windows import phases

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MICRO = 1e6
_COLUMNS, _MARKS = 4, 150
"""Panels in a row, and most marks of contact."""
_LOOKS = {
    "before": ("#000000", "-", 1.4),
    "behind the event": ("#8FB8DE", "-", 0.6),
    "end of the run": ("#0B4F8A", (0, (3, 1)), 1.0),
}
"""Colour, line style and width of each part."""
_ONLY = ("#0B4F8A", "-", 1.0)


def orbits(records: Sequence[xr.Dataset], bearing: str | None = None) -> Figure:
    """Draw orbits: of one run those of all bearings, of several that of one bearing side by side.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run or several of the same scenario.
    bearing : str, optional
        Of several runs; by default the analysed bearing of the first record.
    """
    names = [str(name) for name in records[0]["bearing"].values]
    bearing = bearing or statistics.analysed_bearing(records[0])
    pairs = [(records[0], name) for name in names] if len(records) == 1 else [(r, bearing) for r in records]
    columns = min(_COLUMNS, len(pairs))
    rows = -(-len(pairs) // columns)
    title = "Orbits of the journals" if len(records) == 1 else f"Orbit of the journal, {bearing}"
    figure = style.new_figure(max(9.0, 3.1 * columns), 1.5 + 3.0 * rows, title, style.caption(records))
    grid = figure.subplots(rows, columns, squeeze=False)
    reach = max(_reach(record, name) for record, name in pairs) if len(records) > 1 else None
    for axes, (record, name) in zip(grid.flat, pairs, strict=False):
        _orbit(axes, record, name, reach or _reach(record, name))
        bold = "bold" if name == bearing else "normal"
        title = f"{style.row_prefix(records, record, name)}{name}{_least(record, name)}"
        axes.set_title(title, fontsize=style.FONT, fontweight=bold)
    for axes in grid.flat[len(pairs) :]:
        axes.set_visible(False)
    for axes in grid[:, 0]:
        axes.set_ylabel("y [µm]")
    for axes in grid[-1]:
        axes.set_xlabel("x [µm]")
    panels.legend_below(figure, list(grid.flat))
    return figure


def _least(record: xr.Dataset, bearing: str) -> str:
    """Least gap and its instant in words; nothing of a bearing without bore."""
    gap = statistics.series(record, "least_gap", bearing)
    if np.isnan(gap).all():
        return ""
    worst = int(np.nanargmin(gap))
    return f"\nleast gap {gap[worst] * MICRO:.1f} µm at {float(record['time'].values[worst]):.4f} s"


def _reach(record: xr.Dataset, bearing: str) -> float:
    widest = 0.0 if (room := room_of(record, bearing)) is None else float(np.nanmax(np.abs(room)))
    return 1.08 * MICRO * max(widest, float(np.nanmax(np.abs(journal_motion(record, bearing)))), 1e-9)


def _orbit(axes: Axes, record: xr.Dataset, bearing: str, reach: float) -> None:
    time = np.asarray(record["time"].values, dtype=float)
    motion = journal_motion(record, bearing) * MICRO
    room = room_of(record, bearing)
    if room is not None:
        axes.fill(*(room[:, np.isfinite(room).all(axis=0)] * MICRO), color="#F6F3EA", zorder=0)
        axes.plot(*(room * MICRO), color="#222222", linewidth=1.2, label="clearance", zorder=1)
    found = phases(record)
    turn = 2.0 * math.pi / abs(float(record.attrs["speed"]))
    for part in journals.orbit_parts(found, turn):
        inside = part.window.mask(time)
        colour, dash, width = _LOOKS.get(part.name, _ONLY)
        look: dict[str, Any] = {"color": colour, "linestyle": dash, "linewidth": width}
        axes.plot(*motion[:, inside], **look, label=part.name, zorder=3 if part.name == "before" else 2)
    contact = journals.touching(record, bearing, found)
    if contact.any():
        hardest = np.argsort(statistics.series(record, "contact_force", bearing))[::-1][:_MARKS]
        hardest = hardest[contact[hardest]]
        marks: dict[str, Any] = {
            "linestyle": "none",
            "marker": "x",
            "markersize": 2.5,
            "markeredgewidth": 0.6,
        }
        axes.plot(*motion[:, hardest], **marks, color=style.CONTACT, label="solid contact", zorder=2.5)
    gap = statistics.series(record, "least_gap", bearing)
    if not np.isnan(gap).all():
        worst = int(np.nanargmin(gap))
        star: dict[str, Any] = {
            "linestyle": "none",
            "marker": "*",
            "markersize": 9,
            "markeredgecolor": "#222222",
        }
        axes.plot(*motion[:, worst], **star, color="#F2B705", label="least gap", zorder=4)
    axes.set_xlim(-reach, reach)
    axes.set_ylim(-reach, reach)
    axes.set_aspect("equal")
    style.dress(axes)
