"""Panels over time that the figures share: the whole run, and a few revolutions around the event."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from orchestrator.results import quantities
from orchestrator.results.figures import style
from orchestrator.results.statistics import window_mean
from orchestrator.results.windows import instants, phases
from orchestrator.scenario.schedule import from_attributes

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

BEFORE_REVOLUTIONS = 2.0
AFTER_REVOLUTIONS = 6.0
PAPER: dict[str, Any] = {
    "boxstyle": "round,pad=0.15",
    "facecolor": "white",
    "edgecolor": "none",
    "alpha": 0.8,
}
_LONG = 1500
"""Samples from which a curve is an image in a PDF or SVG, which would be large and slow otherwise."""
_ON_A_LINE = 5
"""Means in a line above a panel."""
LETTER, _HANDLE = 0.066, 0.7  # inches of a legend's letter, and of a line with its spaces


@dataclass(frozen=True)
class View:
    """The part of a run that a panel shows, and how its time axis reads.

    Attributes
    ----------
    start, end : float
        Simulated time [s].
    origin : float
        Time at which the axis reads zero [s].
    factor : float
        Shown time = (time - origin) times this.
    label : str
        Label of the axis.
    """

    start: float
    end: float
    origin: float
    factor: float
    label: str

    def shown(self, time: float) -> float:
        """Simulated time [s] as the axis reads it."""
        return (time - self.origin) * self.factor

    def shown_all(self, time: NDArray[np.float64]) -> NDArray[np.float64]:
        """The same for an array."""
        return (time - self.origin) * self.factor


@dataclass(frozen=True)
class Curve:
    """A quantity of a run over time, in SI.

    Attributes
    ----------
    time, samples : ndarray, shape (n,)
        The record's samples.
    colour, label : str
        How it is drawn and named.
    extremes : ndarray, shape (n,), optional
        Extremes in the interval that each sample closes; the band up to them is filled.
    width : float
        Line width in points.
    dash : str or tuple
        Line style of matplotlib, so that lines differ in grey print.
    """

    time: NDArray[np.float64]
    samples: NDArray[np.float64]
    colour: str
    label: str
    extremes: NDArray[np.float64] | None = None
    width: float = 0.7
    dash: Any = "-"


def whole_run(records: Sequence[xr.Dataset]) -> View:
    """The view of everything recorded."""
    start = min(float(record["time"].values[0]) for record in records)
    end = max(float(record["time"].values[-1]) for record in records)
    return View(start, end, 0.0, 1.0, "time [s]")


def close_up(records: Sequence[xr.Dataset]) -> View:
    """The view of a few revolutions around the first event; of the last ones when there is none."""
    whole = whole_run(records)
    schedule, reached = from_attributes(records[0].attrs), instants(records[0])
    if not reached:
        start = max(whole.start, schedule.later(whole.end, -AFTER_REVOLUTIONS))
        return View(start, whole.end, whole.end, 1e3, "time before the end [ms]")
    event, noun = reached[0], schedule.events[0].noun
    start = max(whole.start, schedule.later(event, -BEFORE_REVOLUTIONS))
    end = min(whole.end, schedule.later(event, AFTER_REVOLUTIONS))
    return View(start, end, event, 1e3, f"time after the {noun} [ms]")


def draw_curve(axes: Axes, view: View, curve: Curve, quantity: quantities.Quantity) -> None:
    """Draw the samples as a line and fill the way to the interval extremes."""
    time = view.shown_all(curve.time)
    look: dict[str, Any] = {"color": curve.colour, "linestyle": curve.dash, "linewidth": curve.width}
    look["rasterized"] = time.size > _LONG
    axes.plot(time, curve.samples * quantity.factor, **look, label=curve.label)
    if curve.extremes is not None:
        axes.fill_between(
            time,
            curve.samples * quantity.factor,
            curve.extremes * quantity.factor,
            color=curve.colour,
            alpha=0.55,
            linewidth=0,
            label="up to the extreme between samples",
            rasterized=time.size > _LONG,
        )


def draw_means(
    axes: Axes, view: View, record: xr.Dataset, samples: NDArray[np.float64], quantity: quantities.Quantity
) -> str:
    """Draw the mean of each phase over the window from which it was taken; return the means in words."""
    time, parts = np.asarray(record["time"].values, dtype=float), []
    for phase in phases(record):
        value = window_mean(phase.mean, time, samples)
        parts.append(f"{phase.name} {quantity.text(value)}")
        start, end = max(phase.mean.start, view.start), min(phase.mean.end, view.end)
        if end > start:
            axes.plot(
                [view.shown(start), view.shown(end)],
                [value * quantity.factor] * 2,
                color=style.MEAN,
                linewidth=1.6,
                solid_capstyle="butt",
                label="mean in its window",
                zorder=4,
            )
    lines = [", ".join(parts[k : k + _ON_A_LINE]) for k in range(0, len(parts), _ON_A_LINE)]
    return "mean " + ",\n".join(lines)


def mark(
    axes: Axes, view: View, time: float, value: float, quantity: quantities.Quantity, *, below: bool = False
) -> None:
    """Mark one extreme value and write it beside the mark."""
    x = view.shown(time)
    left = (time - view.start) > 0.75 * (view.end - view.start)
    axes.plot(
        [x],
        [value * quantity.factor],
        marker="^" if below else "v",
        color=style.EVENT,
        markersize=4,
        linestyle="none",
        zorder=5,
        clip_on=False,
    )
    axes.annotate(
        f"{quantity.text(value)} at {time:.3f} s",
        (x, value * quantity.factor),
        xytext=(-6 if left else 6, -2 if below else 2),
        textcoords="offset points",
        ha="right" if left else "left",
        va="top" if below else "bottom",
        fontsize=style.FONT - 1,
        bbox=PAPER,
        zorder=6,
    )


def time_axis(axes: Axes, view: View, *, labelled: bool = True) -> None:
    """Limits and label of a time axis."""
    axes.set_xlim(view.shown(view.start), view.shown(view.end))
    if labelled:
        axes.set_xlabel(view.label)
    else:
        axes.tick_params(labelbottom=False)


def scale_panels(
    grid: Sequence[Axes], *, above: float = 0.18, below: float = 0.0, ceiling: float | None = None
) -> None:
    """Set the ordinate that panels share: from zero, or below, to the largest value.

    Parameters
    ----------
    grid : sequence of Axes
        Panels with a shared ordinate.
    above, below : float
        Room for marks over and under the data, as a share of the range.
    ceiling : float, optional
        Upper end, as shown, where it is lower than the data.
    """
    limits = np.array([axes.dataLim.intervaly for axes in grid])
    limits = limits[np.isfinite(limits).all(axis=1)]
    if not limits.size:
        return
    low, high = min(0.0, float(limits[:, 0].min())), float(limits[:, 1].max())
    if ceiling is not None and ceiling < high:
        high, above = ceiling, 0.0
    if high > low:
        grid[0].set_ylim(low - below * (high - low), high + above * (high - low))
    for axes, largest in zip(grid, (axes.dataLim.ymax for axes in grid), strict=True):
        if ceiling is not None and largest > high and np.isfinite(largest):
            text = f"▲ cut off, up to {largest:.3g}"
            place: dict[str, Any] = {"xycoords": "axes fraction", "ha": "right", "va": "top"}
            axes.annotate(text, (0.995, 0.98), **place, fontsize=style.FONT - 2, zorder=6, bbox=PAPER)


def _legend_columns(figure: Figure, labels: Sequence[str]) -> int:
    """As many columns as the longest label leaves room for."""
    widest = max((len(label) for label in labels), default=1)
    column = LETTER * widest + _HANDLE
    return max(1, min(len(labels), int(figure.get_size_inches()[0] / column)))


def legend_below(figure: Figure, axes: Sequence[Axes]) -> None:
    """One legend for the whole figure, outside the panels; each label once."""
    entries: dict[str, Artist] = {}
    for one in axes:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    legend = figure.legend(
        list(entries.values()),
        list(entries),
        loc="outside lower center",
        ncols=_legend_columns(figure, list(entries)),
        frameon=False,
        fontsize=style.FONT,
    )
    for line in legend.get_lines():
        line.set_linewidth(max(2.0, line.get_linewidth()))
