"""From a scenario and a folder of FMUs to a record: the entry point of command line and tests."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from time import perf_counter

import numpy as np
import xarray as xr

from orchestrator.assembly import assemble
from orchestrator.coupling import SCHEMES, make_scheme
from orchestrator.equilibrium import Start, begin, find_start
from orchestrator.errors import EquilibriumError
from orchestrator.film_position import evaluate
from orchestrator.fmu_file import FmuStore
from orchestrator.outcome import Outcome
from orchestrator.record import empty_record, make_record
from orchestrator.recorder import Recorder
from orchestrator.run import Course, run
from orchestrator.scenario import Scenario
from orchestrator.scenario_file import train_of
from orchestrator.stepping import StepCounts
from orchestrator.system import System
from orchestrator.unit import UnitError
from rotor_fmu.train import Train


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
    announce = progress or (lambda _stage, _time: None)
    train = train_of(scenario)
    clock = Stopwatch()
    with FmuStore() as store:
        announce(Stage.LOAD, 0.0)
        system = assemble(scenario, train, fmus, store)
        try:
            return carry_out(
                scenario,
                train,
                system,
                lambda: find_start(system, train.bearings, train.speed, train.nodes),
                clock,
                announce,
            )
        finally:
            system.close()


def carry_out(
    scenario: Scenario,
    train: Train,
    system: System,
    find: Callable[[], Start],
    clock: Stopwatch,
    announce: Progress,
) -> Result:
    """Run an assembled system.

    Parameters
    ----------
    scenario, train : Scenario, Train
        What is run, and how it is coupled and recorded.
    system : System
        In Initialization Mode, parameters set.
    find : callable
        Returns the start of the run.
    clock : Stopwatch
        Started before the units were loaded.
    announce : callable
        See `Progress`.
    """
    announce(Stage.WARM_UP, 0.0)
    _warm_up(system, train)
    load = clock.lap()
    announce(Stage.EQUILIBRIUM, 0.0)
    try:
        start = begin(system, find(), train.nodes)
    except (EquilibriumError, UnitError) as error:
        record = empty_record(scenario, train, Outcome.NO_EQUILIBRIUM, str(error))
        timing = Timing(load, clock.lap(), 0.0, 0.0, 0.0, 0.0, 0.0)
        return Result(record, Outcome.NO_EQUILIBRIUM, str(error), timing, 0, 0)
    equilibrium = clock.lap()
    announce(Stage.RUN, 0.0)
    course = _course(scenario)
    stride = max(1, round(scenario.record.interval / scenario.step))
    recorder = Recorder(system, train.nodes, course.steps, stride)
    loads = np.abs(start.loads)
    system.set_scale(float(loads.mean()), [seat.width for seat in train.bearings])
    before = [(group.step_time, group.exchange_time) for group in system.groups]
    end = run(
        system,
        make_scheme(scenario.coupling, scenario.tolerance),
        recorder,
        course,
        on_time=lambda time: announce(Stage.RUN, time),
    )
    (rotor, rotor_exchange), (film, film_exchange) = (
        (group.step_time - earlier[0], group.exchange_time - earlier[1])
        for group, earlier in zip(system.groups, before, strict=True)
    )
    fmi = rotor_exchange + film_exchange
    rest = end.wall_time - film - rotor - fmi - end.record_time
    provenance = {unit.file.path.name: str(unit.file.description.guid) for unit in system.units}
    return Result(
        make_record(recorder, start, scenario, train, end.outcome, end.message, provenance).assign_attrs(
            end.counts.attributes(system.bearing_group.evaluations)
        ),
        end.outcome,
        end.message,
        Timing(load, equilibrium, film, rotor, fmi, end.record_time, rest),
        end.counts.accepted,
        system.bearing_group.evaluations,
        end.counts,
    )


def _course(scenario: Scenario) -> Course:
    """Steps end on the fracture where they are controlled; else the rotor takes it inside a step, exactly."""
    controlled = scenario.tolerance is not None or SCHEMES[scenario.coupling].iterates
    event = scenario.event.time if controlled and scenario.event is not None else None
    return Course(scenario.end, scenario.step, scenario.tolerance, event)


def _warm_up(system: System, train: Train) -> None:
    """Let every unit compute once, so that reductions and compilations count as loading."""
    positions = np.zeros((len(train.bearings), 4))
    positions[:, 1] = [-0.5 * seat.clearance for seat in train.bearings]
    evaluate(system, positions)
    system.rotor_group.fetch()


class Stopwatch:
    """Wall time from lap to lap."""

    def __init__(self) -> None:
        self._last = perf_counter()

    def lap(self) -> float:
        """Return the time since the last lap in s."""
        now = perf_counter()
        elapsed, self._last = now - self._last, now
        return elapsed
