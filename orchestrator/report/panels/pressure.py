"""Pressure in the films at the worst instants, with lines of equal gap."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from orchestrator.report.encode import packed
from orchestrator.report.panels.panel import CONTACT, Panel, axis, layout
from orchestrator.report.source import Result
from orchestrator.results.worst_film import WorstFilm, worst_films

Floats = NDArray[np.float64]

COLUMNS, ROWS = 73, 17
ROUND = [k * 10.0**power for power in range(4, -7, -1) for k in (5, 2, 1)]
"""Pressures that stand at the scale of colours [MPa]."""
_MEGA, _MILLI, _MICRO = 1e-6, 1e3, 1e6


def film_pressures(results: Sequence[Result]) -> Iterator[Panel]:
    """A panel for each bearing, result and instant; of one bearing all have the same colours."""
    names = dict.fromkeys(name for result in results for name in result.bearings)
    for bearing in names:
        found = [
            (result, worst)
            for result in results
            if bearing in result.bearings
            for worst in worst_films(result.record, bearing, columns=COLUMNS, rows=ROWS)
        ]
        if not found:
            continue
        top = max(float(worst.film.pressure.max()) for _, worst in found) * _MEGA
        for result, worst in found:
            name = f"{bearing}, {result.name}" if len(results) > 1 else bearing
            title = f"{name}: {worst.name}, {worst.text} at {worst.time:.4f} s"
            yield _panel(bearing, title, worst, top)
            if worst.film.content is not None:
                title = f"{name}: share of the gap that oil fills, {worst.name}, at {worst.time:.4f} s"
                yield _content(bearing, title, worst.film.angle, worst.film.z, worst.film.content)


def _content(bearing: str, title: str, angle: Floats, z: Floats, content: Floats) -> Panel:
    """Where oil fills the gap."""
    heat = {
        "type": "heatmap", "x": packed(np.degrees(angle)), "y": packed(z * _MILLI), "zmin": 0.0, "zmax": 1.0,
        "z": packed(content, 1e-3), "colorscale": "Blues", "reversescale": False,
        "colorbar": {"title": {"text": "1"}, "thickness": 12},
        "hovertemplate": "%{x:.0f}°, z %{y:.0f} mm: %{z:.3f}<extra></extra>",
    }  # fmt: skip
    return Panel("pressure", title, [heat], _axes(), bearing, 250)


def _axes() -> dict[str, Any]:
    return layout(
        xaxis=axis("angle from x towards y [°]", dtick=90, minor={"dtick": 45}, range=[0, 360]),
        yaxis=axis("z [mm]"),
        showlegend=False,
    )


def _panel(bearing: str, title: str, worst: WorstFilm, top: float) -> Panel:
    film = worst.film
    angle, z, gap = np.degrees(film.angle), film.z * _MILLI, film.gap * _MICRO
    common = {"x": packed(angle), "y": packed(z)}
    ticks = [tick for tick in ROUND if 0.03 * top <= tick <= top] + [0.0]
    heat = {
        "type": "heatmap", **common, "z": packed(np.sqrt(film.pressure * _MEGA), 1e-3 * np.sqrt(top)),
        "customdata": packed(film.pressure * _MEGA, 1e-3 * top), "zmin": 0.0, "zmax": float(np.sqrt(top)),
        "zsmooth": "best", "colorscale": "Cividis",
        "colorbar": {
            "title": {"text": "MPa"}, "thickness": 12, "tickvals": list(np.sqrt(ticks)),
            "ticktext": [f"{tick:g}" for tick in ticks],
        },
        "hovertemplate": "%{x:.0f}°, z %{y:.0f} mm: %{customdata:.2f} MPa<extra></extra>",
    }  # fmt: skip
    lines = {
        "type": "contour", **common, "z": packed(gap, 0.05), "showscale": False, "hoverinfo": "skip",
        "contours": {"coloring": "none", "showlabels": True, "labelfont": {"size": 10, "color": "white"}},
        "ncontours": 8, "line": {"width": 0.8, "color": "white"},
    }  # fmt: skip
    j, i = np.unravel_index(int(np.nanargmin(gap)), gap.shape)
    mark = {
        "type": "scatter", "mode": "markers", "x": [float(angle[i])], "y": [float(z[j])],
        "marker": {"symbol": "x", "size": 9, "color": CONTACT, "line": {"width": 1, "color": "white"}},
        "hovertemplate": f"least gap {float(gap[j, i]):.1f} µm<extra></extra>",
    }  # fmt: skip
    return Panel("pressure", title, [heat, lines, mark], _axes(), bearing, 250)
