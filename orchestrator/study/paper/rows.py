"""The fourteen rows of the table: paper against here, the verdict computed from criteria."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from orchestrator.results.quantities import AMPLITUDE, FORCE, GAP, STRESS, Quantity
from orchestrator.study.paper import paper
from orchestrator.study.paper.criterion import SOMMERFELD, Criterion, Row, Verdict, shown
from orchestrator.study.paper.events import contact_at_the_edge, force_ratio, gaps_after, moments, orderings
from orchestrator.study.paper.observation import NotEvaluatedError
from orchestrator.study.paper.paper import Published
from orchestrator.study.paper.reasons import reason
from orchestrator.study.paper.runs import Runs

Finding = tuple[str, Sequence[Criterion]]


@dataclass(frozen=True)
class _Question:
    """A row before anything is known: what the paper says, and how to find what holds here."""

    quantity: str
    paper: str
    definition: str
    source: str
    find: Callable[[Runs], Finding]


def rows(runs: Runs) -> tuple[Row, ...]:
    """Rows 1 to 14 of a comparison.

    Parameters
    ----------
    runs : Runs
        One a depth; a row whose runs are missing, cut short or without event says so.
    """
    return tuple(_answer(number, question, runs) for number, question in enumerate(_QUESTIONS, 1))


def _answer(number: int, question: _Question, runs: Runs) -> Row:
    row = Row(number, question.quantity, question.paper, "-", question.definition, question.source)
    try:
        here, criteria = question.find(runs)
    except NotEvaluatedError as obstacle:
        return replace(row, obstacle=str(obstacle))
    row = replace(row, here=here, criteria=tuple(criteria))
    return replace(row, reason=reason(row, runs)) if row.verdict is Verdict.MISSED else row


def _every_depth(
    find: Callable[[Runs, str], float], published: Published, quantity: Quantity
) -> Callable[[Runs], Finding]:
    """All depths within the tolerance."""

    def finding(runs: Runs) -> Finding:
        values = {depth: find(runs, depth) for depth in runs.depths}
        criteria = [
            Criterion.near(depth.upper(), value, published, quantity) for depth, value in values.items()
        ]
        unit = quantity.fitting(max(values.values())).fitting(max(values.values()))
        here = f"{' / '.join(unit.number(value) for value in values.values())} {unit.unit}".strip()
        return here, criteria

    return finding


def _one(
    find: Callable[[Runs], float], label: str, published: Published, quantity: Quantity
) -> Callable[[Runs], Finding]:
    """A single figure within the tolerance."""

    def finding(runs: Runs) -> Finding:
        value = find(runs)
        return shown(value, quantity), [Criterion.near(label, value, published, quantity)]

    return finding


def _gap(runs: Runs, depth: str) -> float:
    return runs.bearing(depth, "before").least_gap_mean


def _said(published: Published, quantity: Quantity) -> str:
    value = quantity.text(published.value).strip()
    return f"{value} ±{100 * published.tolerance:.0f} %"


_ALL = "V1 / V2 / V3, each within the tolerance"
_QUESTIONS = (
    _Question(
        "bearing force before",
        _said(paper.FORCE_BEFORE, FORCE),
        f"mean of |F|; {_ALL}",
        paper.FORCE_BEFORE.source,
        _every_depth(lambda runs, d: runs.bearing(d, "before").force_mean, paper.FORCE_BEFORE, FORCE),
    ),
    _Question(
        "So before",
        _said(paper.SOMMERFELD_BEFORE, SOMMERFELD),
        f"So = |F| ψ²/(b d η ω), ψ = radial clearance over radius, mean; {_ALL}",
        paper.SOMMERFELD_BEFORE.source,
        _every_depth(
            lambda runs, d: runs.bearing(d, "before").sommerfeld_mean, paper.SOMMERFELD_BEFORE, SOMMERFELD
        ),
    ),
    _Question(
        "least gap V1, mean",
        _said(paper.GAP_MEAN, GAP),
        "mean of the least gap over the whole film, which lies at one of the two ends",
        paper.GAP_MEAN.source,
        _one(lambda runs: _gap(runs, "v1"), "V1", paper.GAP_MEAN, GAP),
    ),
    _Question(
        "least gap V1, harmonic part",
        _said(paper.GAP_HARMONIC, GAP),
        "half peak-to-peak of the least gap",
        paper.GAP_HARMONIC.source,
        _one(lambda runs: runs.bearing("v1", "before").least_gap_harmonic, "V1", paper.GAP_HARMONIC, GAP),
    ),
    _Question(
        "least gap V2 - V1, mean",
        _said(paper.GAP_V2_OVER_V1, GAP),
        "difference of the means",
        paper.GAP_V2_OVER_V1.source,
        _one(lambda runs: _gap(runs, "v2") - _gap(runs, "v1"), "V2 - V1", paper.GAP_V2_OVER_V1, GAP),
    ),
    _Question(
        "least gap V3 - V1, mean",
        _said(paper.GAP_V3_OVER_V1, GAP),
        "difference of the means",
        paper.GAP_V3_OVER_V1.source,
        _one(lambda runs: _gap(runs, "v3") - _gap(runs, "v1"), "V3 - V1", paper.GAP_V3_OVER_V1, GAP),
    ),
    _Question(
        "largest vibration amplitude before",
        _said(paper.AMPLITUDE_BEFORE, AMPLITUDE),
        f"largest excursion from the static line over all nodes and the window; {_ALL}",
        paper.AMPLITUDE_BEFORE.source,
        _every_depth(
            lambda runs, d: runs.shaft(d, "before").amplitude_max, paper.AMPLITUDE_BEFORE, AMPLITUDE
        ),
    ),
    _Question(
        "largest normal stress before",
        _said(paper.STRESS_BEFORE, STRESS),
        f"|M|/W, static and dynamic, largest over all elements and the window; {_ALL}",
        paper.STRESS_BEFORE.source,
        _every_depth(lambda runs, d: runs.shaft(d, "before").stress_max, paper.STRESS_BEFORE, STRESS),
    ),
    _Question(
        "So after, mean force, V1",
        _said(paper.SOMMERFELD_AFTER, SOMMERFELD),
        "as row 2, mean of |F| in the window after the fracture, V1",
        paper.SOMMERFELD_AFTER.source,
        _one(
            lambda runs: runs.bearing("v1", "after").sommerfeld_mean, "V1", paper.SOMMERFELD_AFTER, SOMMERFELD
        ),
    ),
    _Question(
        "V1 after: contact at the edges",
        "solid contact, the least gap at changing axial positions, the centre line open",
        "contact after the fracture and not before it; smallest centre-line gap at least "
        f"{100 * paper.CENTRE_OPEN_SHARE:g} % of its mean before and {paper.CENTRE_OPEN_ROUGHNESS:g} "
        f"roughnesses; least gap at either end for at least {100 * paper.OTHER_END_SHARE:g} % of the time",
        f"{paper.SECTION_TRANSIENT}; Figure 7, top",
        contact_at_the_edge,
    ),
    _Question(
        "V2 and V3 after: gaps",
        "V2 no contact, smaller gaps than before; V3 larger gaps still, uncritical",
        "no contact in either; smallest gap V2 after < V2 before; V3 after > V2 after; V3 after at least "
        f"{paper.FULL_FILM:g} roughnesses",
        f"{paper.SECTION_TRANSIENT}; Figure 7, centre and bottom",
        gaps_after,
    ),
    _Question(
        "largest force after, V1 over V2, V3",
        f"about {paper.FORCE_RATIO.value:g} (±{100 * paper.FORCE_RATIO.tolerance:.0f} %)",
        "ratio of the largest |F| after the fracture, every macro step; both ratios within the tolerance",
        f"{paper.FORCE_RATIO.source}; Figure 6",
        force_ratio,
    ),
    _Question(
        "bearing moments after",
        "significant in V1, absent in V2 and V3",
        f"V1: largest |M| at least {100 * paper.MOMENT_SHARE:g} % of largest |F| times width; "
        "V2, V3: exactly zero",
        f"{paper.SECTION_TRANSIENT}; Figure 6",
        moments,
    ),
    _Question(
        "largest amplitude and stress after",
        "amplitude V2 < V3, stress V2 > V3",
        "largest values after the fracture, over all nodes and elements",
        f"{paper.SECTION_TRANSIENT}; Figures 8 and 9",
        orderings,
    ),
)
