"""A run judged by the same run at half the step."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

from orchestrator.results.certificate import Certificate, Difference
from orchestrator.results.summary import RunSummary
from orchestrator.scenario.scenario import Scenario

_NAMES = ("bearing", "phase")
_MEANS = {"least_gap_min": "least_gap_mean", "centre_line_gap_min": "centre_line_gap_mean"}
"""Least gaps, whose changes count by the mean gap where that is more: they may be next to nothing."""

_SMALL = 0.1
"""Share of the largest value of a quantity in a run by which the changes of small ones count: a moment that
is next to nothing may double."""
SECOND_ORDER = 4.0
"""Share by which the defect of a step falls when the step is halved; the tolerance falls with it."""


def at_half_step(scenario: Scenario) -> Scenario:
    """The same scenario at half the step, recorded at the same instants; a tolerance falls to a quarter."""
    stride = max(1, round(scenario.record.interval / scenario.step))
    changes: dict[str, Any] = {
        "step": scenario.step / 2.0,
        "record": scenario.record.model_copy(update={"interval": stride * scenario.step}),
    }
    if scenario.tolerance is not None:
        changes["tolerance"] = scenario.tolerance / SECOND_ORDER
    return scenario.model_copy(update=changes)


def certify(summary: RunSummary, half: RunSummary) -> Certificate:
    """Compare a run with the same run at half the step."""
    return Certificate(half.outcome, half.macro_step, tuple(_differences(summary, half)))


def _differences(summary: RunSummary, half: RunSummary) -> Iterator[Difference]:
    for rows, others in ((summary.bearings, half.bearings), (summary.shaft, half.shaft)):
        found = [asdict(row) for row in rows]
        by_key = {_key(asdict(other)): asdict(other) for other in others}
        for row in found:
            other = by_key.get(_key(row))
            if other is None:
                continue
            for quantity, value in row.items():
                if quantity not in _NAMES:
                    yield _difference(quantity, row, found, value, other[quantity])


def _key(row: dict[str, Any]) -> tuple[str, str]:
    return row.get("bearing", ""), row["phase"]


def _difference(
    quantity: str, row: dict[str, Any], rows: list[dict[str, Any]], value: float | None, other: float | None
) -> Difference:
    """Compare a number of a row of a summary, which has these rows, with that at half the step."""
    bearing, phase = _key(row)
    if value is None or other is None:
        return Difference(quantity, phase, bearing, value, other, None, None)
    difference = float(value - other)
    size = max(abs(value), abs(other))
    relative = abs(difference) / size if size > 0.0 and math.isfinite(size) else 0.0
    if quantity in _MEANS:
        floor = abs(row[_MEANS[quantity]])
    else:
        floor = _SMALL * max(abs(r[quantity]) for r in rows if r[quantity] is not None)
    scale = max(size, floor)
    return Difference(quantity, phase, bearing, float(value), float(other), difference, relative, scale)
