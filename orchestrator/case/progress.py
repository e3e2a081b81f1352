"""Progress of a run: a bar on a terminal, a line every ten per cent elsewhere."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import StrEnum

from rich.console import Console
from rich.progress import BarColumn, SpinnerColumn, TextColumn
from rich.progress import Progress as Bars


class Stage(StrEnum):
    """What a run is busy with; the value is fit for display."""

    LOAD = "loading FMUs"
    WARM_UP = "first evaluation"  # long where numba has to compile the films, once per installation
    EQUILIBRIUM = "static equilibrium"
    RUN = "time loop"


Progress = Callable[[Stage, float], None]
"""Called with the stage and the simulated time in s: once at the start of each stage, then after every
macro step of `Stage.RUN` (the callee decides how often it redraws)."""

REDRAW = 0.2
"""Least wall time between two redraws [s]."""


class Pace:
    """Speed and remaining time of the time loop.

    Parameters
    ----------
    end : float
        End of the simulated time [s].
    clock : callable
        Wall time [s].
    """

    def __init__(self, end: float, clock: Callable[[], float] = time.monotonic) -> None:
        self.end = end
        self._clock = clock
        self._begin = clock()
        self._from = 0.0

    def start(self, simulated: float) -> None:
        """Begin to count at this simulated time [s]."""
        self._begin, self._from = self._clock(), simulated

    def speed(self, simulated: float) -> float:
        """Simulated seconds in a second of wall time; 0 before anything can be said."""
        passed = self._clock() - self._begin
        return (simulated - self._from) / passed if passed > 0 else 0.0

    def text(self, simulated: float) -> str:
        """Simulated time, speed and remaining time in words."""
        speed = self.speed(simulated)
        if speed <= 0:
            return f"{simulated:.3f} of {self.end:g} s"
        left = max(0.0, self.end - simulated) / speed
        return f"{simulated:.3f} of {self.end:g} s, {speed:.3g} s a second, {duration(left)} left"


def duration(seconds: float) -> str:
    """A wall time in words."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60}:{whole % 60:02d} min"
    return f"{whole // 3600}:{whole % 3600 // 60:02d} h"


@contextmanager
def show_progress(end: float, console: Console) -> Iterator[Progress]:
    """Show a run's progress on a console.

    Parameters
    ----------
    end : float
        End of the simulated time [s].
    console : rich.console.Console
        A terminal gets a bar, anything else a line at each stage and every ten per cent.

    Yields
    ------
    callable
        To be handed to `orchestrator.case.simulate.execute` as its ``progress``.
    """
    if not console.is_terminal:
        yield _Lines(end, console)
        return
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description:<18}"),
        BarColumn(),
        TextColumn("{task.fields[pace]}"),
    )
    with Bars(*columns, console=console, transient=True, auto_refresh=False) as bar:
        yield _Bar(end, bar)


class _Bar:
    """A rich progress bar, redrawn a few times a second from the time loop itself."""

    def __init__(self, end: float, bar: Bars) -> None:
        self._pace = Pace(end)
        self._bar = bar
        self._task = bar.add_task("", total=None, pace="")
        self._stage: Stage | None = None
        self._next = 0.0

    def __call__(self, stage: Stage, simulated: float) -> None:
        now = time.monotonic()
        if stage is not self._stage:
            self._stage = stage
            self._pace.start(simulated)
            running = stage is Stage.RUN
            self._bar.reset(
                self._task, description=str(stage), total=self._pace.end if running else None, pace=""
            )
        elif now < self._next:
            return
        self._next = now + REDRAW
        if stage is Stage.RUN:
            self._bar.update(self._task, completed=simulated, pace=self._pace.text(simulated))
        self._bar.refresh()


class _Lines:
    """Plain lines for logs."""

    def __init__(self, end: float, console: Console) -> None:
        self._pace = Pace(end)
        self._console = console
        self._stage: Stage | None = None
        self._tenth = 0

    def __call__(self, stage: Stage, simulated: float) -> None:
        if stage is not self._stage:
            self._stage = stage
            self._pace.start(simulated)
            self._console.print(f"{stage} ...", highlight=False)
        tenth = int(10.0 * simulated / self._pace.end + 1e-9)
        if stage is Stage.RUN and tenth > self._tenth:
            self._tenth = tenth
            self._console.print(f"{10 * tenth:4d} %  {self._pace.text(simulated)}", highlight=False)
