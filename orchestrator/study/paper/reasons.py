"""Why a row is missed: the mechanism, as far as it was found."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestrator.results.quantities import FORCE
from orchestrator.study.paper import paper
from orchestrator.study.paper.criterion import Row, shown

if TYPE_CHECKING:
    from orchestrator.study.paper.runs import Runs

CALIBRATION = "rotor_fmu/data/turbine/CALIBRATION.md"
"""The page beside the train's data that tells how they were found, with the experiments on what is missed."""


def reason(row: Row, runs: Runs) -> str:
    """Reason for a missed row in a few sentences.

    Parameters
    ----------
    row : Row
        Evaluated and missed.
    runs : Runs
        The runs it was evaluated on.
    """
    if row.number == 6 and row.criteria[0].value > paper.GAP_V3_OVER_V1.value:
        return _gap_ratio(runs)
    if row.number == 12 and max(item.value for item in row.criteria) < paper.FORCE_RATIO.value:
        return _imposed_force(runs)
    if row.number == 10 and not row.criteria[-1].met:
        after = runs.observed["v1"].require("after")
        end = "front" if after.ends[0] > after.ends[1] else "rear"
        return f"bending and residual tilt keep the least gap at the {end} end"
    if row.number == 14 and not row.criteria[0].met and runs.train == paper.TRAIN:
        return (
            "the largest amplitude is that of the first swing, in which journals cross their clearance: "
            f"V2, with the thinner film, leaves them more of it than V3; {CALIBRATION}"
        )
    if runs.train != paper.TRAIN:
        return "another machine than the paper's: its data are not fitted to this figure"
    return f"see {CALIBRATION}"


def _gap_ratio(runs: Runs) -> str:
    v2, v3 = runs.bearing("v2", "before"), runs.bearing("v3", "before")
    published = (paper.GAP_MEAN.value + paper.GAP_V3_OVER_V1.value) / (
        paper.GAP_MEAN.value + paper.GAP_V2_OVER_V1.value
    )
    text = (
        "the gap ratio V3/V2 of a full 360° Gümbel bearing depends on So and b/d alone: here "
        f"{v3.least_gap_mean / v2.least_gap_mean:.2f} at So {v2.sommerfeld_mean:.2f} and b/d "
        f"{runs.seat.width / runs.seat.diameter:.2f}, far above the paper's {published:.2f}"
    )
    return f"{text}; {CALIBRATION}" if runs.train == paper.TRAIN else text


def _imposed_force(runs: Runs) -> str:
    text = (
        f"rotor inertia imposes the force: the blade's {shown(runs.blade_force, FORCE)} pass through the "
        "bearings at any depth, and edge contact shifts load from film to asperities rather than adding to it"
    )
    return f"{text}; {CALIBRATION}" if runs.train == paper.TRAIN else text
