"""Forces, gaps, contact and the shaft's maxima over time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from orchestrator.report.encode import packed
from orchestrator.report.panels.panel import CONTACT, Panel, axis, event_lines, layout, line, rows
from orchestrator.report.source import Result
from orchestrator.results.quantities import AMPLITUDE, FORCE, GAP, STRESS, Quantity
from orchestrator.results.signals.envelope import envelope

SAMPLES = 1200
"""Most samples of a line; every extreme of the record stays."""
Floats = NDArray[np.float64]


def _force(result: Result, bearing: str) -> Floats:
    return result.of("force_magnitude_max", bearing)


def _gap(result: Result, bearing: str) -> Floats:
    return result.of("least_gap_min", bearing)


def _contact(result: Result, bearing: str) -> Floats:
    return result.of("contact_force_max", bearing)


_ROWS: tuple[tuple[str, Quantity, Callable[[Result, str], Floats]], ...] = (
    ("force", FORCE, _force),
    ("least gap", GAP, _gap),
    ("contact force", FORCE, _contact),
)


def bearing_series(results: Sequence[Result]) -> Iterator[Panel]:
    """For each bearing its force, least gap and contact force, all results in the same axes."""
    names = dict.fromkeys(name for result in results for name in result.bearings)
    samples = max(300, SAMPLES // len(results))
    for bearing in names:
        having = [result for result in results if bearing in result.bearings]
        touching = any(result.touching(bearing).any() for result in having)
        table = _ROWS if touching else _ROWS[:2]
        traces, shown = [], layout(**event_lines(having), showlegend=False)
        for k, ((label, quantity, read), span) in enumerate(zip(table, rows(len(table)), strict=True)):
            values = [read(result, bearing) for result in having]
            largest = max(float(np.nanmax(np.abs(v), initial=0.0)) for v in values)
            unit = quantity.fitting(largest).fitting(largest)
            tail = str(k + 1) if k else ""
            below = k == len(table) - 1
            shown[f"yaxis{tail}"] = axis(f"{label} [{unit.unit}]", domain=span, anchor=f"x{tail}")
            shown[f"xaxis{tail}"] = axis(
                "time [s]" if below else "", anchor=f"y{tail}", showticklabels=below
            ) | ({"matches": "x"} if k else {})
            for result, series in zip(having, values, strict=True):
                traces.append(
                    line(
                        result,
                        result.name,
                        xaxis=f"x{tail}",
                        yaxis=f"y{tail}",
                        showlegend=k == 0,
                        legendgroup=result.name,
                    )
                    | _thinned(result.time, series * unit.factor, samples)
                )
            if quantity is GAP:
                shown["shapes"] = [*shown["shapes"], _zero(tail)]
        yield Panel(
            "series", f"{bearing}: force, least gap, contact", traces, shown, bearing, 170 * len(table) + 60
        )


def shaft_series(results: Sequence[Result]) -> Iterator[Panel]:
    """The largest amplitude and the largest normal stress along the shaft."""
    traces, shown = [], layout(**event_lines(results), showlegend=False)
    samples = max(300, 2 * SAMPLES // len(results))
    table = (("vibration_amplitude_max", AMPLITUDE), ("normal_stress_max", STRESS))
    for k, ((name, quantity), span) in enumerate(zip(table, rows(2), strict=True)):
        tail = str(k + 1) if k else ""
        label = f"{quantity.label.split()[-1]} [{quantity.unit}]"
        shown[f"yaxis{tail}"] = axis(label, domain=span, anchor=f"x{tail}", rangemode="tozero")
        shown[f"xaxis{tail}"] = axis("time [s]" if k else "", anchor=f"y{tail}", showticklabels=bool(k)) | (
            {"matches": "x"} if k else {}
        )
        for result in results:
            values = np.asarray(result.record[name].values, dtype=float) * quantity.factor
            start = line(
                result,
                result.name,
                xaxis=f"x{tail}",
                yaxis=f"y{tail}",
                showlegend=k == 0,
                legendgroup=result.name,
            )
            traces.append(start | _thinned(result.time, values, samples))
    yield Panel(
        "shaft", "Largest vibration amplitude and normal stress along the shaft", traces, shown, height=380
    )


def _thinned(time: Floats, values: Floats, samples: int) -> dict[str, object]:
    kept = envelope(values, samples)
    return {"x": packed(time[kept]), "y": packed(values[kept])}


def _zero(tail: str) -> dict[str, object]:
    """The line below which asperities are flattened."""
    look = {"color": CONTACT, "width": 1}
    return {
        "type": "line",
        "xref": "paper",
        "x0": 0,
        "x1": 1,
        "y0": 0,
        "y1": 0,
        "yref": f"y{tail}",
        "line": look,
    }
