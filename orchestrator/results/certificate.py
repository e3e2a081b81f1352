"""A run judged by the same run at half the step: what every number of the summary changes by."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from orchestrator.results.summary import RunSummary
    from orchestrator.scenario.scenario import Scenario

CERTIFIED = ("force_mean", "force_max", "moment_max", "least_gap_min", "amplitude_max", "stress_max")
"""Quantities whose largest changes the summary's text and the record name; the JSON holds all."""

_NAMES = ("bearing", "phase")
SECOND_ORDER = 4.0
"""Share by which the defect of a step falls when the step is halved; the tolerance falls with it."""


@dataclass(frozen=True)
class Difference:
    """One number of the summary at the step of the run and at half of it, in SI units.

    Attributes
    ----------
    quantity, phase, bearing : str
        Field of `BearingStatistics` or `ShaftStatistics`, phase, and bearing (empty for the shaft).
    value, at_half_step : float or None
        None where there is none, such as the first contact of surfaces that do not touch.
    difference : float or None
        The first less the second.
    relative : float or None
        Against the larger of the two in size.
    """

    quantity: str
    phase: str
    bearing: str
    value: float | None
    at_half_step: float | None
    difference: float | None
    relative: float | None


@dataclass(frozen=True)
class Certificate:
    """What halving the step changes.

    Attributes
    ----------
    outcome : str
        Of the run at half the step.
    step : float
        Its macro step in s.
    differences : tuple of Difference
        Of every number of both summaries.
    """

    outcome: str
    step: float
    differences: tuple[Difference, ...]

    def attributes(self) -> dict[str, Any]:
        """Attributes of the record: outcome and step, and the largest relative changes."""
        largest = {name: self.largest(name) for name in CERTIFIED}
        return {
            "half_step": self.step,
            "half_step_outcome": self.outcome,
            **{
                f"half_step_{name}": found.relative
                for name, found in largest.items()
                if found is not None and found.relative is not None
            },
        }

    def largest(self, quantity: str) -> Difference | None:
        """The largest relative difference of a quantity over phases and bearings."""
        found = [d for d in self.differences if d.quantity == quantity and d.relative is not None]
        return max(found, key=lambda d: d.relative or 0.0, default=None)


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
        by_key = {_key(asdict(other)): asdict(other) for other in others}
        for row in map(asdict, rows):
            other = by_key.get(_key(row))
            if other is None:
                continue
            for quantity, value in row.items():
                if quantity not in _NAMES:
                    yield _difference(quantity, row, value, other[quantity])


def _key(row: dict[str, Any]) -> tuple[str, str]:
    return row.get("bearing", ""), row["phase"]


def _difference(quantity: str, row: dict[str, Any], value: float | None, other: float | None) -> Difference:
    bearing, phase = _key(row)
    if value is None or other is None:
        return Difference(quantity, phase, bearing, value, other, None, None)
    difference = float(value - other)
    size = max(abs(value), abs(other))
    relative = abs(difference) / size if size > 0.0 and math.isfinite(size) else 0.0
    return Difference(quantity, phase, bearing, float(value), float(other), difference, relative)
