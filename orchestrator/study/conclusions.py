"""What an engineer would have concluded from each depth alone: computed from contact, gap and stress."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from orchestrator.results.quantities import FORCE, GAP, STRESS, shown
from orchestrator.study.comparison import Comparison
from orchestrator.study.depth_run import DepthRun, NotEvaluatedError
from rotor_fmu.train.train import BearingSeat

FULL_FILM = 5.0
"""Least gap over composite roughness from which a film separates the surfaces fully: hydrodynamic
lubrication in Hamrock, Schmid and Jacobson, Fundamentals of Fluid Film Lubrication (2004), chapter 1."""


class Action(StrEnum):
    """What is done with the machine."""

    TRIP = "trip: shut the train down at once"
    INSPECT = "inspect: go on no longer than needed, open the bearing"
    TOLERABLE = "tolerable: no reason to shut the train down"
    UNKNOWN = "no conclusion"


@dataclass(frozen=True)
class Limits:
    """What the results are held against; solid contact is beyond any limit.

    Attributes
    ----------
    gap : float
        Least gap from which the film separates the surfaces [m].
    stress : float or None
        Nominal normal stress from which the shaft is inspected [Pa]; None where nothing is known of it.
    """

    gap: float
    stress: float | None = None

    @classmethod
    def of(cls, seat: BearingSeat, stress: float | None = None) -> Limits:
        """The limits that follow from a bearing's roughness."""
        return cls(FULL_FILM * seat.roughness, stress)

    def text(self) -> str:
        """In a sentence or two."""
        gap = (
            f"Trip on solid contact; inspect when the least gap falls below {GAP.text(self.gap)} "
            f"({FULL_FILM:g} composite roughnesses, full film)"
        )
        if self.stress is None:
            return f"{gap}. No limit of the stress is known for this train."
        return f"{gap} or the stress exceeds {STRESS.text(self.stress)} (assumed)."


@dataclass(frozen=True)
class Conclusion:
    """One depth's conclusion: what follows, and from which figures."""

    depth: str
    action: Action
    grounds: str

    def sentence(self) -> str:
        """In one sentence."""
        return f"{self.depth.upper()} - {self.action}: {self.grounds}."


def conclude(found: Comparison, limits: Limits) -> tuple[Conclusion, ...]:
    """A conclusion for every depth, from its own run alone."""
    return tuple(_conclude(run, limits) for run in found.runs.values())


def _conclude(run: DepthRun, limits: Limits) -> Conclusion:
    try:
        found = run.after or run.require("before")
        if run.unfinished and run.contact_from >= found.contact_largest:
            raise NotEvaluatedError(f"{run.depth.upper()} {run.unfinished}")
    except NotEvaluatedError as obstacle:
        return Conclusion(run.depth, Action.UNKNOWN, str(obstacle))
    bearing, stress = found.bearing, found.shaft.stress_max
    gap = f"least gap {GAP.text(bearing.least_gap_min)}"
    strained = f"largest stress {STRESS.text(stress)}"
    if found.contact_largest > run.contact_from:
        share = f"{100 * bearing.contact_share:.0f} % of the time"
        touch = f"solid contact {share}, up to {shown(found.contact_largest, FORCE)}"
        return Conclusion(run.depth, Action.TRIP, f"{touch}; {gap}; {strained}")
    grounds = f"no contact; {gap} against {GAP.text(limits.gap)}; {strained}"
    calm = not bearing.least_gap_min < limits.gap  # a bearing without bore has none
    if limits.stress is not None:
        grounds += f" against {STRESS.text(limits.stress)}"
        calm = calm and stress <= limits.stress
    return Conclusion(run.depth, Action.TOLERABLE if calm else Action.INSPECT, grounds)
