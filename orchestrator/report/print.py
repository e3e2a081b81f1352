"""The report on paper: what the page says in words and tables, then the figures, as a PDF."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from io import BytesIO, StringIO

from matplotlib.backends.backend_pdf import PdfPages
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
from orchestrator.report.source import Result
from orchestrator.results.figures.write import figures_of, own_settings
from orchestrator.results.verdicts.verdict import worst

PAPER = (11.69, 8.27)
"""A4 across, in inches."""
WIDTH, LINES = 150, 62
"""Letters of a line, and lines of a page."""
_MARGIN, _SIZE = 0.45, 7.6


def printed(results: Sequence[Result], bearing: str) -> bytes:
    """The content of the PDF.

    Parameters
    ----------
    results : sequence of Result
        Each has its pages of words; figures show all of them.
    bearing : str
        That is shown where one is.
    """
    content = BytesIO()
    title = str(results[0].record.attrs.get("title", "")) or "Results"
    information = {"Title": title, "Creator": "bladeloss", "CreationDate": None}
    with own_settings(), PdfPages(content, metadata=information) as pages:
        for result in results:
            lines = "\n".join([title, "", *_words(result)]).rstrip().split("\n")
            for start in range(0, len(lines), LINES):
                pages.savefig(_page(lines[start : start + LINES], headed=start == 0))
        for _, figure in figures_of([result.record for result in results], bearing=bearing):
            pages.savefig(figure)
    return content.getvalue()


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


def _page(lines: Sequence[str], *, headed: bool) -> Figure:
    figure = Figure(figsize=PAPER)
    top = 1.0 - _MARGIN / PAPER[1]
    step = (1.0 - 2.0 * _MARGIN / PAPER[1]) / LINES
    for k, line in enumerate(lines):
        look = {"fontsize": 13.0, "fontweight": "bold"} if headed and k == 0 else {"fontsize": _SIZE}
        family = "DejaVu Sans" if headed and k == 0 else "DejaVu Sans Mono"
        figure.text(_MARGIN / PAPER[0], top - k * step, line, va="top", family=family, **look)
    return figure
