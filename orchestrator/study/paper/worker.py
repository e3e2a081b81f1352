"""What the process of one run does: simulate, write the run's folder, tell how it ended."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.synchronize import Event
from pathlib import Path

from orchestrator.case.simulate import Execution, Result, Stage, simulate
from orchestrator.errors import NotWrittenError, OrchestratorError
from orchestrator.fmi.watchdog import BUDGET, Watchdog, leave
from orchestrator.master.interrupt import SIGNALS
from orchestrator.outcome import Outcome
from orchestrator.results.files import room_for, write_data
from orchestrator.results.folder import result_folder
from orchestrator.results.summary import summarise
from orchestrator.scenario.scenario import Scenario

PERIOD = 0.2
"""Least wall time between two messages of progress [s]."""


@dataclass(frozen=True)
class Task:
    """A run to be done.

    Attributes
    ----------
    name : str
        Told with its progress.
    scenario : Scenario
        What is simulated.
    fmus, folder : Path
        Folder of the FMUs, and of the results, made by the run.
    budget : float
        Wall time in s that a call to a unit may take; 0 for any.
    """

    name: str
    scenario: Scenario
    fmus: Path
    folder: Path
    budget: float = BUDGET


@dataclass(frozen=True)
class Progressed:
    """How far a run is: its stage and simulated time [s]."""

    stage: Stage
    simulated: float


@dataclass(frozen=True)
class Ended:
    """How a run ended.

    Attributes
    ----------
    outcome : str
        Value of an `Outcome`, or `orchestrator.study.paper.processes.DIED`.
    message, advice : str
        What failed, what helps.
    simulated : float
        Simulated time reached [s].
    wall_time : float
        Of the time loop [s].
    """

    outcome: str
    message: str
    advice: str
    simulated: float
    wall_time: float

    @property
    def ok(self) -> bool:
        """Whether the run is complete."""
        return self.outcome == Outcome.FINISHED.value

    def text(self) -> str:
        """How it ended, for people."""
        words = f"{self.outcome} at t = {self.simulated:.4g} s"
        return f"{words}: {self.message}" if self.message else words


Message = Progressed | Ended | OrchestratorError
Work = Callable[[Task, Connection, Event], None]


def simulate_task(task: Task, connection: Connection, stop: Event) -> None:
    """Carry out a task in a process of its own.

    Parameters
    ----------
    task : Task
        The run.
    connection : Connection
        Takes `Progressed`, at the end an `Ended` or an `OrchestratorError`.
    stop : Event
        Set when the run is to end early; it ends between two macro steps.
    """
    for number in SIGNALS:  # the parent asks by `stop`, a unit is never cut off
        signal.signal(number, signal.SIG_IGN)
    due, stage_before = 0.0, None

    def report(stage: Stage, simulated: float) -> None:
        nonlocal due, stage_before
        now = time.monotonic()
        if now < due and stage is stage_before:
            return
        due, stage_before = now + PERIOD, stage
        connection.send(Progressed(stage, simulated))
        if stop.is_set():
            raise KeyboardInterrupt

    def conclude(result: Result) -> int:
        _conclude(task, result, connection)
        return 0

    try:
        with Watchdog(task.budget, lambda hung: leave(lambda: conclude(hung))) as watchdog:
            result = simulate(task.scenario, task.fmus, report, Execution(watchdog=watchdog))
    except OrchestratorError as error:
        connection.send(OrchestratorError(str(error)))
        return
    except KeyboardInterrupt:
        outcome = Outcome.INTERRUPTED
        connection.send(Ended(outcome.value, "before the first step", outcome.advice, 0.0, 0.0))
        return
    conclude(result)


def _conclude(task: Task, result: Result, connection: Connection) -> None:
    """Write the run's folder and tell how it ended."""
    summary = summarise(result)
    outcome, message = result.outcome, result.message
    try:
        with room_for([result.record], task.folder), result_folder(task.folder) as fresh:
            if summary.phases:
                write_data(result, summary, task.scenario, fresh)
    except NotWrittenError as error:
        outcome, message = Outcome.NOT_WRITTEN, str(error)
    connection.send(Ended(outcome.value, message, outcome.advice, summary.simulated, result.timing.loop))
