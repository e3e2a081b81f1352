"""Orbits of the journals in their clearances."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from orchestrator.report.encode import packed
from orchestrator.report.panels.panel import CONTACT, INK, Panel, Trace, axis, layout
from orchestrator.report.source import Result
from orchestrator.results.journals import BEFORE, FIRST, LAST, orbit_parts
from orchestrator.results.relative_motion import room_of

MICRO = 1e6
SAMPLES, MARKS = 1600, 150
"""Most samples of a line, and most marks of contact."""
_EARLY, _LATE = "#9CC3E6", "#0B4F8A"
_LOOKS = {"before": ("#111111", 2.0), "behind the event": (_EARLY, 1.0), "end of the run": (_LATE, 1.4)}
"""Colour and width of each part."""


def orbits(results: Sequence[Result]) -> Iterator[Panel]:
    """A panel for each bearing and result; of one bearing all have the same axes."""
    names = dict.fromkeys(name for result in results for name in result.bearings)
    for bearing in names:
        having = [result for result in results if bearing in result.bearings]
        reach = max(_reach(result, bearing) for result in having)
        for result in having:
            title = bearing if len(results) == 1 else f"{bearing}, {result.name}"
            span = {"range": [-reach, reach], "constrain": "domain", "dtick": _tick(reach)}
            shown = layout(
                xaxis=axis("x [µm]", **span),
                yaxis=axis("y [µm]", scaleanchor="x", **span),
                showlegend=False,
                margin={"l": 50, "r": 6, "t": 6, "b": 40},
            )
            yield Panel("orbits", title, _traces(result, bearing), shown, height=290)


def _reach(result: Result, bearing: str) -> float:
    widest = 0.0 if (room := room_of(result.record, bearing)) is None else float(np.nanmax(np.abs(room)))
    return 1.08 * MICRO * max(widest, float(np.nanmax(np.abs(result.journal(bearing)))), 1e-9)


def _tick(reach: float) -> float:
    """A tick such that some five are on the axis."""
    power = 10.0 ** np.floor(np.log10(reach))
    return float(power * next(step for step in (0.2, 0.5, 1.0, 2.0, 5.0) if reach / (step * power) <= 2.8))


def _traces(result: Result, bearing: str) -> list[Trace]:
    journal = result.journal(bearing) * MICRO
    room, traces = room_of(result.record, bearing), list[Trace]()
    if room is not None:
        look = {"line": {"color": INK, "width": 1.6}, "mode": "lines", "hoverinfo": "skip"}
        if np.isfinite(room).all():
            look |= {"fill": "toself", "fillcolor": "#F6F3EA"}
        traces.append({"type": "scatter", **look, "name": "clearance", **_points(room * MICRO)})
    for part in orbit_parts(result.phases, result.turn):
        colour, width = _LOOKS.get(part.name, (_LATE, 1.4))
        chosen = np.flatnonzero(part.window.mask(result.time))
        chosen = chosen[:: max(1, -(-chosen.size // SAMPLES))]
        look = {"line": {"color": colour, "width": width}, "mode": "lines", "name": part.name}
        traces.append({"type": "scatter", **look, **_points(journal[:, chosen])})
    touching = np.flatnonzero(result.touching(bearing))
    if touching.size:
        force = result.of("contact_force", bearing)[touching]
        chosen = np.sort(touching[np.argsort(force)[-MARKS:]])
        look = {"mode": "markers", "marker": {"color": CONTACT, "size": 4}, "name": "solid contact"}
        traces.append({"type": "scatter", **look, **_points(journal[:, chosen])})
    if np.isnan(result.of("least_gap", bearing)).all():  # without a bore
        return traces
    worst = int(np.nanargmin(result.of("least_gap", bearing)))
    text = f"least gap {result.of('least_gap', bearing)[worst] * MICRO:.1f} µm at {result.time[worst]:.4f} s"
    star = {"symbol": "star", "size": 8, "color": "#F2B705", "line": {"color": INK, "width": 1}}
    marked = {"mode": "markers", "marker": star, "name": text}
    traces.append({"type": "scatter", **marked, **_points(journal[:, [worst]])})
    return traces


def _points(places: NDArray[np.float64]) -> Trace:
    return {"x": packed(places[0], 0.02), "y": packed(places[1], 0.02)}


LEGEND = (
    ("—", "#111111", f"last {BEFORE:g} revolutions before the event"),
    ("—", _EARLY, f"first {FIRST:g} behind it"),
    ("—", _LATE, f"last {LAST:g} of the run"),
    ("●", CONTACT, "solid contact"),
    ("★", "#F2B705", "least gap of the run"),
    ("○", INK, "clearance: within it the journal's centre can move without tilt"),
)
"""Signs, their colours, and what they stand for."""
