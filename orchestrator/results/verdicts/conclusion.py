"""What follows for the machine: from every verdict of a run, or from that the run gives none."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

from orchestrator.results.quantities import shown
from orchestrator.results.verdicts.verdict import Grade, Verdict, worst

_ONLY = ("all", "after")
"""Phases that need no word: there is no other after an event."""


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
    """The figures that a conclusion rests on, in a line; of each limit the phase in which it is used most."""
    beyond: dict[str, Verdict] = {}
    for one in verdicts:
        if one.grade is Grade.BEYOND:
            beyond.setdefault(one.limit, one)
    return "; ".join(map(_ground, beyond.values()))


def _ground(found: Verdict) -> str:
    when = "" if found.phase in _ONLY else f", {found.phase}"
    against = f" against {found.bound_text()}" if found.bound > 0.0 else ""
    told = not against or math.isinf(found.share)  # no share of the limit says how bad it is
    note = f" ({found.note})" if found.note and told else ""
    return f"{found.limit} {shown(found.value, found.quantity)} at {found.place}{when}{against}{note}"
