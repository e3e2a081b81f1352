"""From a scenario and a folder of FMUs to a record: the entry point of command line and tests."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

import xarray as xr

from orchestrator.outcome import Outcome
from orchestrator.scenario import Scenario


class Stage(StrEnum):
    """What a call to `simulate` is busy with; the value is fit for display."""

    LOAD = "loading FMUs"
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
        Macro steps carried out.
    evaluations : int
        Steps of bearing units in the time loop, over all bearings.
    """

    record: xr.Dataset
    outcome: Outcome
    message: str
    timing: Timing
    steps: int
    evaluations: int


def simulate(scenario: Scenario, fmus: Path, progress: Progress | None = None) -> Result:
    """Run a scenario on FMUs.

    Parameters
    ----------
    scenario : Scenario
        From `orchestrator.scenario_file.load_scenario`.
    fmus : Path
        Folder with the rotor FMU of the scenario's train and the bearing FMUs of its depths.
    progress : callable, optional
        See `Progress`.

    Returns
    -------
    Result
        Also for a run that fails on its way.

    Raises
    ------
    FmuError
        When an FMU is missing or cannot be instantiated.
    PortError
        When an FMU does not carry the port.
    """
    raise NotImplementedError
