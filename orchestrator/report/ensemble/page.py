"""The page of a study: how likely is contact, over what, what matters, and the worst runs."""

from __future__ import annotations

import os
from collections import Counter
from pathlib import Path

import numpy as np
import xarray as xr

from orchestrator.report.document import document
from orchestrator.report.ensemble.bars import sensitivities
from orchestrator.report.ensemble.curves import fragility, point
from orchestrator.report.ensemble.maps import maps
from orchestrator.report.ensemble.source import NOT_REFINED, levels, shown, title_of
from orchestrator.report.html import Markup, joined, row, table, tag
from orchestrator.report.page import box
from orchestrator.report.panels.panel import Panel
from orchestrator.report.write import write_whole
from orchestrator.results.ensemble.figures import CONTACT
from orchestrator.results.ensemble.files import WORST

SECTIONS = {
    "fragility": (
        "How likely is solid contact",
        "Share of runs with solid contact at any bearing; bars: 95 % bounds of Clopper and Pearson, in which "
        "runs without a result count for no contact below and for contact above. A bar without a point: no "
        "run with a result. Values that were drawn are taken in parts of equally many samples.",
    ),
    "maps": (
        "Maps of two parameters",
        "The figure is its worst value over the bearings behind the last event. Red rims: solid contact; "
        "crosses: no result. Where there is a whole grid its cells are means over all else.",
    ),
    "sensitivity": (
        "What matters",
        "Indices of the study's design, or rank correlations (Spearman), with 95 % bounds.",
    ),
}
_COLUMNS = ("worst_share", "least_gap_min", "contact_max", "force_max")


def study_page(data: xr.Dataset, folder: Path, place: Path | None = None) -> str:
    """The text of the page; the worst runs are linked where their results lie in the study's folder.

    Parameters
    ----------
    data : xarray.Dataset
        Of the study.
    folder : Path
        Of the study.
    place : Path, optional
        Folder of the page; by default that of the study.
    """
    panels = [*fragility(data), *maps(data), *sensitivities(data)]
    ids = {f"p{k}": panel for k, panel in enumerate(panels)}
    title = str(data.attrs.get("title", "")) or folder.name
    used = [key for key in SECTIONS if any(panel.section == key for panel in panels)]
    links = [tag("a", SECTIONS[key][0], href=f"#{key}") for key in used]
    nav = tag("nav", tag("div", *links, tag("a", "The worst runs", href="#worst")))
    parts = [_section(key, {n: p for n, p in ids.items() if p.section == key}) for key in used]
    body = joined(
        [_header(title, data), nav, tag("main", *parts, _worst(data, folder, place or folder)), _footer(data)]
    )
    return document(title, body, ids)


def write_study_report(data: xr.Dataset, folder: Path, path: Path) -> Path:
    """Write the page of a study; raises as `orchestrator.report.write.write_report`."""
    return write_whole(path, lambda: study_page(data, folder, path.parent).encode())


def _header(title: str, data: xr.Dataset) -> Markup:
    names = str(data.attrs["parameters"]).split()
    said = f"{data.sizes['sample']} samples of {', '.join(title_of(data, n) for n in names)}"
    cards = []
    for level in levels(data):
        ended = Counter(level.outcomes.tolist())
        ended.pop(NOT_REFINED, None)
        facts = [joined([tag("dt", outcome), tag("dd", str(n))]) for outcome, n in ended.most_common()]
        key = tag("span", klass="key", style=f"border-color:{level.colour}")
        parts = [tag("h3", key, level.name)]
        if CONTACT in data:
            _, low, high = point(level, np.arange(level.contact.size))
            known = level.contact[np.isfinite(level.contact)]
            chance = f"Contact in {int(known.sum())} of {known.size} runs with a result"
            bounds = f"95 %: {100 * low:.1f} to {100 * high:.1f} %"
            parts += [tag("p", tag("span", chance, klass="action")), tag("p", bounds)]
        cards.append(tag("div", *parts, tag("dl", *facts), klass="run"))
    more = data.attrs.get("refined_where")
    rule = (tag("p", f"Second stage where {more}.", klass="soft"),) if more else ()
    return tag(
        "header", tag("h1", title), tag("p", said, klass="soft"), *rule, tag("div", *cards, klass="runs")
    )


def _section(key: str, own: dict[str, Panel]) -> Markup:
    heading, text = SECTIONS[key]
    boxes = [box(name, panel) for name, panel in own.items()]
    look = "panels side" if len(own) > 1 else "panels"
    style = f"--count:{min(len(own), 2)}"
    parts = [tag("h2", heading), tag("p", text, klass="soft"), tag("div", *boxes, klass=look, style=style)]
    return tag("section", *parts, id=key)


def _worst(data: xr.Dataset, folder: Path, place: Path) -> Markup:
    """The worst runs that have results of their own, the worst first, and those without a result."""
    names = str(data.attrs["parameters"]).split()
    figures = [name for name in _COLUMNS if name in data]
    depths = [str(d) for d in data["depth"].values]
    ranks = str(data.attrs.get("worst_runs", "")).split()
    rows = []
    for name in ranks:
        number, _, depth = name.partition("-")
        sample = int(number)
        page = folder / WORST / name / "report.html"
        text: str = f"{sample} {depth}"
        if page.is_file():
            text = tag("a", text, href=Path(os.path.relpath(page, place)).as_posix())
        cells = [text, *(_cell(data[n].values[sample]) for n in names)]
        cells += [_cell(shown(data, figure, depth)[0][sample]) for figure in figures]
        limit = str(data["worst_limit"].values[sample, depths.index(depth)]) if "worst_limit" in data else ""
        rows.append(row([*cells, limit], (0, len(cells))))
    heads = ["run", *(title_of(data, n) for n in names), *(shown(data, f, depths[0])[1] for f in figures)]
    heads.append("of which limit the most is used")
    parts: list[Markup] = [tag("h2", "The worst runs")]
    if rows:
        parts.append(table(heads, rows, (0, len(heads) - 1)))
    parts.append(_others(data))
    return tag("section", *parts, id="worst")


def _others(data: xr.Dataset) -> Markup:
    """Runs that ended otherwise than finished, with what they said."""
    outcomes, messages = data["outcome"].values, data["message"].values
    rows = []
    for i, j in np.argwhere((outcomes != "finished") & (outcomes != NOT_REFINED)).tolist():
        depth = str(data["depth"].values[j])
        rows.append(row([f"{i} {depth}", str(outcomes[i, j]), str(messages[i, j])], (0, 1, 2)))
    if not rows:
        return tag("p", "Every run that was asked for is finished.", klass="soft")
    inner = table(["run", "outcome", "what it said"], rows[:200], (0, 1, 2))
    return tag("details", tag("summary", f"{len(rows)} runs ended otherwise than finished"), inner)


def _cell(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _footer(data: xr.Dataset) -> Markup:
    text = "\n".join(f"{key}: {value}" for key, value in data.attrs.items() if key != "title")
    return tag("footer", tag("details", tag("summary", "How it was made"), tag("pre", text)))
