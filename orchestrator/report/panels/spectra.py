"""Spectra and waterfalls of the journals, as probes read them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from orchestrator.report.encode import packed
from orchestrator.report.panels.panel import (
    EVENT,
    Panel,
    Place,
    Trace,
    axis,
    events_of,
    layout,
    line,
    stacked,
)
from orchestrator.report.source import Result
from orchestrator.results.journals import (
    FLOOR,
    HIGHEST,
    HIGHEST_OVER_TIME,
    probe_spectrum,
    probe_waterfall,
    probes_of,
    steady_window,
)
from orchestrator.results.signals.orders import NAMED
from orchestrator.results.signals.spectrum import Spectrum

MICRO = 1e6
DECADES = 5.0
"""Of amplitudes that are shown."""
SMALLEST = FLOOR * MICRO
"""Smallest amplitude drawn [µm]."""


def spectra(results: Sequence[Result]) -> Iterator[Panel]:
    """For each bearing the amplitudes at both probes before the event and after it."""
    names = dict.fromkeys(name for result in results for name in result.bearings)
    for bearing in names:
        having = [result for result in results if bearing in result.bearings]
        angles = probes_of(having[0].record)
        traces: list[Trace] = []
        shown = layout(
            showlegend=True,
            legend={"orientation": "h", "x": 0.8, "xanchor": "right", "y": 1.07, "yanchor": "bottom"},
            margin={"l": 62, "r": 14, "t": 62, "b": 44},
            **order_lines(having[0], HIGHEST),
        )
        titles = [f"{math.degrees(angle):.0f}° [µm]" for angle in angles]
        over_orders = having[0].changing_speed is not None
        having = [result for result in having if (result.changing_speed is not None) == over_orders]
        abscissa, highest = ("order of the speed", HIGHEST)
        if not over_orders:
            abscissa, highest = "frequency [Hz]", HIGHEST / having[0].turn
        look = {"type": "log", "dtick": 1, "tickformat": "~g"}
        places = stacked(shown, abscissa, titles, gap=0.09, span=(0.0, highest), **look)
        top = 1e-3
        for angle, place in zip(angles, places, strict=True):
            for result in having:
                for trace, largest in _lines(result, bearing, angle, place, several=len(results) > 1):
                    traces.append(trace)
                    top = max(top, largest)
        if not traces:
            continue
        for place in places:
            end = math.log10(2.0 * top)
            shown[f"yaxis{place.y[1:]}"]["range"] = [max(end - DECADES, math.log10(SMALLEST)), end]
        yield Panel("spectra", f"{bearing}: spectrum of the journal's motion", traces, shown, bearing, 420)


def waterfalls(results: Sequence[Result]) -> Iterator[Panel]:
    """For each bearing and result the amplitudes over frequency and time, in one scale of colours."""
    names = dict.fromkeys(name for result in results for name in result.bearings)
    for bearing in names:
        found = {r.name: (r, _waterfall(r, bearing)) for r in results if bearing in r.bearings}
        drawn = {name: (r, w) for name, (r, w) in found.items() if w is not None}
        if not drawn:
            continue
        top = max(float(np.log10(np.maximum(w.amplitude, SMALLEST)).max()) for _, w in drawn.values())
        for name, (result, fall) in drawn.items():
            title = f"{bearing}: waterfall" + (f", {name}" if len(results) > 1 else "")
            yield _waterfall_panel(result, fall, bearing, title, top)


def order_lines(result: Result, highest: float) -> dict[str, Any]:
    """Lines at the named orders of the speed; where it changes, over orders."""
    turn = 1.0 if result.changing_speed is not None else 1.0 / result.turn
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


def _lines(
    result: Result, bearing: str, angle: float, place: Place, *, several: bool
) -> Iterator[tuple[Trace, float]]:
    """A line of each phase, and its largest amplitude [µm]."""
    shown = {"before": ("before", 1.0, "dot"), "steady": ("lasting", 1.3, "solid")}
    for phase in result.phases:
        last = "solid" if phase is result.phases[-1] else "dash"
        name, width, dash = shown.get(phase.name, (phase.name, 1.5, last))
        window = steady_window(phase, result.turn)
        motion, speed = result.journal(bearing), result.changing_speed
        found = probe_spectrum(result.time, motion, angle, window, result.turn, speed)
        if found is None:
            continue
        label = f"{result.name}, {name}" if several else name
        colour = result.colour if several or name != "before" else "#555555"
        look = {"width": width, "dash": dash, "color": colour}
        start = line(result, label, line=look, **place.trace(label))
        values = {"x": packed(found.frequency, 1e-3), "y": packed_log(found.amplitude * MICRO)}
        yield start | values, float(found.amplitude.max()) * MICRO


def packed_log(values: Any) -> dict[str, Any]:
    """Positive numbers over many decades."""
    return packed(np.log10(np.maximum(values, SMALLEST)), 1e-4) | {"power": True}


def _waterfall(result: Result, bearing: str) -> Spectrum | None:
    """In µm."""
    angle = probes_of(result.record)[0]
    found = probe_waterfall(result.time, result.journal(bearing), angle, result.turn)
    return None if found is None else replace(found, amplitude=found.amplitude * MICRO)


def _waterfall_panel(result: Result, fall: Spectrum, bearing: str, title: str, top: float) -> Panel:
    assert fall.time is not None
    bottom = top - 4.0
    ticks = [k for k in range(-4, 6) if bottom <= k <= top]
    heat = {
        "type": "heatmap",
        "x": packed(fall.frequency, 1e-3),
        "y": packed(fall.time),
        "z": packed(np.log10(np.maximum(fall.amplitude, SMALLEST)), 2e-3),
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
    orders = order_lines(result, HIGHEST_OVER_TIME) if result.changing_speed is None else {}
    shown = layout(xaxis=axis("frequency [Hz]"), yaxis=axis("time [s]"), **orders)
    lines = [*shown.get("shapes", []), *_happening(result, fall.time)]
    shown["shapes"] = [{**shape, "line": shape["line"] | {"color": "white"}} for shape in lines]
    return Panel("waterfall", title, [heat, *_orders_over_time(result, fall)], shown, bearing, 340)


def _happening(result: Result, time: Any) -> Iterator[dict[str, Any]]:
    """A line across at each event within a waterfall."""
    for at in events_of([result]):
        if time[0] <= at <= time[-1]:
            ends = {"x0": 0, "x1": 1, "xref": "paper", "y0": at, "y1": at}
            yield {"type": "line", **ends, "line": {"width": 1, "dash": "dash"}}


def _orders_over_time(result: Result, fall: Spectrum) -> Iterator[Trace]:
    """Lines of the orders that follow a changing speed, with their names."""
    speed = result.changing_speed
    if speed is None or fall.time is None:
        return
    for order, name in NAMED.items():
        frequency = np.interp(fall.time, result.time, speed) * order / (2.0 * math.pi)
        frequency[frequency > float(fall.frequency.max())] = np.nan
        if np.isnan(frequency).all():
            continue
        last = int(np.flatnonzero(np.isfinite(frequency))[-1])
        yield {
            "type": "scatter",
            "mode": "lines+text",
            "name": name,
            "text": [name if k == last else "" for k in range(frequency.size)],
            "textposition": "bottom right",
            "textfont": {"color": "white", "size": 11},
            "x": [None if np.isnan(x) else round(float(x), 4) for x in frequency],
            "y": [round(float(t), 5) for t in fall.time],
            "line": {"color": "white", "width": 1, "dash": "dot"},
            "showlegend": False,
            "hoverinfo": "name",
        }
