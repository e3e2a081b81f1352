"""Forces, gaps, contact and the shaft's maxima over time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from orchestrator.report.encode import packed
from orchestrator.report.panels.panel import (
    CONTACT,
    Panel,
    Place,
    Trace,
    event_lines,
    layout,
    line,
    stacked,
    time_span,
)
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
        values = [[read(result, bearing) for result in having] for _, _, read in table]
        units = [_fitting(quantity, own) for (_, quantity, _), own in zip(table, values, strict=True)]
        shown = layout(**event_lines(having), showlegend=False)
        titles = [f"{label} [{unit.unit}]" for (label, _, _), unit in zip(table, units, strict=True)]
        places = stacked(shown, "time [s]", titles, span=time_span(results), rangemode="tozero")
        shown["shapes"] = [*shown["shapes"], _zero(places[1])]
        traces = _curves(having, places, values, units, samples)
        yield Panel(
            "series", f"{bearing}: force, least gap, contact", traces, shown, bearing, 170 * len(table) + 80
        )


def shaft_series(results: Sequence[Result]) -> Iterator[Panel]:
    """The largest amplitude and the largest normal stress along the shaft."""
    samples = max(300, 2 * SAMPLES // len(results))
    table = {"vibration_amplitude_max": AMPLITUDE, "normal_stress_max": STRESS}
    shown = layout(**event_lines(results), showlegend=False)
    titles = [f"{quantity.label.split()[-1]} [{quantity.unit}]" for quantity in table.values()]
    places = stacked(shown, "time [s]", titles, span=time_span(results), rangemode="tozero")
    values = [[np.asarray(r.record[name].values, dtype=float) for r in results] for name in table]
    traces = _curves(results, places, values, list(table.values()), samples)
    yield Panel(
        "shaft", "Largest vibration amplitude and normal stress along the shaft", traces, shown, height=380
    )


def _fitting(quantity: Quantity, values: Sequence[Floats]) -> Quantity:
    """The quantity in a unit in which the largest value can be read."""
    largest = max(float(np.nanmax(np.abs(v), initial=0.0)) for v in values)
    return quantity.fitting(largest).fitting(largest)


def _curves(
    results: Sequence[Result],
    places: Sequence[Place],
    values: Sequence[Sequence[Floats]],
    units: Sequence[Quantity],
    samples: int,
) -> list[Trace]:
    """A line of each result in each of the axes."""
    return [
        line(result, result.name, **place.trace(result.name))
        | _thinned(result.time, series * unit.factor, samples)
        for place, own, unit in zip(places, values, units, strict=True)
        for result, series in zip(results, own, strict=True)
    ]


def _thinned(time: Floats, values: Floats, samples: int) -> dict[str, object]:
    kept = envelope(values, samples)
    return {"x": packed(time[kept]), "y": packed(values[kept])}


def _zero(place: Place) -> dict[str, object]:
    """The line below which asperities are flattened."""
    look = {"color": CONTACT, "width": 1}
    return {
        "type": "line",
        "xref": "paper",
        "x0": 0,
        "x1": 1,
        "y0": 0,
        "y1": 0,
        "yref": place.y,
        "line": look,
    }
