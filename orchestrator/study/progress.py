"""Progress of runs side by side: a bar each on a terminal, the lines that they print elsewhere."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn

from orchestrator.study.children import Ended, Show

_TENTH, _STAGE = re.compile(r" *(\d+) %  (.*)"), re.compile(r"(.*) \.\.\.")
"""What `orchestrator.case.progress` prints where there is no terminal."""


@contextmanager
def show_runs(names: Sequence[str], console: Console) -> Iterator[Show]:
    """Show the progress of runs on a console; yields what `run_children` tells it to."""
    if not console.is_terminal:
        yield lambda name, said: _print(console, name, said)
        return
    columns = (
        TextColumn("{task.fields[run]:<6} {task.description:<18}"),
        BarColumn(),
        TextColumn("{task.fields[pace]}"),
    )
    with Progress(SpinnerColumn(), *columns, console=console, transient=True) as bars:
        tasks = {name: bars.add_task("waiting", total=None, run=name, pace="") for name in names}

        def show(name: str, said: str | Ended) -> None:
            task = tasks[name]
            if isinstance(said, Ended):
                bars.update(task, description=said.outcome, total=100, completed=100, pace="")
            elif found := _TENTH.fullmatch(said):
                bars.update(task, total=100, completed=int(found[1]), pace=found[2])
            elif found := _STAGE.fullmatch(said):
                bars.reset(task, description=found[1], total=None)

        yield show


def _print(console: Console, name: str, said: str | Ended) -> None:
    if isinstance(said, Ended):
        said = said.text()
    elif not (_TENTH.fullmatch(said) or _STAGE.fullmatch(said)):
        return  # its summary, which lies in its folder
    console.print(f"{name}  {said}", highlight=False, soft_wrap=True)
