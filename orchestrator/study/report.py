"""A comparison for people, as JSON and as CSV: the depths beside one another."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from io import StringIO
from typing import Any

from rich import box
from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from orchestrator.results.quantities import GAP
from orchestrator.results.summary import without_infinities
from orchestrator.results.windows import Phase
from orchestrator.study.comparison import Comparison
from orchestrator.study.depth_table import DepthRow, depth_rows
from orchestrator.study.verdict_table import verdict_tables

TEXT_WIDTH = 120


class Report:
    """What a comparison says; renders itself on a console.

    Parameters
    ----------
    comparison : Comparison
        What is shown.
    fine : sequence of Comparison
        The same at finer resolutions.
    """

    beside = "beside one another"
    """What the depths are held against, in the heading."""

    def __init__(self, comparison: Comparison, fine: Sequence[Comparison] = ()) -> None:
        self.found, self.fine = comparison, tuple(fine)

    def findings(self) -> Iterator[RenderableType]:
        """A table of figures for each phase."""
        depths = list(self.found.runs)
        rows = list(depth_rows(self.found))
        for phase in dict.fromkeys(row.phase for row in rows):
            heads = [depth.upper() for depth in depths]
            heads += [f"{depth.upper()} to {depths[0].upper()}" for depth in depths[1:]]
            table = plain_table(phase, *heads)
            for row in rows:
                if row.phase == phase:
                    table.add_row(row.label, *row.shown())
            yield table

    def changes(self, fine: Comparison) -> RenderableType:
        """What the finer resolution changes, figure by figure."""
        table = plain_table("figure", "largest change")
        for row, (change, depth) in self._changes(fine):
            size = f"{100 * change:+.2g} % ({depth.upper()})" if depth else "-"
            table.add_row(f"{row.label}, {row.phase}", size)
        return table

    def criteria(self) -> Iterator[RenderableType]:
        """Sections on what else the runs are held against."""
        yield from ()

    def notes(self) -> Iterator[RenderableType]:
        """Sections at the end."""
        yield from ()

    def data(self, found: Comparison) -> dict[str, Any]:
        """What there is to tell beside the runs and the conclusions, for JSON."""
        return {
            "figures": [
                {
                    "phase": row.phase,
                    "figure": row.label,
                    "values": row.values,
                    "differences": row.differences,
                }
                for row in depth_rows(found)
            ]
        }

    def change_data(self, fine: Comparison) -> list[dict[str, Any]]:
        """What the finer resolution changes, for JSON."""
        return [
            {"phase": row.phase, "figure": row.label, "largest": change, "of": depth}
            for row, (change, depth) in self._changes(fine)
        ]

    def lines(self) -> Iterator[list[str]]:
        """Lines of the CSV, SI units."""
        heading = ["phase", "figure", *self.found.runs]
        for one in self.fine:
            heading += [f"{depth} ({one.settings.text()})" for depth in self.found.runs]
        yield heading
        for row, *finer in zip(*map(depth_rows, (self.found, *self.fine)), strict=True):
            values = [value for one in (row, *finer) for value in one.values.values()]
            yield [row.phase, row.label, *(f"{value:.10g}" for value in values)]

    def _changes(self, fine: Comparison) -> Iterator[tuple[DepthRow, tuple[float, str]]]:
        for row, other in zip(depth_rows(self.found), depth_rows(fine), strict=True):
            shares = [(other.values[d] / v - 1.0 if v != 0.0 else math.nan, d) for d, v in row.values.items()]
            finite = [item for item in shares if math.isfinite(item[0])]
            yield row, max(finite, key=lambda item: abs(item[0]), default=(math.nan, ""))

    def __rich_console__(self, _console: Console, _options: ConsoleOptions) -> RenderResult:
        """All there is to tell."""
        found = self.found
        yield Text(f"{found.title}: {found.names} {self.beside}", style="bold")
        yield Text(
            f"analysed bearing {found.seat.name}; {found.settings.text()}, {found.settings.end:g} s",
            style="dim",
        )
        yield from _failures(found)
        yield from self.findings()
        yield from section("Every limit, where most of it is used", verdict_tables(found))
        sentences = (Text(item.sentence(depth.upper())) for depth, item in found.conclusions.items())
        yield from section("What an engineer would have concluded", sentences)
        yield from self.criteria()
        for fine in self.fine:
            yield from _failures(fine)
            heading = f"Check: {fine.settings.text()} in place of {found.settings.text()}"
            yield from section(heading, [self.changes(fine)])
        yield from section("Windows", (Text(line) for line in _windows(found)))
        yield from section("Start of the runs", (Text(line) for line in _starts(found)))
        yield from self.notes()

    def to_text(self) -> str:
        """The same without colours, for ``comparison.txt``."""
        buffer = StringIO()
        Console(file=buffer, width=TEXT_WIDTH, color_system=None, force_terminal=False).print(self)
        return "\n".join(line.rstrip() for line in buffer.getvalue().splitlines()) + "\n"

    def to_json(self) -> str:
        """Machine-readable form, SI units; a value that does not exist is null."""
        data = self._data(self.found)
        if self.fine:
            data["check"] = [self._data(one) | {"changes": self.change_data(one)} for one in self.fine]
        return json.dumps(without_infinities(data), indent=2, allow_nan=False, ensure_ascii=False) + "\n"

    def to_csv(self) -> str:
        """The table as CSV."""
        buffer = StringIO()
        csv.writer(buffer, lineterminator="\n").writerows(self.lines())
        return buffer.getvalue()

    def _data(self, found: Comparison) -> dict[str, Any]:
        return {
            "title": found.title,
            "train": found.train,
            "analysed_bearing": found.seat.name,
            "complete": found.complete,
            "settings": asdict(found.settings),
            "runs": {depth: asdict(end) for depth, end in found.ended.items()},
            **self.data(found),
            "verdicts": {d: [asdict(v) for v in judged] for d, judged in found.verdicts.items()},
            "conclusions": [{"depth": d, **asdict(item)} for d, item in found.conclusions.items()],
            "statistics": {depth: asdict(run) for depth, run in found.runs.items()},
        }


def section(heading: str, content: Iterable[RenderableType]) -> Iterator[RenderableType]:
    """A heading with what stands below it, or nothing."""
    items = list(content)
    if items:
        yield Text(f"\n{heading}", style="bold")
        yield Padding(Group(*items), (0, 0, 0, 2))


def plain_table(*heads: str) -> Table:
    """A table without frame, with words in its first column and numbers in the others."""
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    for index, head in enumerate(heads):
        table.add_column(head, justify="right" if index else "left", no_wrap=index > 0)
    return table


def _failures(found: Comparison) -> Iterator[Text]:
    for depth, end in found.ended.items():
        if not end.ok:
            yield Text(f"PARTIAL: {depth.upper()} {end.text()}. {end.advice}", style="bold red")


def _phase_text(phase: Phase) -> str:
    mean, peak = phase.mean, phase.peak
    text = f"means and harmonic parts {mean.start:.3f} to {mean.end:.3f} s ({mean.length:.3g} s)"
    text += f", extremes {peak.start:.3f} to {peak.end:.3f} s ({peak.length:.3g} s)"
    text += f", contact {phase.span.start:.3f} to {phase.span.end:.3f} s"
    return f"{text}; {phase.note}" if phase.note else text


def _windows(found: Comparison) -> Iterator[str]:
    told: dict[str, list[str]] = {}
    for depth, run in found.runs.items():
        for figures in (run.before, run.after):
            if figures is not None:
                text = f"{figures.phase.name}: {_phase_text(figures.phase)}"
                told.setdefault(text, []).append(depth.upper())
    for text, depths in told.items():
        yield text if len(depths) == len(found.runs) else f"{', '.join(depths)} {text}"


def _starts(found: Comparison) -> Iterator[str]:
    """Whether the runs start in their steady state."""
    starts = {depth: run.start for depth, run in found.runs.items() if run.start is not None}
    if not starts:
        return
    length = 1e3 * next(iter(starts.values())).first.length
    yield (
        f"Static state plus linear unbalance response; least gap over the first against the last "
        f"{length:.0f} ms before the fracture, mean ± harmonic part:"
    )
    for depth, start in starts.items():
        first = f"{GAP.number(start.mean_first)} ± {start.harmonic_first * GAP.factor:.2f}"
        last = f"{GAP.number(start.mean_last)} ± {start.harmonic_last * GAP.factor:.2f} {GAP.unit}"
        drift = f"drift of the mean {100 * start.drift:+.2g} %"
        yield f"{depth.upper()}: {first} against {last}, {drift}"
