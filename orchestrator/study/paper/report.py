"""A comparison held against the paper: the table of fourteen rows, what is missed and why."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict
from functools import cached_property
from typing import TYPE_CHECKING, Any

from rich import box
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from orchestrator.scenario.file import load_scenario
from orchestrator.study.comparison import Comparison
from orchestrator.study.paper.criterion import by_criterion, criterion_text
from orchestrator.study.paper.published import DEPTHS
from orchestrator.study.paper.requirement import Requirement, Row, Verdict
from orchestrator.study.paper.rows import rows
from orchestrator.study.report import Report, section

if TYPE_CHECKING:
    from collections.abc import Collection

    from orchestrator.scenario.scenario import Scenario

SCENARIOS = ("paper", "inertia")
"""Bundled scenarios whose trains were fitted to the paper's figures; no other is expected to meet them."""
_FREE = (
    "title",
    "end",
    "step",
    "tolerance",
    "ledger",
    "coupling",
    "reduction",
    "film",
    "record",
    "depth",
    "folder",
)
"""What may differ from it: how, and how long, it is computed."""
_STYLES = {Verdict.MET: "green", Verdict.MISSED: "red", Verdict.NOT_EVALUATED: "yellow"}


def speaks_of(scenario: Scenario, depths: Collection[str]) -> bool:
    """Whether the paper speaks of a scenario at these depths: its train, unbalance, blade and bearing."""
    if not set(DEPTHS) <= set(depths):
        return False
    owns = map(load_scenario, SCENARIOS)
    return any(
        scenario.model_copy(update={name: getattr(own, name) for name in _FREE}) == own for own in owns
    )


class PaperReport(Report):
    """See `Report`."""

    beside = "against the paper"

    @cached_property
    def rows(self) -> tuple[Row, ...]:
        """The table."""
        return rows(self.found)

    def findings(self) -> Iterator[RenderableType]:
        """The table, the number of rows met, and what is missed."""
        table = _table("quantity", "paper", "here")
        table.add_column("verdict", no_wrap=True)
        for row in self.rows:
            verdict = Text(row.verdict.value, style=_STYLES[row.verdict])
            texts = (row.quantity, row.paper, row.obstacle or row.here)
            table.add_row(str(row.number), *map(Text, texts), verdict)
        yield table
        counts = {verdict: sum(row.verdict is verdict for row in self.rows) for verdict in Verdict}
        words = ", ".join(f"{count} {verdict}" for verdict, count in counts.items() if count)
        yield Text(f"{words} of {len(self.rows)} rows", style="bold")
        yield from section("Missed", self._misses())

    def changes(self, fine: Comparison) -> RenderableType:
        """What the finer resolution changes, row by row."""
        table = _table("here", "refined", "largest change")
        table.add_column("verdict", ratio=2)
        flips = []
        for row, other in self._pairs(fine):
            change, label = largest_change(row, other)
            size = "-" if math.isnan(change) else f"{100 * change:+.2g} % ({label})"
            verdict = Text("unchanged", style="green")
            if other.verdict is not row.verdict:
                flips.append(str(row.number))
                verdict = Text(f"{row.verdict} -> {other.verdict}", style="bold red")
            texts = (row.obstacle or row.here, other.obstacle or other.here, size)
            table.add_row(str(row.number), *map(Text, texts), verdict)
        outcome = f"The verdict changes in rows {', '.join(flips)}." if flips else "No verdict changes."
        return Group(table, Text(outcome, style="bold red" if flips else "bold green"))

    def criteria(self) -> Iterator[RenderableType]:
        """What the paper would conclude, which asks for less than all limits."""
        sentences = [Text(item.sentence(depth.upper())) for depth, item in by_criterion(self.found)]
        limits = Text(criterion_text(self.found), style="dim")
        yield from section("The paper's criterion alone", [*sentences, limits])

    def notes(self) -> Iterator[RenderableType]:
        """How each row is computed, and where the paper speaks of it."""
        grid = Table.grid(padding=(0, 1))
        grid.add_column(justify="right")
        grid.add_column()
        for row in self.rows:
            grid.add_row(Text(str(row.number)), Text(f"{row.definition} (paper: {row.source})"))
        yield from section("Definitions", [grid])

    def data(self, found: Comparison) -> dict[str, Any]:
        """The table for JSON."""
        return {
            "rows": [
                {**asdict(row), "verdict": row.verdict.value, "missed_by": row.missed_by}
                | {"requirements": [{**asdict(item), "met": item.met} for item in row.requirements]}
                for row in rows(found)
            ],
            "paper_criterion": [{"depth": d, **asdict(item)} for d, item in by_criterion(found)],
        }

    def change_data(self, fine: Comparison) -> list[dict[str, Any]]:
        """What the finer resolution changes, for JSON."""
        found = [(row, other, *largest_change(row, other)) for row, other in self._pairs(fine)]
        return [
            {"row": row.number, "largest": change, "of": label}
            | {"verdict_changes": other.verdict is not row.verdict}
            for row, other, change, label in found
        ]

    def lines(self) -> Iterator[list[str]]:
        """Lines of the CSV."""
        heading = ["row", "quantity", "paper", "here", "verdict", "missed by", "reason"]
        for one in self.fine:
            heading += [f"here ({one.settings.text()})", "verdict there"]
        yield heading
        for row, *finer in zip(self.rows, *map(rows, self.fine), strict=True):
            line = [str(row.number), row.quantity, row.paper, row.here, row.verdict.value]
            line += [row.missed_by, row.reason or row.obstacle]
            yield line + [text for other in finer for text in (other.here, other.verdict.value)]

    def _pairs(self, fine: Comparison) -> Iterator[tuple[Row, Row]]:
        return zip(self.rows, rows(fine), strict=True)

    def _misses(self) -> Iterator[Text]:
        missed = [row for row in self.rows if row.verdict is Verdict.MISSED]
        for row in missed:
            yield Text(f"{row.number:2d}  {row.missed_by}")
        reasons: dict[str, list[str]] = {}
        for row in missed:
            reasons.setdefault(row.reason, []).append(str(row.number))
        for reason, numbers in reasons.items():
            yield Text(f"Reason, row{'s' if len(numbers) > 1 else ''} {', '.join(numbers)}: {reason}.")


def largest_change(row: Row, fine: Row) -> tuple[float, str]:
    """Largest relative change of a value from a row to a finer one, and of which; nan if there is none."""
    pairs = zip(row.requirements, fine.requirements, strict=False)
    shares = [(_relative(one, two), one.label) for one, two in pairs]
    found = [item for item in shares if math.isfinite(item[0])]
    return max(found, key=lambda item: abs(item[0]), default=(math.nan, ""))


def _relative(one: Requirement, two: Requirement) -> float:
    """Change as a share of the value; of the bound where the value itself is next to nothing against it."""
    scale = max((abs(x) for x in (one.value, one.low, one.high) if math.isfinite(x)), default=math.nan)
    return (two.value - one.value) / scale if scale > 0 else 0.0 if two.value == one.value else math.nan


def _table(*heads: str) -> Table:
    """A table with the number of the row, then columns three or four parts wide."""
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    table.add_column("#", justify="right", no_wrap=True)
    for head in heads:
        table.add_column(head, ratio=4 if head in ("here", "refined") else 3)
    return table
