"""Rows 10 to 14: what happens after the fracture, as requirements."""

from __future__ import annotations

from collections.abc import Sequence

from orchestrator.results.quantities import AMPLITUDE, FORCE, GAP, MOMENT, RATIO, SHARE, STRESS, shown
from orchestrator.study.comparison import Comparison
from orchestrator.study.paper import published
from orchestrator.study.paper.criterion import least_gap
from orchestrator.study.paper.requirement import Requirement

Finding = tuple[str, Sequence[Requirement]]


def contact_at_the_edge(found: Comparison) -> Finding:
    """Row 10: V1 touches at its ends while its centre line stays open."""
    run = found.runs["v1"]
    before, after = run.require("before"), run.require("after")
    centre = after.bearing.centre_line_gap_min
    open_from = published.CENTRE_OPEN_SHARE * before.bearing.centre_line_gap_mean
    other_end = min(after.ends)
    requirements = [
        Requirement.above("contact force after", after.contact_largest, run.contact_from, FORCE, strict=True),
        Requirement.below("contact force before", before.contact_largest, run.contact_from, FORCE),
        Requirement.above("centre-line gap against before", centre, open_from, GAP),
        Requirement.above(
            "centre-line gap against roughness",
            centre,
            published.CENTRE_OPEN_ROUGHNESS * found.seat.roughness,
            GAP,
        ),
        Requirement.above(
            "time with the least gap at the other end", other_end, published.OTHER_END_SHARE, SHARE
        ),
    ]
    first = after.bearing.contact_first
    contact = (
        "no contact"
        if first is None
        else f"contact {100 * after.bearing.contact_share:.0f} % of the time, first at {first:.3f} s"
    )
    front, rear = (100 * share for share in after.ends)
    return (
        f"{contact}; least gap front / rear end {front:.0f} / {rear:.0f} % of the time; "
        f"centre line at least {GAP.text(centre)}",
        requirements,
    )


def gaps_after(found: Comparison) -> Finding:
    """Row 11: V2 closes without touching, V3 stays wide."""
    v2, v3 = found.runs["v2"], found.runs["v3"]
    before = v2.require("before").bearing.least_gap_min
    after2, after3 = v2.require("after"), v3.require("after")
    gap2, gap3 = after2.bearing.least_gap_min, after3.bearing.least_gap_min
    requirements = [
        Requirement.below("contact force V2", after2.contact_largest, v2.contact_from, FORCE),
        Requirement.below("contact force V3", after3.contact_largest, v3.contact_from, FORCE),
        Requirement.below("smallest gap V2 after", gap2, before, GAP, strict=True),
        Requirement.above("smallest gap V3 after", gap3, gap2, GAP, strict=True),
        Requirement.above("smallest gap V3 for a full film", gap3, least_gap(found), GAP),
    ]
    touching = [
        depth.upper()
        for depth, run in (("v2", after2), ("v3", after3))
        if run.contact_largest > found.runs[depth].contact_from
    ]
    contact = f"contact in {' and '.join(touching)}" if touching else "no contact"
    return (
        f"{contact}; smallest gap V2 {GAP.number(before)} before, {GAP.number(gap2)} after; "
        f"V3 {GAP.text(gap3)} after",
        requirements,
    )


def force_ratio(found: Comparison) -> Finding:
    """Row 12: how far V2 and V3 underestimate the largest force."""
    largest = {depth: found.bearing(depth, "after").force_max for depth in ("v1", "v2", "v3")}
    ratios = {depth: largest["v1"] / largest[depth] for depth in ("v2", "v3")}
    requirements = [
        Requirement.near(f"V1/{depth.upper()}", ratio, published.FORCE_RATIO, RATIO)
        for depth, ratio in ratios.items()
    ]
    forces = " / ".join(shown(force, FORCE) for force in largest.values())
    return f"{ratios['v2']:.2f} and {ratios['v3']:.2f} ({forces})", requirements


def moments(found: Comparison) -> Finding:
    """Row 13: moments of the tilted film, none of the others."""
    v1 = found.bearing("v1", "after")
    lever = v1.moment_max / (v1.force_max * found.seat.width)
    others = {depth: found.bearing(depth, "after").moment_max for depth in ("v2", "v3")}
    requirements = [
        Requirement.above("V1 over force times width", lever, published.MOMENT_SHARE, SHARE),
        *(
            Requirement.below(f"moment {depth.upper()}", value, 0.0, MOMENT)
            for depth, value in others.items()
        ),
    ]
    zero = " / ".join(shown(value, MOMENT) if value else "0" for value in others.values())
    return (
        f"V1 {shown(v1.moment_max, MOMENT)}, {100 * lever:.2g} % of force times width; V2 / V3 {zero}",
        requirements,
    )


def orderings(found: Comparison) -> Finding:
    """Row 14: V2 vibrates less than V3 and is stressed more."""
    v2, v3 = found.shaft("v2", "after"), found.shaft("v3", "after")
    requirements = [
        Requirement.below("amplitude V2/V3", v2.amplitude_max / v3.amplitude_max, 1.0, RATIO, strict=True),
        Requirement.above("stress V2/V3", v2.stress_max / v3.stress_max, 1.0, RATIO, strict=True),
    ]
    return (
        f"{AMPLITUDE.number(v2.amplitude_max)} / {AMPLITUDE.text(v3.amplitude_max)}; "
        f"{STRESS.number(v2.stress_max)} / {STRESS.text(v3.stress_max)}",
        requirements,
    )
