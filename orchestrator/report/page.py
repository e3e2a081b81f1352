"""The page: facts and verdicts on top, then the interactive figures; one file that needs no network."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from orchestrator.report.document import document
from orchestrator.report.facts import (
    BEARING_HEADS,
    VERDICT_HEADS,
    bearing_lines,
    conclusion,
    finished,
    trust,
    verdict_cells,
)
from orchestrator.report.html import Markup, dot, joined, row, table, tag, void
from orchestrator.report.panels.orbits import LEGEND
from orchestrator.report.panels.panel import Panel
from orchestrator.report.source import Result
from orchestrator.results.verdicts.conclusion import Action
from orchestrator.results.verdicts.verdict import Verdict, worst

_LOOKS = {Action.TRIP: "beyond", Action.INSPECT: "close", Action.TOLERABLE: "within", Action.UNKNOWN: "none"}
SECTIONS = {
    "orbits": ("Orbits in the clearance", ""),
    "series": (
        "Forces and gaps over time",
        "Extremes of every macro step; no peak is lost where lines are thinned.",
    ),
    "spectra": (
        "Spectra",
        "Zero to peak of the journal's motion at the angles of the probes; Hann window over whole pairs of "
        "revolutions, before the event and from where means are taken behind it. Where the speed changes, "
        "over its orders.",
    ),
    "waterfall": ("Waterfall", "The same at the first probe over time; dashed: what happens."),
    "bode": (
        "Bode plot over speed",
        "1X at the first probe, zero to peak; its phase counts from the start.",
    ),
    "pressure": (
        "Film pressure",
        "Unwrapped film at the worst instants of the record; 0° is x, 90° is up. White: lines of equal gap "
        "to the rigid bore in µm; cross: least gap. Of mass-conserving films also the share of the gap that "
        "oil fills.",
    ),
    "shaft": ("Shaft", "From the static line; stresses are nominal, from bending."),
    "shaft3d": (
        "Deformed shaft",
        "Move the slider; turn and zoom with the mouse or two fingers. Red: paths of the journals around the "
        "worst instant.",
    ),
}
"""Heading and words of each section, in their order on the page."""
_TEXTS = (0, 1, 2, 7, 8)


def page(results: Sequence[Result], panels: Sequence[Panel], bearing: str) -> str:
    """The text of the page.

    Parameters
    ----------
    results : sequence of Result
        At least one.
    panels : sequence of Panel
        Its figures.
    bearing : str
        The bearing that it opens with.
    """
    title = str(results[0].record.attrs.get("title", "")) or "Results"
    ids = {f"p{k}": panel for k, panel in enumerate(panels)}
    body = joined(
        [_header(title, results), _nav(results, ids, bearing), _main(results, ids), _footer(results)]
    )
    return document(title, body, ids)


def _header(title: str, results: Sequence[Result]) -> Markup:
    first = results[0].record
    train = f"Train {first.attrs.get('train', '?')}, {first.sizes['bearing']} bearings"
    runs = [_run(result, several=len(results) > 1) for result in results]
    return tag("header", tag("h1", title), tag("p", train, klass="soft"), tag("div", *runs, klass="runs"))


def _run(result: Result, *, several: bool) -> Markup:
    """The card of one run: what follows, from what, and how far to trust it."""
    found = conclusion(result)
    word, _, rest = found.action.partition(": ")
    name = (tag("h3", _key(result), result.name),) if several or not finished(result) else ()
    facts = joined(
        joined(
            [tag("dt", fact.label), tag("dd", dot(fact.level) if fact.level != "plain" else "", fact.text)]
        )
        for fact in trust(result)
    )
    return tag(
        "div", *name, tag("p", tag("span", word.capitalize(), klass="action"), f" - {rest}" if rest else ""),
        tag("p", found.grounds), tag("dl", facts), klass=f"run {_LOOKS[found.action]}",
    )  # fmt: skip


def _key(result: Result) -> Markup:
    """A piece of the result's line."""
    style = {"solid": "solid", "dot": "dotted"}.get(result.dash, "dashed")
    return tag("span", klass="key", style=f"border-color:{result.colour};border-top-style:{style}")


def _nav(results: Sequence[Result], ids: dict[str, Panel], bearing: str) -> Markup:
    names = dict.fromkeys(name for result in results for name in result.bearings)
    options = [
        tag("option", name, value=name, selected="selected" if name == bearing else None) for name in names
    ]
    choice = tag("label", "Bearing ", tag("select", *options, id="bearing"))
    used = {panel.section for panel in ids.values()}
    links = [tag("a", SECTIONS[key][0], href=f"#{key}") for key in SECTIONS if key in used]
    top = [tag("a", "Verdicts", href="#verdicts"), tag("a", "Bearings", href="#bearings")]
    return tag("nav", tag("div", choice, *top, *links))


def _main(results: Sequence[Result], ids: dict[str, Panel]) -> Markup:
    parts = [_verdicts(results), _bearings(results)]
    for key, (heading, text) in SECTIONS.items():
        own = {name: panel for name, panel in ids.items() if panel.section == key}
        if own:
            parts.append(_section(key, heading, text, own, results))
    return tag("main", *parts)


def _section(key: str, heading: str, text: str, own: dict[str, Panel], results: Sequence[Result]) -> Markup:
    several = len(results) > 1
    side = several and key in ("orbits", "waterfall")
    look = "panels side" if side else "panels small" if key == "orbits" else "panels"
    legend: tuple[Markup, ...] = ()
    if key == "orbits":
        entries = (tag("span", _sign(sign, colour), words) for sign, colour, words in LEGEND)
        legend = (tag("div", *entries, klass="legend soft"),)
    elif several:
        legend = (tag("div", *(tag("span", _key(r), r.name) for r in results), klass="legend soft"),)
    boxes = [box(name, panel) for name, panel in own.items()]
    count = f"--count:{len(results)}"
    about = (tag("p", text, klass="soft"),) if text else ()
    return tag(
        "section", tag("h2", heading), *about, *legend, tag("div", *boxes, klass=look, style=count), id=key
    )


def _sign(sign: str, colour: str) -> Markup:
    """A sign of a legend; a line is drawn."""
    if sign == "—":
        return tag("span", klass="key", style=f"border-color:{colour}")
    return tag("span", sign, klass="sign", style=f"color:{colour}")


def box(name: str, panel: Panel) -> Markup:
    """The place of a figure, with its title and its slider."""
    plot = tag("div", klass="plot", style=f"height:{panel.height}px")
    slider: tuple[Markup, ...] = ()
    if panel.moving:
        parts = (
            tag("button", "Play", type="button"),
            void("input", type="range", min=0, value=0, aria_label="instant"),
            tag("output"),
            tag("span", str(panel.moving.get("note", "")), klass="soft"),
        )
        slider = (tag("div", *parts, klass="slider"),)
    return tag(
        "div",
        tag("h3", panel.title),
        plot,
        *slider,
        klass="panel",
        id=name,
        data_bearing=panel.bearing or None,
    )


def _verdicts(results: Sequence[Result]) -> Markup:
    parts: list[Markup] = [tag("h2", "Verdicts")]
    text = (
        "Of each limit the place where the most of it is used, the worst first. Recalled limits are yours to "
        "confirm; limits.toml beside the train replaces them."
    )
    parts.append(tag("p", text, klass="soft"))
    for result in results:
        if len(results) > 1:
            parts.append(tag("h3", _key(result), result.name))
        parts.append(table(VERDICT_HEADS, (verdict_row(v) for v in worst(result.verdicts)), _TEXTS, "cards"))
        every = table(VERDICT_HEADS, (verdict_row(v) for v in result.verdicts), _TEXTS, "cards")
        count = f"All {len(result.verdicts)} verdicts, bearing by bearing"
        parts.append(tag("details", tag("summary", count), every))
    return tag("section", *parts, id="verdicts")


def verdict_row(v: Verdict) -> Markup:
    """A verdict in a table."""
    limit, *others = verdict_cells(v)
    return row((joined([dot(v.grade), limit]), *others), _TEXTS, klass=str(v.grade))


def _bearings(results: Sequence[Result]) -> Markup:
    parts: list[Markup] = [tag("h2", "Bearings at a glance")]
    parts.append(
        tag("p", "Choose a row to see its figures below. ½X and 2X are of the end of the run.", klass="soft")
    )
    for result in results:
        if len(results) > 1:
            parts.append(tag("h3", _key(result), result.name))
        parts.append(table(BEARING_HEADS, _lines(result)))
    return tag("section", *parts, id="bearings")


def _lines(result: Result) -> Iterator[Markup]:
    for found in bearing_lines(result):
        cells = (joined([dot(found.grade), found.cells[0]]), *found.cells[1:])
        yield row(cells, klass=str(found.grade), data_bearing=found.bearing)


def _footer(results: Sequence[Result]) -> Markup:
    parts = []
    for result in results:
        attributes = result.record.attrs
        text = "\n".join(f"{key}: {attributes[key]}" for key in ("versions", "fmus") if key in attributes)
        scenario = str(attributes.get("scenario", ""))
        parts.append(
            tag(
                "details",
                tag("summary", f"How it was made: {result.name}"),
                tag("pre", f"{text}\n\n{scenario}"),
            )
        )
    return tag("footer", *parts)
