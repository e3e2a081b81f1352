"""What every number of a summary changes by at half the step; `orchestrator.case.certify` makes it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

CERTIFIED = ("force_mean", "force_max", "moment_max", "least_gap_min", "amplitude_max", "stress_max")
"""Quantities whose largest changes the summary's text and the record name; the JSON holds all."""

ALLOWED = 0.1
"""Change at half the step, of `CERTIFIED` against `Difference.scale`, up to which a run is certified."""


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
    scale : float
        What a change of this number counts by: the larger of the two, or more where both are small.
    """

    quantity: str
    phase: str
    bearing: str
    value: float | None
    at_half_step: float | None
    difference: float | None
    relative: float | None
    scale: float = 0.0

    @property
    def counted(self) -> float:
        """Size of the difference against `scale`."""
        return abs(self.difference or 0.0) / self.scale if self.scale > 0.0 else 0.0


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

    @property
    def doubt(self) -> str:
        """Empty, or the change by which a run is not certified."""
        certified = [d for d in self.differences if d.quantity in CERTIFIED]
        worst = max(certified, key=lambda d: d.counted, default=None)
        if worst is None or worst.counted <= ALLOWED:
            return ""
        where = " ".join(part for part in (worst.bearing, worst.phase) if part)
        return (
            f"at half the step {worst.quantity.replace('_', ' ')} ({where}) is {worst.at_half_step:.4g} "
            f"instead of {worst.value:.4g}, a change of {100 * worst.counted:.3g} %; allowed are "
            f"{100 * ALLOWED:g} %"
        )

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
