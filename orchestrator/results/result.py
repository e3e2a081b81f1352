"""What a run gives and what it cost."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum
from time import perf_counter

import xarray as xr

from orchestrator.fmi.watchdog import Watchdog
from orchestrator.master.stepping import StepCounts
from orchestrator.observers.checkpoint import Checkpoint, Checkpoints
from orchestrator.outcome import Outcome


class Stage(StrEnum):
    """What a call to `simulate` is busy with; the value is fit for display."""

    LOAD = "loading FMUs"
    WARM_UP = "first evaluation"  # long where numba has to compile the films, once per installation
    EQUILIBRIUM = "static equilibrium"
    RUN = "time loop"


Progress = Callable[[Stage, float], None]
"""Called with the stage and the simulated time in s: once at the start of each stage, then after every
macro step of `Stage.RUN` (the callee decides how often it redraws)."""


@dataclass(frozen=True)
class Timing:
    """Wall time of a run, in s.

    Attributes
    ----------
    load, equilibrium : float
        Before the time loop; ``load`` includes numba's compilation where its cache is cold.
    film, rotor : float
        In the time loop, inside ``fmi2DoStep`` of the bearings and of the rotor.
    fmi : float
        Getting and setting of variables, and the gathering between them.
    record : float
        Observation of every macro step and the fields at the record instants.
    master : float
        The rest of the time loop.
    """

    load: float
    equilibrium: float
    film: float
    rotor: float
    fmi: float
    record: float
    master: float

    @property
    def loop(self) -> float:
        """The whole time loop."""
        return self.film + self.rotor + self.fmi + self.record + self.master


@dataclass(frozen=True)
class Result:
    """What a run gives.

    Attributes
    ----------
    record : xarray.Dataset
        Up to the end or to where the run failed; may hold no instant but the start, or none at all when no
        equilibrium was found.
    outcome : Outcome
        How it ended.
    message : str
        Empty, or what failed: unit, time, and the reason it logged.
    timing : Timing
        Wall time by part.
    steps : int
        Steps carried out.
    evaluations : int
        Steps of bearing units in the time loop, over all bearings.
    counts : StepCounts
        Accepted and rejected steps, iterations.
    """

    record: xr.Dataset
    outcome: Outcome
    message: str
    timing: Timing
    steps: int
    evaluations: int
    counts: StepCounts = field(default_factory=StepCounts)


@dataclass(frozen=True)
class Execution:
    """How a run is carried out, without influence on its numbers.

    Attributes
    ----------
    checkpoints : Checkpoints or None
        Writes the run to disk as it goes.
    resume : Checkpoint or None
        Where to go on instead of at the start.
    threads : int
        On which the bearings step.
    watchdog : Watchdog
        Ends the run when a unit hangs; asleep by itself.
    """

    checkpoints: Checkpoints | None = None
    resume: Checkpoint | None = None
    threads: int = 1
    watchdog: Watchdog = field(default_factory=Watchdog)


class Stopwatch:
    """Wall time from lap to lap."""

    def __init__(self) -> None:
        self._last = perf_counter()

    def lap(self) -> float:
        """Return the time since the last lap in s."""
        now = perf_counter()
        elapsed, self._last = now - self._last, now
        return elapsed
