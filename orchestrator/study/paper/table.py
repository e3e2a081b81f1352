"""A comparison for people: the table and what its figures mean, conclusions, changes by refinement."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from io import StringIO

from rich import box
from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from orchestrator.results.quantities import GAP
from orchestrator.results.windows import Phase
from orchestrator.study.paper import paper
from orchestrator.study.paper.conclusions import limits_text
from orchestrator.study.paper.criterion import Verdict
from orchestrator.study.paper.report import Comparison, changes

TEXT_WIDTH = 120
_STYLES = {Verdict.MET: "green", Verdict.MISSED: "red", Verdict.NOT_EVALUATED: "yellow"}


class ComparisonTable:
    """Renders a comparison on a console.

    Parameters
    ----------
    comparison : Comparison
        What is shown.
    fine : Comparison or None
        The same at a finer resolution.
    """

    def __init__(self, comparison: Comparison, fine: Comparison | None = None) -> None:
        self._comparison, self._fine = comparison, fine

    def __rich_console__(self, _console: Console, _options: ConsoleOptions) -> RenderResult:
        """Table, misses, definitions, windows, conclusions."""
        found = self._comparison
        yield Text(f"{found.title}: V1, V2, V3 against the paper", style="bold")
        yield Text(
            f"analysed bearing {found.runs.seat.name}; {found.settings.text()}, {found.settings.end:g} s",
            style="dim",
        )
        yield from _failures(found)
        yield _table(found)
        yield Text(
            ", ".join(f"{found.count(verdict)} {verdict}" for verdict in Verdict if found.count(verdict))
            + f" of {len(found.rows)} rows",
            style="bold",
        )
        yield from _section("Missed", _misses(found))
        yield from _section("What an engineer would have concluded", _conclusions(found))
        if self._fine is not None:
            yield from _failures(self._fine)
            heading = f"Check: {self._fine.settings.text()} in place of {found.settings.text()}"
            yield from _section(heading, [_change_table(found, self._fine)])
        yield from _section("Windows", (Text(line) for line in _windows(found)))
        yield from _section("Start of the runs", (Text(line) for line in _starts(found)))
        yield from _section("Definitions", [_definitions(found)])


def to_text(comparison: Comparison, fine: Comparison | None = None) -> str:
    """The same without colours, for ``comparison.txt``."""
    buffer = StringIO()
    Console(file=buffer, width=TEXT_WIDTH, color_system=None, force_terminal=False).print(
        ComparisonTable(comparison, fine)
    )
    return "\n".join(line.rstrip() for line in buffer.getvalue().splitlines()) + "\n"


def _section(heading: str, content: Iterable[RenderableType]) -> Iterator[RenderableType]:
    items = list(content)
    if items:
        yield Text(f"\n{heading}", style="bold")
        yield Padding(Group(*items), (0, 0, 0, 2))


def _failures(found: Comparison) -> Iterator[Text]:
    for depth, end in found.ended.items():
        if not end.ok:
            yield Text(f"PARTIAL: {depth.upper()} {end.text()}. {end.advice}", style="bold red")


def _table(found: Comparison) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    table.add_column("#", justify="right", no_wrap=True)
    table.add_column("quantity", ratio=3)
    table.add_column("paper", ratio=3)
    table.add_column("here", ratio=4)
    table.add_column("verdict", no_wrap=True)
    for row in found.rows:
        verdict = Text(row.verdict.value, style=_STYLES[row.verdict])
        here = row.obstacle or row.here
        table.add_row(str(row.number), Text(row.quantity), Text(row.paper), Text(here), verdict)
    return table


def _misses(found: Comparison) -> Iterator[Text]:
    missed = [row for row in found.rows if row.verdict is Verdict.MISSED]
    for row in missed:
        yield Text(f"{row.number:2d}  {row.missed_by}")
    reasons: dict[str, list[str]] = {}
    for row in missed:
        reasons.setdefault(row.reason, []).append(str(row.number))
    for reason, numbers in reasons.items():
        yield Text(f"Reason, row{'s' if len(numbers) > 1 else ''} {', '.join(numbers)}: {reason}.")


def _conclusions(found: Comparison) -> Iterator[Text]:
    for item in found.conclusions:
        yield Text(item.sentence())
    yield Text(limits_text(found.runs), style="dim")


def _phase_text(phase: Phase) -> str:
    mean, peak = phase.mean, phase.peak
    text = f"means and harmonic parts {mean.start:.3f} to {mean.end:.3f} s ({mean.length:.3g} s)"
    text += f", extremes {peak.start:.3f} to {peak.end:.3f} s ({peak.length:.3g} s)"
    text += f", contact {phase.span.start:.3f} to {phase.span.end:.3f} s"
    return f"{text}; {phase.note}" if phase.note else text


def _windows(found: Comparison) -> Iterator[str]:
    told: dict[str, list[str]] = {}
    for depth, run in found.runs.observed.items():
        for condition in (run.before, run.after):
            if condition is not None:
                text = f"{condition.phase.name}: {_phase_text(condition.phase)}"
                told.setdefault(text, []).append(depth.upper())
    for text, depths in told.items():
        yield text if len(depths) == len(found.runs.depths) else f"{', '.join(depths)} {text}"


def _starts(found: Comparison) -> Iterator[str]:
    """Whether the runs start in their steady state."""
    starts = {depth: run.start for depth, run in found.runs.observed.items() if run.start is not None}
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


def _definitions(found: Comparison) -> Table:
    grid = Table.grid(padding=(0, 1))
    grid.add_column(justify="right")
    grid.add_column()
    for row in found.rows:
        grid.add_row(Text(str(row.number)), Text(f"{row.definition} (paper: {row.source})"))
    train = found.runs.train
    if train != paper.TRAIN:
        words = f"Train {train!r} is not the one fitted to the paper: its verdicts say how it differs."
        grid.add_row("", Text(words))
    return grid


def _change_table(found: Comparison, fine: Comparison) -> Group:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    table.add_column("#", justify="right", no_wrap=True)
    table.add_column("here", ratio=4)
    table.add_column("refined", ratio=4)
    table.add_column("largest change", ratio=3)
    table.add_column("verdict", ratio=2)
    found_changes = changes(found, fine)
    for row, change in zip(found.rows, found_changes, strict=True):
        size = "-" if math.isnan(change.largest) else f"{100 * change.largest:+.2g} % ({change.label})"
        verdict = Text("unchanged", style="green")
        if change.flips:
            verdict = Text(f"{change.verdict_before} -> {change.row.verdict}", style="bold red")
        refined = change.row.obstacle or change.row.here
        table.add_row(str(row.number), Text(row.obstacle or row.here), Text(refined), Text(size), verdict)
    flips = [str(change.row.number) for change in found_changes if change.flips]
    outcome = f"The verdict changes in rows {', '.join(flips)}." if flips else "No verdict changes."
    return Group(table, Text(outcome, style="bold red" if flips else "bold green"))
