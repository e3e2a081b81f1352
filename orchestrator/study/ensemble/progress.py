"""Progress of a study: runs done, rate, remaining time."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn

from orchestrator.case.progress import REDRAW, duration
from orchestrator.study.ensemble.running.row import Row


class Tally:
    """Counts runs.

    Parameters
    ----------
    total : int
        To be done.
    clock : callable
        Wall time in s.
    """

    def __init__(self, total: int, clock: Callable[[], float] = time.monotonic) -> None:
        self.total, self.done, self.others = total, 0, 0
        self._clock, self._begin = clock, clock()

    def count(self, row: Row) -> None:
        """Count one that has ended."""
        self.done += 1
        self.others += row.outcome != "finished"

    def text(self) -> str:
        """How far it is, in words."""
        spent = self._clock() - self._begin
        text = f"{self.done} of {self.total} runs"
        if self.done and spent > 0.0:
            rate = self.done / spent
            said = f"{rate:.3g} a second" if rate >= 1.0 else f"{60.0 * rate:.3g} a minute"
            text += f", {said}, {duration((self.total - self.done) / rate)} left"
        return text + (f", {self.others} not finished" if self.others else "")


@contextmanager
def show_tally(what: str, total: int, console: Console) -> Iterator[Callable[[Row], None]]:
    """Show the progress of runs: a bar on a terminal, a line every ten per cent elsewhere."""
    tally = Tally(total)
    if not console.is_terminal:
        console.print(f"{what}: {total} runs", highlight=False)

        def say(row: Row) -> None:
            before = 10 * tally.done // total
            tally.count(row)
            if 10 * tally.done // total > before:
                console.print(f"{100 * tally.done // total:4d} %  {tally.text()}", highlight=False)

        yield say
        return
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.fields[pace]}"),
    )
    with Progress(*columns, console=console, transient=True, auto_refresh=False) as bars:
        task = bars.add_task(what, total=total, pace="")
        shown = [0.0]

        def draw(row: Row) -> None:
            tally.count(row)
            if time.monotonic() - shown[0] > REDRAW:
                shown[0] = time.monotonic()
                bars.update(task, completed=tally.done, pace=tally.text(), refresh=True)

        yield draw
