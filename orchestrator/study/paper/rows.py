"""The fourteen rows of the table: paper against here, the verdict computed from requirements."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from orchestrator.results.quantities import AMPLITUDE, FORCE, GAP, SOMMERFELD, STRESS, Quantity, shown
from orchestrator.study.comparison import Comparison
from orchestrator.study.depth_run import NotEvaluatedError
from orchestrator.study.paper import published
from orchestrator.study.paper.after_fracture import (
    Finding,
    contact_at_the_edge,
    force_ratio,
    gaps_after,
    moments,
    orderings,
)
from orchestrator.study.paper.criterion import FULL_FILM
from orchestrator.study.paper.published import DEPTHS, Published
from orchestrator.study.paper.reasons import reason
from orchestrator.study.paper.requirement import Requirement, Row, Verdict


@dataclass(frozen=True)
class _Question:
    """A row before anything is known: what the paper says, and how to find what holds here."""

    quantity: str
    paper: str
    definition: str
    source: str
    find: Callable[[Comparison], Finding]


def rows(found: Comparison) -> tuple[Row, ...]:
    """Rows 1 to 14 of a comparison; a row whose runs are missing, cut short or without event says so."""
    return tuple(_answer(number, question, found) for number, question in enumerate(_QUESTIONS, 1))


def _answer(number: int, question: _Question, found: Comparison) -> Row:
    row = Row(number, question.quantity, question.paper, "-", question.definition, question.source)
    try:
        here, requirements = question.find(found)
    except NotEvaluatedError as obstacle:
        return replace(row, obstacle=str(obstacle))
    row = replace(row, here=here, requirements=tuple(requirements))
    return replace(row, reason=reason(row, found)) if row.verdict is Verdict.MISSED else row


def _figure(
    text: str,
    aim: Published,
    unit: Quantity,
    definition: str,
    find: Callable[[Comparison], float],
    label: str = "V1",
) -> _Question:
    """A single figure within the tolerance."""

    def finding(found: Comparison) -> Finding:
        value = find(found)
        return shown(value, unit), [Requirement.near(label, value, aim, unit)]

    return _Question(text, _said(aim, unit), definition, aim.source, finding)


def _figures(
    text: str, aim: Published, unit: Quantity, definition: str, find: Callable[[Comparison, str], float]
) -> _Question:
    """A figure of all depths within the tolerance."""

    def finding(found: Comparison) -> Finding:
        values = {depth: find(found, depth) for depth in DEPTHS}
        requirements = [Requirement.near(depth.upper(), value, aim, unit) for depth, value in values.items()]
        fit = unit.fitting(max(values.values())).fitting(max(values.values()))
        return f"{' / '.join(map(fit.number, values.values()))} {fit.unit}".strip(), requirements

    told = f"{definition}; V1 / V2 / V3, each within the tolerance"
    return _Question(text, _said(aim, unit), told, aim.source, finding)


def _said(aim: Published, unit: Quantity) -> str:
    return f"{unit.text(aim.value).strip()} ±{100 * aim.tolerance:.0f} %"


def _gap(found: Comparison, depth: str) -> float:
    return found.bearing(depth, "before").least_gap_mean


_QUESTIONS = (
    _figures(
        "bearing force before",
        published.FORCE_BEFORE,
        FORCE,
        "mean of |F|",
        lambda found, depth: found.bearing(depth, "before").force_mean,
    ),
    _figures(
        "So before",
        published.SOMMERFELD_BEFORE,
        SOMMERFELD,
        "So = |F| ψ²/(b d η ω), ψ = radial clearance over radius, mean",
        lambda found, depth: found.bearing(depth, "before").sommerfeld_mean,
    ),
    _figure(
        "least gap V1, mean",
        published.GAP_MEAN,
        GAP,
        "mean of the least gap over the whole film, which lies at one of the two ends",
        lambda found: _gap(found, "v1"),
    ),
    _figure(
        "least gap V1, harmonic part",
        published.GAP_HARMONIC,
        GAP,
        "half peak-to-peak of the least gap",
        lambda found: found.bearing("v1", "before").least_gap_harmonic,
    ),
    _figure(
        "least gap V2 - V1, mean",
        published.GAP_V2_OVER_V1,
        GAP,
        "difference of the means",
        lambda found: _gap(found, "v2") - _gap(found, "v1"),
        "V2 - V1",
    ),
    _figure(
        "least gap V3 - V1, mean",
        published.GAP_V3_OVER_V1,
        GAP,
        "difference of the means",
        lambda found: _gap(found, "v3") - _gap(found, "v1"),
        "V3 - V1",
    ),
    _figures(
        "largest vibration amplitude before",
        published.AMPLITUDE_BEFORE,
        AMPLITUDE,
        "largest excursion from the static line over all nodes and the window",
        lambda found, depth: found.shaft(depth, "before").amplitude_max,
    ),
    _figures(
        "largest normal stress before",
        published.STRESS_BEFORE,
        STRESS,
        "|M|/W, static and dynamic, largest over all elements and the window",
        lambda found, depth: found.shaft(depth, "before").stress_max,
    ),
    _figure(
        "So after, mean force, V1",
        published.SOMMERFELD_AFTER,
        SOMMERFELD,
        "as row 2, mean of |F| in the window after the fracture, V1",
        lambda found: found.bearing("v1", "after").sommerfeld_mean,
    ),
    _Question(
        "V1 after: contact at the edges",
        "solid contact, the least gap at changing axial positions, the centre line open",
        "contact after the fracture and not before it; smallest centre-line gap at least "
        f"{100 * published.CENTRE_OPEN_SHARE:g} % of its mean before and "
        f"{published.CENTRE_OPEN_ROUGHNESS:g} roughnesses; least gap at either end for at least "
        f"{100 * published.OTHER_END_SHARE:g} % of the time",
        f"{published.SECTION_TRANSIENT}; Figure 7, top",
        contact_at_the_edge,
    ),
    _Question(
        "V2 and V3 after: gaps",
        "V2 no contact, smaller gaps than before; V3 larger gaps still, uncritical",
        "no contact in either; smallest gap V2 after < V2 before; V3 after > V2 after; V3 after at least "
        f"{FULL_FILM:g} roughnesses",
        f"{published.SECTION_TRANSIENT}; Figure 7, centre and bottom",
        gaps_after,
    ),
    _Question(
        "largest force after, V1 over V2, V3",
        f"about {published.FORCE_RATIO.value:g} (±{100 * published.FORCE_RATIO.tolerance:.0f} %)",
        "ratio of the largest |F| after the fracture, every macro step; both ratios within the tolerance",
        f"{published.FORCE_RATIO.source}; Figure 6",
        force_ratio,
    ),
    _Question(
        "bearing moments after",
        "significant in V1, absent in V2 and V3",
        f"V1: largest |M| at least {100 * published.MOMENT_SHARE:g} % of largest |F| times width; "
        "V2, V3: exactly zero",
        f"{published.SECTION_TRANSIENT}; Figure 6",
        moments,
    ),
    _Question(
        "largest amplitude and stress after",
        "amplitude V2 < V3, stress V2 > V3",
        "largest values after the fracture, over all nodes and elements",
        f"{published.SECTION_TRANSIENT}; Figures 8 and 9",
        orderings,
    ),
)
