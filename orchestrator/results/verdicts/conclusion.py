"""What follows for the machine: from every verdict of a run, or from that the run gives none."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

from orchestrator.results.quantities import shown
from orchestrator.results.verdicts.verdict import Grade, Verdict, worst


class Action(StrEnum):
    """What is done with the machine."""

    TRIP = "trip: shut the train down at once"
    INSPECT = "inspect: go on no longer than needed, open the bearing"
    TOLERABLE = "tolerable: no reason to shut the train down"
    UNKNOWN = "no conclusion"


@dataclass(frozen=True)
class Conclusion:
    """What follows from a run, and from which figures."""

    action: Action
    grounds: str

    def sentence(self, name: str) -> str:
        """In one sentence, of the run of that name."""
        return f"{name} - {self.action}: {self.grounds}."


def conclude(verdicts: Iterable[Verdict], obstacle: str = "") -> Conclusion:
    """What an engineer would conclude.

    Parameters
    ----------
    verdicts : iterable of Verdict
        From `orchestrator.results.verdicts.judge.judge`.
    obstacle : str
        Why the run is not finished; what it did not reach may be worse, so only a trip follows from it.
    """
    found = worst(verdicts)
    action = action_of(found)
    if not found or (obstacle and action is not Action.TRIP):
        return Conclusion(Action.UNKNOWN, obstacle or "the run gives no figures")
    return Conclusion(action, _grounds(found) or "every figure is within its limit")


def action_of(verdicts: Iterable[Verdict]) -> Action:
    """What follows from the verdicts of a machine."""
    beyond = [verdict for verdict in verdicts if verdict.grade is Grade.BEYOND]
    if any(verdict.trips for verdict in beyond):
        return Action.TRIP
    return Action.INSPECT if beyond else Action.TOLERABLE


def _grounds(verdicts: Iterable[Verdict]) -> str:
    """The figures that a conclusion rests on, in a line."""
    return "; ".join(
        f"{v.limit} {shown(v.value, v.quantity)} at {v.place}"
        + (f" against {v.bound_text()}" if v.bound > 0.0 else f" ({v.note})")
        for v in verdicts
        if v.grade is Grade.BEYOND
    )
