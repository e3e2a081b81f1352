"""Which parameter matters: indices of a design, or else rank correlations, as bars with bounds."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import xarray as xr
from scipy.stats import spearmanr

from orchestrator.report.ensemble.source import parameters, shown
from orchestrator.report.panels.panel import Panel, Trace, axis, layout
from orchestrator.results.figures import style

_SHOWN = ("least_gap_min", "force_max", "contact_max", "worst_share", "stress_max", "amplitude_max")
_MOST = 4
_INDICES = (("sobol_total", "total Sobol index"), ("sobol_first", "first-order Sobol index"))
_MORRIS = (("morris_mean", "mean of the absolute elementary effects"),)
_LEAST = 5  # samples of a correlation


def sensitivities(data: xr.Dataset) -> Iterator[Panel]:
    """A panel for each of some figures, with a bar for each parameter and depth."""
    if "figure" in data.coords:
        known = [str(name) for name in data["figure"].values]
        for figure in ([n for n in _SHOWN if n in known] or known)[:_MOST]:
            for name, words in (*_INDICES, *_MORRIS):
                if name in data and np.isfinite(data[name].sel(figure=figure).values).any():
                    yield _panel(figure, words, _of_design(data, name, figure))
        return
    panels = ((name, _correlations(data, name)) for name in _SHOWN if name in data)
    for figure, traces in [(name, traces) for name, traces in panels if traces][:_MOST]:
        yield _panel(figure, "rank correlation", traces)


def _panel(figure: str, words: str, traces: list[Trace]) -> Panel:
    shape = layout(
        xaxis=axis(words, zeroline=True), yaxis=axis("", autorange="reversed"), barmode="group",
        margin={"l": 62, "r": 14, "t": 34, "b": 44},
        showlegend=len(traces) > 1,
    )  # fmt: skip
    return Panel("sensitivity", figure.replace("_", " "), traces, shape, height=300)


def _of_design(data: xr.Dataset, name: str, figure: str) -> list[Trace]:
    names = [str(p) for p in data["parameter"].values]
    found = []
    for depth in map(str, data["depth"].values):
        at = {"depth": depth, "figure": figure}
        values, bounds = data[name].sel(at).values, data[f"{name}_bound"].sel(at).values
        if np.isfinite(values).all():
            found.append(_bars(depth, names, values.tolist(), bounds.tolist(), bounds.tolist()))
    return found


def _correlations(data: xr.Dataset, figure: str) -> list[Trace]:
    """Spearman's, with bounds by Fisher's transformation (variance of Fieller, Hartley, Pearson 1957)."""
    names, found = parameters(data), []
    for depth in map(str, data["depth"].values):
        values, _ = shown(data, figure, depth)
        known = np.isfinite(values)
        if known.sum() < _LEAST or np.ptp(values[known]) == 0.0:
            continue
        rows = []
        for name in names:
            x = np.asarray(data[name].values, dtype=float)[known]
            rho = float(spearmanr(x, values[known]).statistic) if np.ptp(x) > 0.0 else 0.0
            wide = 1.96 * math.sqrt(1.06 / (known.sum() - 3))
            z = math.atanh(min(max(rho, -0.999999), 0.999999))
            rows.append((rho, math.tanh(z + wide) - rho, rho - math.tanh(z - wide)))
        above, below = [r[1] for r in rows], [r[2] for r in rows]
        found.append(_bars(depth, names, [r[0] for r in rows], above, below))
    return found


def _bars(depth: str, names: list[str], values: list[float], above: list[float], below: list[float]) -> Trace:
    return {
        "type": "bar",
        "orientation": "h",
        "name": style.depth_name(depth) if depth else "",
        "y": names,
        "x": values,
        "marker": {"color": style.colour_of(depth)},
        "error_x": {"type": "data", "symmetric": False, "array": above, "arrayminus": below, "width": 4},
    }
