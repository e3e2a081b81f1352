"""What an engineer would have concluded from each depth alone: computed from contact, gap and stress."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from orchestrator.results.quantities import FORCE, GAP, STRESS
from orchestrator.study.paper import paper
from orchestrator.study.paper.criterion import shown
from orchestrator.study.paper.observation import NotEvaluatedError
from orchestrator.study.paper.runs import Runs


class Action(StrEnum):
    """What is done with the machine."""

    TRIP = "trip: shut the train down at once"
    INSPECT = "inspect: go on no longer than needed, open the bearing"
    TOLERABLE = "tolerable: no reason to shut the train down"
    UNKNOWN = "no conclusion"


@dataclass(frozen=True)
class Conclusion:
    """One depth's conclusion.

    Attributes
    ----------
    depth : str
        Modelling depth.
    action : Action
        What follows.
    grounds : str
        From which figures.
    """

    depth: str
    action: Action
    grounds: str

    def sentence(self) -> str:
        """In one sentence."""
        return f"{self.depth.upper()} - {self.action}: {self.grounds}."


def limits_text(runs: Runs) -> str:
    """The limits the conclusions are drawn against."""
    gap = paper.FULL_FILM * runs.seat.roughness
    return (
        f"Trip on solid contact; inspect when the least gap falls below {GAP.text(gap)} "
        f"({paper.FULL_FILM:g} composite roughnesses, full film) or the stress exceeds "
        f"{STRESS.text(paper.STRESS_LIMIT)} (assumed)."
    )


def conclude(runs: Runs) -> tuple[Conclusion, ...]:
    """A conclusion for every depth, from its own run alone."""
    return tuple(_conclude(runs, depth) for depth in runs.depths)


def _conclude(runs: Runs, depth: str) -> Conclusion:
    run = runs.observed[depth]
    try:
        found = run.after or run.require("before")
        if run.unfinished and run.contact_from >= found.contact_largest:
            raise NotEvaluatedError(f"{depth.upper()} {run.unfinished}")
    except NotEvaluatedError as obstacle:
        return Conclusion(depth, Action.UNKNOWN, str(obstacle))
    bearing, stress = found.bearing, found.shaft.stress_max
    limit = paper.FULL_FILM * runs.seat.roughness
    gap = f"least gap {GAP.text(bearing.least_gap_min)}"
    strained = f"largest stress {STRESS.text(stress)}"
    if found.contact_largest > run.contact_from:
        share = f"{100 * bearing.contact_share:.0f} % of the time"
        touch = f"solid contact {share}, up to {shown(found.contact_largest, FORCE)}"
        return Conclusion(depth, Action.TRIP, f"{touch}; {gap}; {strained}")
    grounds = (
        f"no contact; {gap} against {GAP.text(limit)}; {strained} against {STRESS.text(paper.STRESS_LIMIT)}"
    )
    calm = bearing.least_gap_min >= limit and stress <= paper.STRESS_LIMIT
    return Conclusion(depth, Action.TOLERABLE if calm else Action.INSPECT, grounds)
