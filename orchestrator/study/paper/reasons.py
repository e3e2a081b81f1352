"""Why a row is missed: the mechanism, as far as it was found."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestrator.results.quantities import FORCE, shown
from orchestrator.study.paper import published
from orchestrator.study.paper.requirement import Row

if TYPE_CHECKING:
    from orchestrator.study.comparison import Comparison

CALIBRATION = "rotor_fmu/data/turbine/CALIBRATION.md"
"""The page beside the train's data that tells how they were found, with the experiments on what is missed."""

_RAISED = 1.3
"""Ratio of forces above which more than inertia acts."""


def reason(row: Row, found: Comparison) -> str:
    """Reason for a row that `found` misses, in a few sentences."""
    if row.number == 6 and row.requirements[0].value > published.GAP_V3_OVER_V1.value:
        return f"{_gap_ratio(found)}; {CALIBRATION}"
    if row.number == 12 and max(item.value for item in row.requirements) < published.FORCE_RATIO.value:
        if min(item.value for item in row.requirements) > _RAISED:
            return (
                "edge contact raises V1's answer at half the speed, of which V2 has less and V3 next to "
                "nothing, but the kick of the fracture alone brings them to half of its force; "
                f"{CALIBRATION}"
            )
        return (
            f"rotor inertia imposes the force: the blade's {shown(found.blade_force, FORCE)} pass through "
            "the bearings at any depth, and edge contact shifts load from film to asperities rather than "
            f"adding to it; {CALIBRATION}"
        )
    if row.number == 10 and not row.requirements[-1].met:
        after = found.runs["v1"].require("after")
        end = "front" if after.ends[0] > after.ends[1] else "rear"
        return f"bending and residual tilt keep the least gap at the {end} end"
    if row.number == 14 and not row.requirements[0].met:
        return (
            "the largest amplitude is that of the first swing, in which journals cross their clearance: "
            f"V2, with the thinner film, leaves them more of it than V3; {CALIBRATION}"
        )
    return f"see {CALIBRATION}"


def _gap_ratio(found: Comparison) -> str:
    v2, v3 = found.bearing("v2", "before"), found.bearing("v3", "before")
    published_ratio = (published.GAP_MEAN.value + published.GAP_V3_OVER_V1.value) / (
        published.GAP_MEAN.value + published.GAP_V2_OVER_V1.value
    )
    return (
        "the gap ratio V3/V2 of a full 360° Gümbel bearing depends on So and b/d alone: here "
        f"{v3.least_gap_mean / v2.least_gap_mean:.2f} at So {v2.sommerfeld_mean:.2f} and b/d "
        f"{found.seat.width / found.seat.diameter:.2f}, far above the paper's {published_ratio:.2f}"
    )
