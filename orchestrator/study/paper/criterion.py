"""The paper's own criterion: contact, gap against roughness, stress at the analysed bearing; nothing else.

What an engineer would conclude rests on every limit, see `orchestrator.results.verdicts`.
"""

from __future__ import annotations

from collections.abc import Iterator

from orchestrator.results.quantities import FORCE, GAP, STRESS, shown
from orchestrator.results.verdicts.conclusion import Action, Conclusion
from orchestrator.study.comparison import Comparison
from orchestrator.study.depth_run import DepthRun, NotEvaluatedError
from orchestrator.study.paper.published import STRESS_LIMIT

FULL_FILM = 5.0
"""Least gap over composite roughness from which a film separates the surfaces fully: hydrodynamic
lubrication in Hamrock, Schmid and Jacobson, Fundamentals of Fluid Film Lubrication (2004), chapter 1."""


def criterion_text(found: Comparison) -> str:
    """The criterion in a sentence."""
    return (
        f"Trip on solid contact; inspect when the least gap falls below {GAP.text(least_gap(found))} "
        f"({FULL_FILM:g} composite roughnesses, full film) or the stress exceeds {STRESS.text(STRESS_LIMIT)} "
        "(assumed). It asks for no vibration."
    )


def least_gap(found: Comparison) -> float:
    """Least gap of a full film in m."""
    return FULL_FILM * found.seat.roughness


def by_criterion(found: Comparison) -> Iterator[tuple[str, Conclusion]]:
    """What follows from each depth's own run alone."""
    for run in found.runs.values():
        try:
            yield run.depth, _by_criterion(run, least_gap(found))
        except NotEvaluatedError as obstacle:
            yield run.depth, Conclusion(Action.UNKNOWN, str(obstacle))


def _by_criterion(run: DepthRun, least: float) -> Conclusion:
    found = run.after or run.require("before")
    if run.unfinished and run.contact_from >= found.contact_largest:
        raise NotEvaluatedError(f"{run.depth.upper()} {run.unfinished}")
    bearing, stress = found.bearing, found.shaft.stress_max
    gap, strained = f"least gap {GAP.text(bearing.least_gap_min)}", f"largest stress {STRESS.text(stress)}"
    if found.contact_largest > run.contact_from:
        share = f"{100 * bearing.contact_share:.0f} % of the time"
        touch = f"solid contact {share}, up to {shown(found.contact_largest, FORCE)}"
        return Conclusion(Action.TRIP, f"{touch}; {gap}; {strained}")
    bounds = f"{gap} against {GAP.text(least)}; {strained} against {STRESS.text(STRESS_LIMIT)}"
    # a bearing without bore has no gap
    calm = not bearing.least_gap_min < least and stress <= STRESS_LIMIT
    return Conclusion(Action.TOLERABLE if calm else Action.INSPECT, f"no contact; {bounds}")
