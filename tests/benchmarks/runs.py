"""What the benchmarks share: prepared cases, timed runs of couplings, errors against the holistic model."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from orchestrator.case.progress import Stage
from orchestrator.case.simulate import Execution, simulate
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.folder import build
from orchestrator.master.assembly import assemble
from orchestrator.master.start.equilibrium import Start, find_start
from orchestrator.results.result import Result
from orchestrator.scenario.file import load_scenario, train_of
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.train import Train
from tests.monolithic.holistic import Holistic, holistic_model

Array = NDArray[np.float64]

_FOLDER = tempfile.TemporaryDirectory(prefix="bladeloss-benchmarks-")


@dataclass(frozen=True)
class Case:
    """A scenario made ready for every solver.

    Attributes
    ----------
    source : str
        Name of the bundled scenario.
    overrides : mapping
        What differs from it.
    start : Start
        Its start, found once through the FMUs.
    """

    source: str
    overrides: Mapping[str, Any]
    start: Start

    def scenario(self, **changes: Any) -> Scenario:
        """The scenario with further overrides."""
        return load_scenario(self.source, {**self.overrides, **changes})

    def holistic(self) -> Holistic:
        """The holistic model; a new one, so that its evaluations count from zero."""
        scenario = self.scenario()
        return holistic_model(scenario, train_of(scenario), self.start)

    def times(self) -> Array:
        """Instants at which errors are taken: those of the record."""
        scenario = self.scenario()
        count = round(scenario.end / scenario.record.interval)
        return scenario.record.interval * np.arange(count + 1)


@dataclass(frozen=True)
class TimedRun:
    """A run of a coupling.

    Attributes
    ----------
    result : Result
        From `simulate`.
    wall, cpu : float
        Wall and processor time of the time loop [s].
    """

    result: Result
    wall: float
    cpu: float

    @property
    def forces(self) -> Array:
        """Fx, Fy of each bearing at the record instants, (n, n_b, 2) in N; shorter if the run failed."""
        return self.result.record["force"].values


@cache
def fmu_folder(train: Train) -> Path:
    """Folder with the FMUs of a train, built once a process and removed at its end."""
    folder = Path(_FOLDER.name) / train.name
    build(folder, [train])
    return folder


def prepare(source: str, **overrides: Any) -> Case:
    """Build the FMUs of a scenario and find its start."""
    scenario = load_scenario(source, overrides)
    train = train_of(scenario)
    with FmuStore() as store:
        system = assemble(scenario, train, fmu_folder(train), store)
        try:
            return Case(source, overrides, find_start(system, train, train.speed))
        finally:
            system.close()


def run(case: Case, *, execution: Execution | None = None, **changes: Any) -> TimedRun:
    """Run a case through the FMUs.

    Changes are `coupling`, `step` and other keys of the scenario; one thread unless `execution` has more.
    """
    scenario = case.scenario(**changes)
    clocks: list[tuple[float, float]] = []

    def watch(stage: Stage, time: float) -> None:
        """Read the clocks at both ends of the loop only: reading them costs as much as a small step."""
        if stage is Stage.RUN and (time == 0.0 or time >= scenario.end):
            clocks.append((perf_counter(), process_time()))

    result = simulate(scenario, fmu_folder(train_of(scenario)), watch, execution or Execution())
    clocks.append((perf_counter(), process_time()))  # for a run that failed before its end
    (wall, cpu), (wall_end, cpu_end) = clocks[0], clocks[1]
    return TimedRun(result, wall_end - wall, cpu_end - cpu)


def rms_error(forces: Array, reference: Array) -> float:
    """RMS over all bearings and instants of the error of Fx, Fy against that of the vibration itself.

    The forces' departure from their start, not the static load, is the measure; infinite for a run that
    did not reach the end.
    """
    if forces.shape != reference.shape:
        return float("inf")
    with np.errstate(over="ignore"):
        error = np.sqrt(np.mean((forces - reference) ** 2))
    return float(error / np.sqrt(np.mean((reference - reference[0]) ** 2)))
