"""What a run gives and what it cost."""

from __future__ import annotations

from dataclasses import dataclass, field
from time import perf_counter

import xarray as xr

from orchestrator.master.stepping import StepCounts
from orchestrator.outcome import Outcome


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

    load: float = 0.0
    equilibrium: float = 0.0
    film: float = 0.0
    rotor: float = 0.0
    fmi: float = 0.0
    record: float = 0.0
    master: float = 0.0

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


class Stopwatch:
    """Wall time from lap to lap."""

    def __init__(self) -> None:
        self._last = perf_counter()

    def lap(self) -> float:
        """Return the time since the last lap in s."""
        now = perf_counter()
        elapsed, self._last = now - self._last, now
        return elapsed
