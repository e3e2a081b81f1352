"""Depth against depth: every limit, how much of it each depth uses, and where."""

from __future__ import annotations

from collections.abc import Iterator

from rich import box
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from orchestrator.results.verdicts.verdict import Grade, Verdict, worst
from orchestrator.study.comparison import Comparison

_STYLES = {Grade.WITHIN: "green", Grade.CLOSE: "yellow", Grade.BEYOND: "bold red"}


def verdict_tables(found: Comparison) -> Iterator[RenderableType]:
    """A table with a row for each limit and phase, the worst first, a column for each depth; its sources."""
    by_depth = {
        depth: {(v.limit, v.phase): v for v in worst(verdicts)} for depth, verdicts in found.verdicts.items()
    }
    rows = worst(v for verdicts in by_depth.values() for v in verdicts.values())
    if not rows:
        return
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    for head in ("limit", "phase", "allowed", *(depth.upper() for depth in by_depth)):
        table.add_column(head, justify="left" if head in ("limit", "phase") else "right")
    for row in rows:
        cells = [_cell(verdicts.get((row.limit, row.phase))) for verdicts in by_depth.values()]
        table.add_row(row.limit, row.phase, row.bound_text(), *cells)
    actions = [found.conclusions[depth].action.partition(":")[0] for depth in by_depth]
    table.add_row("what follows", "", "", *actions, style="bold")
    yield table
    sources = dict.fromkeys(f"{row.limit.partition(',')[0]}: {row.source_text()}" for row in rows)
    yield Text("; ".join(sources), style="dim")


def _cell(verdict: Verdict | None) -> Text:
    """Value, share and place."""
    if verdict is None:
        return Text("-")
    share = f", {verdict.share_text()}" if verdict.bound > 0.0 and verdict.value > 0.0 else ""
    return Text(f"{verdict.value_text()}{share}, {verdict.place}", style=_STYLES[verdict.grade])
