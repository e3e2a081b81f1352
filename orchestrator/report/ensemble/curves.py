"""Fragility curves: how likely solid contact is over a parameter, with bounds, at each depth."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from orchestrator.report.ensemble.source import Array, Level, levels, parameters, title_of
from orchestrator.report.panels.panel import Panel, Trace, axis, layout
from orchestrator.results.ensemble.figures import CONTACT
from orchestrator.results.ensemble.probability import clopper_pearson

Indices = NDArray[np.intp]
_VALUES = 12
"""Different values of a parameter up to which each is a point; those of an even grid always are."""
_BINS, _IN_BIN = 10, 8


def fragility(data: xr.Dataset) -> Iterator[Panel]:
    """A panel for each parameter that varies."""
    if CONTACT not in data:
        return
    for name in parameters(data):
        values = np.asarray(data[name].values, dtype=float)
        traces = [trace for level in levels(data) for trace in _traces(level, values)]
        shape = layout(
            xaxis=axis(title_of(data, name)),
            yaxis=axis("probability of solid contact [%]", range=[-3, 103]),
            showlegend=len(levels(data)) > 1,
            legend={"orientation": "h", "yanchor": "bottom", "y": 1.0, "x": 0.0},
        )
        yield Panel("fragility", f"over {name}", traces, shape, height=380)


def groups(values: Array) -> list[Indices]:
    """Indices of samples that make a point: those of a value, or neighbours where values were drawn."""
    different = np.unique(values)
    apart = np.diff(different)
    if different.size <= _VALUES or (values.size > different.size and np.allclose(apart, apart.mean())):
        return [np.flatnonzero(values == value) for value in different]
    count = int(np.clip(values.size // _IN_BIN, 1, _BINS))
    return [np.sort(part) for part in np.array_split(np.argsort(values, kind="stable"), count)]


def point(level: Level, inside: Indices) -> tuple[float, float, float]:
    """Probability and its bounds from some samples; nan where nothing is known."""
    contact = level.contact[inside]
    known = contact[np.isfinite(contact)]
    low, high = clopper_pearson(int(known.sum()), contact.size, contact.size - known.size)
    return (float(known.mean()) if known.size else float("nan")), low, high


def _traces(level: Level, values: Array) -> Iterator[Trace]:
    """The curve, and bounds alone where no run gave a result."""
    parts = groups(values)
    found = [(float(values[part].mean()), *point(level, part), part) for part in parts]
    known = [row for row in found if not np.isnan(row[1])]
    yield _marks(level, known) | {
        "name": level.name,
        "mode": "lines+markers",
        "line": {"color": level.colour, "dash": level.dash, "width": 2},
        "marker": {"color": level.colour, "size": 7},
    }
    if len(known) < len(found):
        middle = [(x, 0.5 * (low + high), low, high, part) for x, p, low, high, part in found if np.isnan(p)]
        none = {"mode": "markers", "showlegend": False, "marker": {"color": level.colour, "size": 1}}
        yield (
            _marks(level, middle) | none | {"hovertemplate": "%{x:.4g}: not known<br>%{text}<extra></extra>"}
        )


def _marks(level: Level, rows: list[tuple[float, float, float, float, Indices]]) -> Trace:
    """Points with bounds, in percent."""
    return {
        "type": "scatter",
        "x": [x for x, *_ in rows],
        "y": [100.0 * p for _, p, *_ in rows],
        "text": [
            f"{len(part)} runs, {int(np.isnan(level.contact[part]).sum())} of them without a result; "
            f"95 %: {100 * low:.1f} to {100 * high:.1f} %"
            for *_, low, high, part in rows
        ],
        "hovertemplate": "%{x:.4g}: %{y:.1f} %<br>%{text}<extra></extra>",
        "error_y": {
            "type": "data",
            "symmetric": False,
            "array": [100.0 * max(0.0, high - p) for _, p, _, high, _ in rows],
            "arrayminus": [100.0 * max(0.0, p - low) for _, p, low, _, _ in rows],
            "color": level.colour,
            "thickness": 1,
            "width": 4,
        },
    }
