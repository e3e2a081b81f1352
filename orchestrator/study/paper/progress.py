"""Progress of several runs at once: a bar each on a terminal, a line every ten per cent elsewhere."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn

from orchestrator.case.progress import Pace
from orchestrator.case.simulate import Stage
from orchestrator.study.paper.worker import Ended, Progressed

Show = Callable[[str, Progressed | Ended], None]


class _Run:
    """Stage and pace of one run."""

    def __init__(self, end: float) -> None:
        self.pace = Pace(end)
        self.stage: Stage | None = None
        self.tenth = 0

    def enters(self, message: Progressed) -> bool:
        """Whether the message begins a stage."""
        if message.stage is self.stage:
            return False
        self.stage = message.stage
        self.pace.start(message.simulated)
        return True


@contextmanager
def show_runs(names: Sequence[str], end: float, console: Console) -> Iterator[Show]:
    """Show the progress of runs.

    Parameters
    ----------
    names : sequence of str
        Names of the runs.
    end : float
        End of the simulated time [s].
    console : rich.console.Console
        A terminal gets bars, anything else lines.

    Yields
    ------
    callable
        Takes a run's name and its message.
    """
    runs = {name: _Run(end) for name in names}
    if not console.is_terminal:
        yield lambda name, message: _print(console, name, runs[name], message)
        return
    columns = (
        SpinnerColumn(),
        TextColumn("{task.fields[run]:<6} {task.description:<18}"),
        BarColumn(),
        TextColumn("{task.fields[pace]}"),
    )
    with Progress(*columns, console=console, transient=True) as bars:
        tasks = {name: bars.add_task("waiting", total=None, run=name, pace="") for name in names}

        def show(name: str, message: Progressed | Ended) -> None:
            run, task = runs[name], tasks[name]
            if isinstance(message, Ended):
                bars.update(task, description=message.outcome, total=1.0, completed=1.0, pace="")
                return
            running = message.stage is Stage.RUN
            if run.enters(message):
                total = end if running else None
                bars.reset(task, description=str(message.stage), total=total)
            if running:
                bars.update(task, completed=message.simulated, pace=run.pace.text(message.simulated))

        yield show


def _print(console: Console, name: str, run: _Run, message: Progressed | Ended) -> None:
    if isinstance(message, Ended):
        console.print(f"{name}  {message.text()}", highlight=False, soft_wrap=True)
        return
    if run.enters(message):
        console.print(f"{name}  {message.stage} ...", highlight=False)
    tenth = int(10.0 * message.simulated / run.pace.end + 1e-9)
    if message.stage is Stage.RUN and tenth > run.tenth:
        run.tenth = tenth
        console.print(f"{name}  {10 * tenth:4d} %  {run.pace.text(message.simulated)}", highlight=False)
