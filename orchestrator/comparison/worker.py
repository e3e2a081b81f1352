"""What the process of one run does: simulate, write the run's folder, tell how it ended."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.synchronize import Event
from pathlib import Path

from orchestrator.errors import OrchestratorError
from orchestrator.outcome import Outcome
from orchestrator.run_command import write_data
from orchestrator.scenario import Scenario
from orchestrator.simulate import Stage, simulate
from orchestrator.summary import summarise

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
    """

    name: str
    scenario: Scenario
    fmus: Path
    folder: Path


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
        Value of an `Outcome`, or `orchestrator.comparison.processes.DIED`.
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
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent asks by `stop`, a unit is never cut off
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

    try:
        result = simulate(task.scenario, task.fmus, report)
    except OrchestratorError as error:
        connection.send(OrchestratorError(str(error)))
        return
    except KeyboardInterrupt:
        outcome = Outcome.INTERRUPTED
        connection.send(Ended(outcome.value, "before the first step", outcome.advice, 0.0, 0.0))
        return
    summary = summarise(result)
    task.folder.mkdir(parents=True, exist_ok=True)
    if summary.phases:
        write_data(result, summary, task.scenario, task.folder)
    outcome = result.outcome
    connection.send(
        Ended(outcome.value, result.message, outcome.advice, summary.simulated, result.timing.loop)
    )
