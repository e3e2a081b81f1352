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
_VALUES = 30
"""Different values of a parameter up to which each is a point."""
_BINS, _IN_BIN = 10, 8


def fragility(data: xr.Dataset) -> Iterator[Panel]:
    """A panel for each parameter that varies."""
    if CONTACT not in data:
        return
    for name in parameters(data):
        values = np.asarray(data[name].values, dtype=float)
        traces = [_trace(level, values) for level in levels(data)]
        shape = layout(
            xaxis=axis(title_of(data, name)),
            yaxis=axis("probability of solid contact [%]", range=[-3, 103]),
            legend={"orientation": "h", "yanchor": "bottom", "y": 1.0, "x": 0.0},
        )
        yield Panel("fragility", f"over {name}", traces, shape, height=380)


def groups(values: Array) -> list[Indices]:
    """Indices of samples that make a point: those of a value, or neighbours where all differ."""
    different = np.unique(values)
    if different.size <= _VALUES:
        return [np.flatnonzero(values == value) for value in different]
    count = int(np.clip(values.size // _IN_BIN, 1, _BINS))
    return [np.sort(part) for part in np.array_split(np.argsort(values, kind="stable"), count)]


def point(level: Level, inside: Indices) -> tuple[float, float, float]:
    """Probability and its bounds from some samples; nan where nothing is known."""
    contact = level.contact[inside]
    known = contact[np.isfinite(contact)]
    low, high = clopper_pearson(int(known.sum()), contact.size, contact.size - known.size)
    return (float(known.mean()) if known.size else float("nan")), low, high


def _trace(level: Level, values: Array) -> Trace:
    parts = groups(values)
    x = [float(values[part].mean()) for part in parts]
    found = [point(level, part) for part in parts]
    y = [None if np.isnan(p) else 100.0 * p for p, _, _ in found]
    middles = [0.0 if v is None else v for v in y]
    texts = [
        f"{len(part)} runs, {int(np.isnan(level.contact[part]).sum())} of them without a result; "
        f"95 %: {100 * low:.1f} to {100 * high:.1f} %"
        for part, (_, low, high) in zip(parts, found, strict=True)
    ]
    return {
        "type": "scatter",
        "mode": "lines+markers",
        "name": level.name,
        "x": x,
        "y": y,
        "text": texts,
        "hovertemplate": "%{x:.4g}: %{y:.1f} %<br>%{text}<extra></extra>",
        "line": {"color": level.colour, "dash": level.dash, "width": 2},
        "marker": {"color": level.colour, "size": 7},
        "error_y": {
            "type": "data",
            "symmetric": False,
            "array": [max(0.0, 100 * high - m) for (_, _, high), m in zip(found, middles, strict=True)],
            "arrayminus": [max(0.0, m - 100 * low) for (_, low, _), m in zip(found, middles, strict=True)],
            "color": level.colour,
            "thickness": 1,
            "width": 4,
        },
    }
