"""Spectra and waterfall of a journal, as probes read it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.ticker import FuncFormatter

from orchestrator.results import journals, statistics, windows
from orchestrator.results.figures import panels, style
from orchestrator.results.relative_motion import journal_motion
from orchestrator.results.signals.orders import NAMED
from orchestrator.results.windows import phases

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MICRO = 1e6
_FLOOR = journals.FLOOR * MICRO
_DECADES = 5.0
_PLAIN = FuncFormatter(lambda value, _: f"{value:g}")
_BEFORE, _LASTING = "#666666", "#0072B2"


def spectra(records: Sequence[xr.Dataset], bearing: str | None = None) -> Figure:
    """Draw the amplitudes at both probes before the event and after it, one row a run.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run or several of the same scenario; all panels have the same scale.
    bearing : str, optional
        By default the analysed bearing of the first record.
    """
    bearing = bearing or statistics.analysed_bearing(records[0])
    angles = journals.probes_of(records[0])
    figure = style.new_figure(
        12.0, 1.7 + 2.7 * len(records), f"Spectra of the journal, {bearing}", style.caption(records)
    )
    grid = figure.subplots(len(records), len(angles), sharex=True, sharey=True, squeeze=False)
    largest, speeds = 0.0, [windows.changing_speed(record) for record in records]
    over_orders = speeds[0] is not None
    for row, record in enumerate(records):
        time = np.asarray(record["time"].values, dtype=float)
        motion, turn = journal_motion(record, bearing), _turn(record)
        for column, angle in enumerate(angles):
            axes = grid[row, column]
            every = phases(record)
            for phase in every:
                window = journals.steady_window(phase, turn)
                found = journals.probe_spectrum(time, motion, angle, window, turn, speeds[row])
                if found is None:
                    continue
                amplitude = np.maximum(found.amplitude * MICRO, _FLOOR)
                before, last = phase.name == "before", phase is every[-1]
                dash = "--" if before else "-" if last else ":"
                look = {"color": _BEFORE if before else _LASTING, "linestyle": dash}
                axes.semilogy(found.frequency, amplitude, linewidth=1.0, **look, label=phase.name)
                largest = max(largest, float(amplitude.max()))
            if (speeds[row] is not None) == over_orders:
                _name_orders(axes, 1.0 if over_orders else turn, journals.HIGHEST, named=row == 0)
            style.dress(axes)
            prefix = style.row_prefix(records, record, bearing)
            axes.set_title(
                f"{prefix}probe at {math.degrees(angle):.0f}°", loc="left", fontsize=style.FONT, pad=16
            )
        grid[row, 0].set_ylabel("amplitude, zero to peak [µm]")
    for axes in grid[-1]:
        axes.set_xlabel("order of the speed" if over_orders else "frequency [Hz]")
        axes.set_xlim(0.0, journals.HIGHEST / (1.0 if over_orders else _turn(records[0])))
    if largest > 0.0:
        grid[0, 0].yaxis.set_major_formatter(_PLAIN)
        grid[0, 0].set_ylim(1.5 * largest * 10.0**-_DECADES, 2.5 * largest)
    panels.legend_below(figure, list(grid.flat))
    return figure


def waterfall(records: Sequence[xr.Dataset], bearing: str | None = None) -> Figure:
    """Draw the amplitudes at the first probe over frequency and time, one panel a run, in one scale.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run or several of the same scenario.
    bearing : str, optional
        By default the analysed bearing of the first record.
    """
    bearing = bearing or statistics.analysed_bearing(records[0])
    title = f"Waterfall of the journal, {bearing}"
    figure = style.new_figure(4.6 * len(records) + 2.6, 5.6, title, style.caption(records))
    grid = figure.subplots(1, len(records), sharex=True, sharey=True, squeeze=False)[0]
    found = []
    for record in records:
        time = np.asarray(record["time"].values, dtype=float)
        motion, angle = journal_motion(record, bearing), journals.probes_of(record)[0]
        found.append(journals.probe_waterfall(time, motion, angle, _turn(record)))
    top = max((float(fall.amplitude.max()) for fall in found if fall is not None), default=0.0) * MICRO
    top = max(top, 10.0 * _FLOOR)
    norm = LogNorm(max(1e-4 * top, _FLOOR), top, clip=True)
    mesh = None
    for axes, record, fall in zip(grid, records, found, strict=True):
        if fall is None or fall.time is None:
            axes.text(
                0.5,
                0.5,
                "fewer than four revolutions, or records too far apart",
                transform=axes.transAxes,
                ha="center",
            )
            continue
        values = np.maximum(fall.amplitude * MICRO, _FLOOR)
        look = {"norm": norm, "cmap": "viridis", "shading": "nearest", "rasterized": True}
        mesh = axes.pcolormesh(fall.frequency, fall.time, values, **look)
        _draw_orders(axes, record)
        panel = f"{style.row_prefix(records, record, bearing)}probe at "
        angle = math.degrees(journals.probes_of(record)[0])
        axes.set_title(f"{panel}{angle:.0f}°\n", loc="left", fontsize=style.FONT)
        axes.set_xlabel("frequency [Hz]", fontsize=style.FONT)
        axes.tick_params(labelsize=style.FONT - 1)
    grid[0].set_ylabel("time [s]", fontsize=style.FONT)
    drawn = [fall.time for fall in found if fall is not None and fall.time is not None]
    if drawn:
        grid[0].set_ylim(min(time[0] for time in drawn), max(time[-1] for time in drawn))
    if mesh is not None:
        bar = figure.colorbar(mesh, ax=list(grid), extend="min", aspect=30, pad=0.02)
        bar.ax.yaxis.set_major_formatter(_PLAIN)
        bar.set_label("amplitude, zero to peak [µm]", fontsize=style.FONT)
    return figure


def _draw_orders(axes: Axes, record: xr.Dataset) -> None:
    """Lines of the orders in a waterfall, which follow the speed."""
    speed = windows.changing_speed(record)
    if speed is None:
        _name_orders(axes, _turn(record), journals.HIGHEST_OVER_TIME, colour="white")
        return
    limits, time = axes.get_xlim(), record["time"].values
    for order, name in NAMED.items():
        frequency = order * speed / (2.0 * math.pi)
        axes.plot(frequency, time, color="white", linewidth=0.8, linestyle=":")
        place: dict[str, Any] = {"xycoords": "data", "ha": "center", "va": "bottom", "color": "white"}
        axes.annotate(name, (float(frequency[0]), float(time[0])), **place, fontsize=style.FONT - 1)
    axes.set_xlim(*limits)


def _turn(record: xr.Dataset) -> float:
    """Length of a revolution in s."""
    return 2.0 * math.pi / abs(float(record.attrs["speed"]))


def _name_orders(
    axes: Axes, turn: float, highest: float, *, named: bool = True, colour: str = "#888888"
) -> None:
    for order, name in NAMED.items():
        if order < highest:
            axes.axvline(order / turn, color=colour, linewidth=0.8, linestyle=":", zorder=1)
            if named:
                place: dict[str, Any] = {
                    "xycoords": ("data", "axes fraction"),
                    "ha": "center",
                    "va": "bottom",
                }
                axes.annotate(name, (order / turn, 1.0), **place, fontsize=style.FONT - 1)
