"""The report on paper: what the page says in words and tables, then the figures, as a PDF."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from io import StringIO

from matplotlib.figure import Figure
from rich import box
from rich.console import Console
from rich.table import Table

from orchestrator.report.facts import (
    BEARING_HEADS,
    VERDICT_HEADS,
    bearing_lines,
    conclusion,
    trust,
    verdict_cells,
)
from orchestrator.report.paper import MARGIN, PAPER, on_paper
from orchestrator.report.source import Result
from orchestrator.results.figures.write import figures_of, own_settings
from orchestrator.results.verdicts.verdict import worst

WIDTH, LINES = 150, 112
"""Letters of a line, and lines of a page."""
_SIZE = 5.9


def printed(results: Sequence[Result], bearing: str) -> bytes:
    """The content of the PDF.

    Parameters
    ----------
    results : sequence of Result
        Each has its pages of words; figures show all of them.
    bearing : str
        That is shown where one is.
    """
    title = str(results[0].record.attrs.get("title", "")) or "Results"
    with own_settings():
        parts = ["\n".join(_words(result)).rstrip().split("\n") for result in results]
        figures = (figure for _, figure in figures_of([r.record for r in results], bearing=bearing))
        return on_paper(list(_pages(title, parts)), figures, {"Title": title, "Creator": "bladeloss"})


def _pages(title: str, parts: Sequence[Sequence[str]]) -> Iterator[Figure]:
    """Pages of words; a part begins on a new page where it would be torn apart."""
    lines = [title, ""]
    for part in parts:
        if len(lines) > 2 and len(lines) + len(part) > LINES:
            yield _page(lines)
            lines = [title, ""]
        lines += [*part, "", ""]
        while len(lines) > LINES and len("".join(lines[LINES:]).strip()):
            yield _page(lines[:LINES])
            lines = [title, "", *lines[LINES:]]
    yield _page(lines)


def _words(result: Result) -> Iterator[str]:
    """What the page says of one run, line by line."""
    attributes = result.record.attrs
    yield f"Train {attributes.get('train', '?')}, {result.record.sizes['bearing']} bearings, {result.name}"
    yield ""
    yield from textwrap.wrap(conclusion(result).sentence("Conclusion"), WIDTH)
    yield ""
    yield from _table("How far to trust it", ("", ""), [(fact.label, fact.text) for fact in trust(result)])
    yield from _table(
        "Verdicts: of each limit the place where most of it is used; recalled limits are yours to confirm",
        VERDICT_HEADS,
        [verdict_cells(v) for v in worst(result.verdicts)],
    )
    yield from _table("Bearings", BEARING_HEADS, [line.cells for line in bearing_lines(result)])


def _table(heading: str, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> Iterator[str]:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_header=any(heads))
    for head in heads:
        table.add_column(head)
    for row in rows:
        table.add_row(*row)
    text = StringIO()
    Console(file=text, width=WIDTH, color_system=None, force_terminal=False).print(table)
    yield heading
    yield from (line.rstrip() for line in text.getvalue().splitlines())


def _page(lines: Sequence[str]) -> Figure:
    figure = Figure(figsize=PAPER)
    top = 1.0 - MARGIN / PAPER[1]
    step = (1.0 - 2.0 * MARGIN / PAPER[1]) / LINES
    for k, line in enumerate(lines):
        look = {"fontsize": _SIZE} if k else {"fontsize": 12.0, "fontweight": "bold"}
        family = "DejaVu Sans Mono" if k else "DejaVu Sans"
        figure.text(MARGIN / PAPER[0], top - k * step, line, va="top", family=family, **look)
    return figure
