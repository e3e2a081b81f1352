"""A run with all that surrounds it: progress, signals, units that change the process."""

from __future__ import annotations

from rich.console import Console

from orchestrator.case.case import Case
from orchestrator.case.own_process import undisturbed
from orchestrator.case.progress import show_progress
from orchestrator.case.simulate import Execution, execute
from orchestrator.master.interrupt import interrupt_between_steps
from orchestrator.results.result import Result


def carry_out(case: Case, console: Console, execution: Execution) -> Result:
    """Execute a case with its progress on the console; signals wait for the end of a step.

    On a console that says nothing they come as they come.
    """
    with undisturbed():
        if console.quiet:
            return execute(case, None, execution)
        with show_progress(case.scenario.end, console) as show, interrupt_between_steps(show) as progress:
            return execute(case, progress, execution)
