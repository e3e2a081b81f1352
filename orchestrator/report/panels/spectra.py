"""Spectra and waterfalls of the journals, as probes read them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from orchestrator.report.encode import packed
from orchestrator.report.panels.panel import EVENT, Panel, Trace, axis, layout, line, rows
from orchestrator.report.source import Result
from orchestrator.results.signals.orders import NAMED, probe_signals
from orchestrator.results.signals.spectrum import Spectrum, spectrum, waterfall
from orchestrator.results.verdicts.judge import own_limits
from orchestrator.results.windows import Phase, Window

HIGHEST = 6.0
"""Order of the speed up to which spectra are drawn."""
LENGTH, SLICES = 8.0, 80
"""Revolutions of a slice of a waterfall, and how many slices."""
STEADY = 20.0
"""Revolutions before an event of which the spectrum is made."""
FLOOR = 1e-3
"""Smallest amplitude drawn [µm]."""
DEFAULT_PROBES = (math.pi / 4.0, 3.0 * math.pi / 4.0)


def spectra(results: Sequence[Result]) -> Iterator[Panel]:
    """For each bearing the amplitudes at both probes before the event and after it."""
    names = dict.fromkeys(name for result in results for name in result.bearings)
    for bearing in names:
        having = [result for result in results if bearing in result.bearings]
        angles = probes_of(having[0])
        spans = rows(len(angles), 0.09)
        traces: list[Trace] = []
        shown = layout(
            showlegend=True,
            legend={"orientation": "h", "x": 1, "xanchor": "right", "y": 1.07, "yanchor": "bottom"},
            margin={"l": 62, "r": 14, "t": 46, "b": 44},
            **order_lines(having[0], HIGHEST),
        )
        for k, (angle, span) in enumerate(zip(angles, spans, strict=True)):
            tail = str(k + 1) if k else ""
            below = k == len(angles) - 1
            title = f"{math.degrees(angle):.0f}° [µm]"
            shown[f"yaxis{tail}"] = axis(
                title, domain=span, anchor=f"x{tail}", type="log", exponentformat="power"
            )
            shown[f"xaxis{tail}"] = axis(
                "frequency [Hz]" if below else "", anchor=f"y{tail}", showticklabels=below
            ) | ({"matches": "x"} if k else {})
            for result in having:
                traces += _lines(result, bearing, angle, tail, several=len(results) > 1)
        yield Panel("spectra", f"{bearing}: spectrum of the journal's motion", traces, shown, bearing, 420)


def waterfalls(results: Sequence[Result]) -> Iterator[Panel]:
    """For each bearing and result the amplitudes over frequency and time, in one scale of colours."""
    names = dict.fromkeys(name for result in results for name in result.bearings)
    for bearing in names:
        found = {r.name: (r, _waterfall(r, bearing)) for r in results if bearing in r.bearings}
        drawn = {name: (r, w) for name, (r, w) in found.items() if w is not None}
        if not drawn:
            continue
        top = max(float(np.log10(np.maximum(w.amplitude, FLOOR)).max()) for _, w in drawn.values())
        for name, (result, fall) in drawn.items():
            title = f"{bearing}: waterfall" + (f", {name}" if len(results) > 1 else "")
            yield _waterfall_panel(result, fall, bearing, title, top)


def probes_of(result: Result) -> tuple[float, ...]:
    """Angles of the probes in rad."""
    limit = own_limits(result.record).shaft_vibration
    return DEFAULT_PROBES if limit is None else limit.probes


def order_lines(result: Result, highest: float) -> dict[str, Any]:
    """Lines at the named orders of the speed."""
    turn = abs(result.speed) / (2.0 * math.pi)
    look = {"color": EVENT, "width": 1, "dash": "dot"}
    shapes = [
        {"type": "line", "x0": k * turn, "x1": k * turn, "y0": 0, "y1": 1, "yref": "paper", "line": look}
        for k in NAMED
        if k < highest
    ]
    notes = [
        {"x": k * turn, "y": 1, "yref": "paper", "text": name, "showarrow": False, "yanchor": "bottom",
         "font": {"size": 11, "color": EVENT}}
        for k, name in NAMED.items()
        if k < highest
    ]  # fmt: skip
    return {"shapes": shapes, "annotations": notes}


def _lines(result: Result, bearing: str, angle: float, tail: str, *, several: bool) -> Iterator[Trace]:
    shown = {"before": ("before", 1.0, "dot"), "steady": ("lasting", 1.3, "solid")}
    for phase in result.phases:
        name, width, dash = shown.get(phase.name, (phase.name, 1.5, "solid"))
        found = _spectrum(result, bearing, angle, _window(result, phase))
        if found is None:
            continue
        label = f"{result.name}, {name}" if several else name
        colour = result.colour if several or name != "before" else "#555555"
        look = {"width": width, "dash": dash, "color": colour}
        yield line(
            result,
            label,
            line=look,
            xaxis=f"x{tail}",
            yaxis=f"y{tail}",
            showlegend=not tail,
            legendgroup=label,
        ) | {"x": packed(found.frequency, 1e-3), "y": packed_log(found.amplitude)}


def _window(result: Result, phase: Phase) -> Window:
    """Where the motion is steady: before an event the last revolutions, or else where means are taken."""
    if phase.name != "before":
        return phase.mean
    turn = 2.0 * math.pi / abs(result.speed)
    return Window(max(phase.span.start, phase.span.end - STEADY * turn), phase.span.end)


def packed_log(values: Any) -> dict[str, Any]:
    """Positive numbers over many decades."""
    return packed(np.log10(np.maximum(values, FLOOR)), 1e-4) | {"power": True}


def _spectrum(result: Result, bearing: str, angle: float, window: Window) -> Spectrum | None:
    """Of as many whole pairs of revolutions as the window holds, so that half orders lie on a line."""
    turn, time = 2.0 * math.pi / abs(result.speed), result.time
    pairs = math.floor(window.length / (2.0 * turn) + 1e-6)
    start = window.end - 2.0 * turn * max(pairs, 1)
    step = (time[-1] - time[0]) / (time.size - 1)
    chosen = (time > max(start, time[0]) - 0.5 * step) & (time < window.end - 0.5 * step)
    if np.count_nonzero(chosen) < 8:
        return None
    signal = probe_signals(result.journal(bearing)[:, chosen], [angle])[0]
    found = spectrum(time[chosen], signal * 1e6)
    inside = (found.frequency > 0.0) & (found.frequency <= HIGHEST / turn)
    return Spectrum(found.frequency[inside], found.amplitude[inside])


def _waterfall(result: Result, bearing: str) -> Spectrum | None:
    turn, time = 2.0 * math.pi / abs(result.speed), result.time
    length = min(LENGTH, math.floor((time[-1] - time[0]) / turn / 2.0)) * turn
    if length < 2.0 * turn:
        return None
    signal = probe_signals(result.journal(bearing), probes_of(result)[:1])[0]
    found = waterfall(time, signal * 1e6, length, slices=SLICES)
    inside = (found.frequency > 0.0) & (found.frequency <= 4.0 / turn)
    return Spectrum(found.frequency[inside], found.amplitude[:, inside], found.time)


def _waterfall_panel(result: Result, fall: Spectrum, bearing: str, title: str, top: float) -> Panel:
    assert fall.time is not None
    bottom = top - 4.0
    ticks = [k for k in range(-4, 6) if bottom <= k <= top]
    heat = {
        "type": "heatmap",
        "x": packed(fall.frequency, 1e-3),
        "y": packed(fall.time),
        "z": packed(np.log10(np.maximum(fall.amplitude, FLOOR)), 2e-3),
        "zmin": bottom,
        "zmax": top,
        "colorscale": "Viridis",
        "colorbar": {
            "title": {"text": "µm"},
            "tickvals": ticks,
            "ticktext": [f"{10.0**k:g}" for k in ticks],
            "thickness": 12,
        },
        "hovertemplate": "%{x:.1f} Hz, %{y:.3f} s: 10^%{z:.2f} µm<extra></extra>",
    }  # fmt: skip
    shown = layout(xaxis=axis("frequency [Hz]"), yaxis=axis("time [s]"), **order_lines(result, 4.0))
    shown["shapes"] = [{**shape, "line": shape["line"] | {"color": "white"}} for shape in shown["shapes"]]
    shown["margin"] = shown["margin"] | {"t": 26}
    return Panel("waterfall", title, [heat], shown, bearing, 340)
