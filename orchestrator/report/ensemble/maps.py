"""Maps of two parameters: a figure at every sample, contact marked."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from orchestrator.report.ensemble.source import FINISHED, Array, levels, parameters, shown, title_of
from orchestrator.report.panels.panel import CONTACT, INK, Panel, Trace, axis, layout

_MOST = 6
_SHOWN = ("least_gap_min", "worst_share")
_FILLED = 0.8
"""Share of a grid's cells that must have samples for it to be drawn as one."""


def figures_of(data: xr.Dataset) -> list[str]:
    """The figures that are drawn: those that say most, or else whatever there is."""
    numbers = [str(n) for n, v in data.data_vars.items() if v.dtype.kind == "f" and "sample" in v.dims]
    numbers = [n for n in numbers if not {"time", "figure", "parameter"} & set(data[n].dims)]
    return [n for n in _SHOWN if n in numbers][:1] or numbers[:1]


def maps(data: xr.Dataset) -> Iterator[Panel]:
    """A panel for each pair of parameters, of the first figure, at the first depth."""
    depth = str(data["depth"].values[0])
    pairs = list(itertools.combinations(parameters(data), 2))[:_MOST]
    for figure in figures_of(data):
        values, title = shown(data, figure, depth)
        for across, up in pairs:
            bar = {"title": {"text": title, "side": "right"}, "thickness": 12}
            shape = layout(
                xaxis=axis(title_of(data, across)), yaxis=axis(title_of(data, up)), showlegend=False,
                coloraxis={"colorscale": "Viridis", "colorbar": bar},
            )  # fmt: skip
            traces = _traces(data, (across, up), values)
            at = f" at {depth.upper()}" if depth else ""
            yield Panel("maps", f"{title}{at}: {across}, {up}", traces, shape, height=340)


def _traces(data: xr.Dataset, names: tuple[str, str], values: Array) -> list[Trace]:
    x, y = (np.asarray(data[name].values, dtype=float) for name in names)
    xs, ys = np.unique(x), np.unique(y)
    known = np.isfinite(values) & (levels(data)[0].outcomes == FINISHED)
    cells = {(a, b) for a, b in zip(x, y, strict=True)}
    if xs.size * ys.size * _FILLED <= len(cells) and len(cells) < x.size:
        mean = [[_mean(values[known & (x == a) & (y == b)]) for a in xs] for b in ys]
        shape = {"x": xs.tolist(), "y": ys.tolist(), "z": mean}
        return [{"type": "heatmap", "coloraxis": "coloraxis", **shape}]
    contact = levels(data)[0].contact == 1.0
    found: list[Trace] = []
    for inside, edge, size in ((known & ~contact, "#FFFFFF", 9), (known & contact, CONTACT, 10)):
        if inside.any():
            marker = {
                "size": size,
                "color": values[inside].tolist(),
                "coloraxis": "coloraxis",
                "line": {"color": edge, "width": 2 if edge == CONTACT else 0.5},
            }
            found.append(_marks(x[inside], y[inside], marker))
    if (~known).any():
        cross = {"symbol": "x", "size": 8, "color": INK}
        found.append(_marks(x[~known], y[~known], cross))
    return found


def _marks(x: Array, y: Array, marker: dict[str, Any]) -> Trace:
    return {"type": "scatter", "mode": "markers", "x": x.tolist(), "y": y.tolist(), "marker": marker}


def _mean(values: Array) -> float | None:
    known = values[np.isfinite(values)]
    return float(known.mean()) if known.size else None
