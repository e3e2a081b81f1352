"""What a row of the table asks: values that must lie between bounds, and the verdict over them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from orchestrator.results.quantities import Quantity, shown
from orchestrator.study.paper.published import Published


class Verdict(StrEnum):
    """What a row of the table comes to."""

    MET = "met"
    MISSED = "missed"
    NOT_EVALUATED = "not evaluated"


@dataclass(frozen=True)
class Requirement:
    """A value with its bounds, SI units.

    Attributes
    ----------
    label : str
        Of what.
    value : float
        Found here.
    low, high : float
        Bounds; infinite where there is none.
    quantity : Quantity
        How the value is shown.
    target : float or None
        The middle of the bounds where the paper states a figure.
    strict : bool
        Whether a value on a bound is outside.
    """

    label: str
    value: float
    low: float
    high: float
    quantity: Quantity
    target: float | None = None
    strict: bool = False

    @classmethod
    def near(cls, label: str, value: float, published: Published, quantity: Quantity) -> Requirement:
        """As published, within its tolerance."""
        width = published.tolerance * abs(published.value)
        low, high = published.value - width, published.value + width
        return cls(label, value, low, high, quantity, published.value)

    @classmethod
    def above(
        cls, label: str, value: float, low: float, quantity: Quantity, *, strict: bool = False
    ) -> Requirement:
        """At least `low`; more than it when `strict`."""
        return cls(label, value, low, math.inf, quantity, strict=strict)

    @classmethod
    def below(
        cls, label: str, value: float, high: float, quantity: Quantity, *, strict: bool = False
    ) -> Requirement:
        """At most `high`; less than it when `strict`."""
        return cls(label, value, -math.inf, high, quantity, strict=strict)

    @property
    def met(self) -> bool:
        """Whether the value is inside; what is not a number never is."""
        if self.strict:
            return self.low < self.value < self.high
        return self.low <= self.value <= self.high

    @property
    def excess(self) -> float:
        """How far outside the bounds, as a share of the target or of the bound missed; 0 inside."""
        if self.met:
            return 0.0
        bound = self.high if self.value >= self.high else self.low
        scale = abs(self.target if self.target is not None else bound)
        return abs(self.value - bound) / scale if scale > 0 else math.inf

    def miss(self) -> str:
        """By how much the requirement is missed, in words; empty when it is met."""
        if self.met:
            return ""
        value = shown(self.value, self.quantity)
        if self.target is not None:
            off = self.value / self.target - 1.0
            allowed = (self.high - self.target) / abs(self.target)
            return f"{self.label}: {100 * off:+.3g} %, allowed ±{100 * allowed:.0f} %"
        too_large = self.value >= self.high
        bound = self.high if too_large else self.low
        words = (
            ("below" if too_large else "above") if self.strict else ("at most" if too_large else "at least")
        )
        return f"{self.label}: {value}, required {words} {shown(bound, self.quantity)}"


@dataclass(frozen=True)
class Row:
    """A row of the table.

    Attributes
    ----------
    number : int
        1 to 14.
    quantity, paper, here : str
        What is compared, what the paper says of it, what was found.
    definition : str
        How the value is computed and when the row is met.
    source : str
        Where the paper says it.
    requirements : tuple of Requirement
        The row is met when all are.
    obstacle : str
        Why the row cannot be evaluated; empty when it can.
    reason : str
        For a row that is missed: why, as far as it was found.
    """

    number: int
    quantity: str
    paper: str
    here: str
    definition: str
    source: str
    requirements: tuple[Requirement, ...] = ()
    obstacle: str = ""
    reason: str = ""

    @property
    def verdict(self) -> Verdict:
        """Computed from the requirements, never given."""
        if self.obstacle or not self.requirements:
            return Verdict.NOT_EVALUATED
        return Verdict.MET if all(item.met for item in self.requirements) else Verdict.MISSED

    @property
    def missed_by(self) -> str:
        """Every requirement missed, the worst first."""
        missed = sorted((item for item in self.requirements if not item.met), key=lambda item: -item.excess)
        return "; ".join(item.miss() for item in missed)
