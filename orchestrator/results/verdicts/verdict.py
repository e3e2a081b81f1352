"""A verdict: one limit, held against one figure of a run."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

from orchestrator.results.quantities import Quantity


class Grade(StrEnum):
    """How a figure stands to its limit, the worst last."""

    WITHIN = "within"
    CLOSE = "close"
    BEYOND = "beyond"

    @property
    def rank(self) -> int:
        """0 for the best."""
        return list(Grade).index(self)


_SHOWN = 9.99  # largest share that is told; none is of a gap below zero
CLOSE_FROM = 0.9
"""Share of a limit from which a figure is called close to it."""


class Source(Protocol):
    """Where a limit is from, and whether that was read."""

    @property
    def source(self) -> str: ...  # noqa: D102

    @property
    def read(self) -> bool: ...  # noqa: D102


@dataclass(frozen=True)
class Verdict:
    """One limit held against one figure.

    Attributes
    ----------
    limit : str
        Name of the limit.
    phase, bearing : str
        Where; the bearing is empty for the shaft.
    quantity : Quantity
        How value and bound are shown.
    value, bound : float
        Figure and limit in SI units.
    share : float
        How much of the limit is used: 1 at the limit, more beyond it; of a least value, limit over figure.
    grade : Grade
        The verdict.
    note : str
        Such as the zone.
    instant : float or None
        When the figure arose [s].
    source : str
        Of the limit.
    read : bool
        Whether the source was read, or the limit recalled.
    trips : bool
        Whether a machine beyond this limit is shut down at once.
    """

    limit: str
    phase: str
    bearing: str
    quantity: Quantity
    value: float
    bound: float
    share: float
    grade: Grade
    note: str = ""
    instant: float | None = None
    source: str = ""
    read: bool = True
    trips: bool = False

    @property
    def place(self) -> str:
        """The bearing, or the shaft."""
        return self.bearing or "shaft"

    def fitting(self) -> Quantity:
        """The unit in which both value and bound can be read."""
        largest = max(abs(self.value), abs(self.bound))
        return self.quantity.fitting(largest).fitting(largest)

    def value_text(self) -> str:
        """The figure with its unit."""
        return self.fitting().text(self.value).strip()

    def bound_text(self) -> str:
        """The limit with its unit; nothing is allowed of what has the limit 0."""
        return "none" if self.bound == 0.0 else self.fitting().text(self.bound).strip()

    def share_text(self) -> str:
        """The share in per cent."""
        if self.bound == 0.0:
            return "-"
        return "> 999 %" if self.share > _SHOWN else f"{100.0 * self.share:.0f} %"

    def source_text(self) -> str:
        """The source, and whether it was read."""
        return self.source + ("" if self.read else " (recalled)")


def held(
    limit: Source,
    words: str,
    place: tuple[str, str],
    quantity: Quantity,
    value: float,
    bound: float,
    *,
    share: float | None = None,
    note: str = "",
    instant: float | None = None,
    trips: bool = False,
) -> Verdict:
    """Hold a value against a bound; its share of it is value over bound if it is not given."""
    if share is None:
        share = value / bound if bound > 0.0 else math.inf
    grade = Grade.BEYOND if share > 1.0 else Grade.CLOSE if share >= CLOSE_FROM else Grade.WITHIN
    return Verdict(
        words, *place, quantity, value, bound, share, grade, note, instant, limit.source, limit.read, trips
    )


def worst(verdicts: Iterable[Verdict]) -> tuple[Verdict, ...]:
    """Of each limit in each phase the verdict at the place where the most of it is used, the worst first."""
    best: dict[tuple[str, str], Verdict] = {}
    for verdict in verdicts:
        key = verdict.limit, verdict.phase
        if key not in best or _order(verdict) > _order(best[key]):
            best[key] = verdict
    return tuple(sorted(best.values(), key=_order, reverse=True))


def _order(verdict: Verdict) -> tuple[int, bool, float, float]:
    return verdict.grade.rank, verdict.trips, verdict.share, abs(verdict.value)
