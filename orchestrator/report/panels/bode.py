"""Bode plot over speed, of runs whose speed changes: amplitude and phase of 1X at the probes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from orchestrator.report.encode import packed
from orchestrator.report.panels.panel import Panel, Trace, layout, line, stacked
from orchestrator.report.source import Result
from orchestrator.results.journals import probes_of
from orchestrator.results.signals.orders import probe_signals, tracked_order

MICRO = 1e6
TURNS, POINTS = 4.0, 400
"""Revolutions over which an amplitude is taken, and most points of a line."""


def bode(results: Sequence[Result]) -> Iterator[Panel]:
    """For each bearing 1X at the first probe over speed; nothing of runs at one speed."""
    speeds = {r.name: r.changing_speed for r in results if r.changing_speed is not None}
    names = dict.fromkeys(name for result in results for name in result.bearings)
    for bearing in names if speeds else ():
        having = [r for r in results if r.name in speeds and bearing in r.bearings]
        shown, traces = layout(showlegend=False), list[Trace]()
        degrees = math.degrees(probes_of(having[0].record)[0])
        above, below = stacked(shown, "speed [rev/min]", [f"1X at {degrees:.0f}° [µm]", "phase [°]"])
        shown[f"yaxis{below.y[1:]}"] |= {"range": [-180, 180], "dtick": 90}
        for result in having:
            speed = speeds[result.name]
            signal = probe_signals(result.journal(bearing), probes_of(result.record)[:1])[0]
            at, amplitude = tracked_order(result.time, signal, speed, turns=TURNS, points=POINTS)
            minute = packed(np.interp(at, result.time, speed) * 30.0 / math.pi)
            shape = np.abs(amplitude) * MICRO, np.degrees(np.angle(amplitude))
            for place, values in zip((above, below), shape, strict=True):
                start = line(result, result.name, **place.trace(result.name))
                traces.append(start | {"x": minute, "y": packed(values)})
        yield Panel("bode", f"{bearing}: 1X over speed", traces, shown, bearing, 380)
