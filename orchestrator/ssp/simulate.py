"""Run an SSP: the orchestrator in the place of another tool, on the same system and the same start."""

from __future__ import annotations

import hashlib
import tempfile
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from orchestrator.case.simulate import Execution, Progress, Result, Stage, Stopwatch, carry_out, failed_start
from orchestrator.errors import FmuError
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.unit import Unit, UnitError
from orchestrator.master.start.equilibrium import Start
from orchestrator.master.system import System
from orchestrator.outcome import Outcome
from orchestrator.scenario.parameters import offset_names, start_names
from orchestrator.scenario.scenario import Scenario
from orchestrator.ssp.contents import Contents, parameters, understand, value_of
from orchestrator.ssp.reader import read_ssp
from orchestrator.ssp.scenario import as_scenario
from rotor_fmu.train.train import Train


class SspRun:
    """An SSP, read and checked, ready to be run; a context that removes what was extracted.

    Parameters
    ----------
    path : Path
        The ``.ssp`` file.
    overrides : mapping
        See `orchestrator.ssp.contents.as_scenario`.

    Raises
    ------
    SspError, FmuError
        When it cannot be run.

    Attributes
    ----------
    scenario, train : Scenario, Train
        What the SSP describes.
    fmus : dict
        The extracted FMUs, by the name to show.
    """

    def __init__(self, path: Path, overrides: Mapping[str, Any] | None = None) -> None:
        self.path = path
        self._clock = Stopwatch()
        self._store = FmuStore()
        self._folder = tempfile.TemporaryDirectory(prefix="bladeloss_ssp_")
        try:
            folder = Path(self._folder.name)
            self._contents = understand(read_ssp(path, folder), path, folder, self._store)
            self.scenario: Scenario = as_scenario(self._contents, overrides or {}, path)
        except Exception:
            self.close()
            raise
        self.train: Train = self._contents.train
        self.fmus: dict[str, Path] = {
            f"{path}: {c.source}": self._contents.files[c.name].path
            for c in self._contents.structure.components
        }

    def simulate(
        self,
        scenario: Scenario | None = None,
        progress: Progress | None = None,
        execution: Execution | None = None,
    ) -> Result:
        """Run it from its start parameters; no equilibrium is sought.

        Parameters
        ----------
        scenario : Scenario, optional
            In place of `scenario`, with another step or tolerance.
        progress, execution
            As in `orchestrator.case.simulate.simulate`.

        Raises
        ------
        FmuError, PortError, SspError
            When an FMU cannot be instantiated, lacks the port or does not take its parameters.
        """
        announce = progress or (lambda _stage, _time: None)
        execution = execution or Execution()
        scenario = scenario or self.scenario
        execution.watchdog.partial = partial(failed_start, scenario, self.train, Outcome.UNIT_HUNG)
        execution.watchdog.leftovers += [self._store.remove, self._folder.cleanup]
        announce(Stage.LOAD, 0.0)
        system = _assemble(self._contents, scenario, self.path, execution.threads)
        try:
            result = carry_out(
                scenario,
                self.train,
                system,
                lambda: _start(self._contents),
                self._clock,
                announce,
                execution,
            )
        finally:
            system.close()
        digest = hashlib.sha256(self.path.read_bytes()).hexdigest()
        result.record.attrs["ssp"] = f"{self.path.name} sha256 {digest}"
        return result

    def close(self) -> None:
        """Remove what was extracted."""
        self._store.close()
        self._folder.cleanup()

    def __enter__(self) -> SspRun:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _assemble(contents: Contents, scenario: Scenario, path: Path, threads: int) -> System:
    units: list[Unit] = []
    try:
        names = ["rotor", *(seat.name for seat in contents.train.bearings)]
        components = [contents.rotor, *contents.bearings]
        for name, component in zip(names, components, strict=True):
            units.append(Unit(contents.files[component.name], name, release_gil=threads > 1))
        system = System(units[0], units[1:], contents.wiring)
        system.bearing_group.employ(threads)
        for unit, component in zip(units, components, strict=True):
            unit.check_steps(scenario.step, scenario.end, scenario.tolerance is not None)
            unit.set_parameters(parameters(component, unit.file, path))
        if scenario.ledger:
            units[0].set_parameters({"track_work": True})
        system.set_speed(float(value_of(contents, contents.rotor, "speed")))
        for unit in units:
            unit.enter_initialization(0.0, scenario.end)
    except Exception as error:
        for unit in units:
            unit.close()
        if isinstance(error, UnitError):
            raise FmuError(f"{path}: {error}") from None
        raise
    return system


def _start(contents: Contents) -> Start:
    """Return the start as the parameters say; forces and line follow when it is applied."""
    count = len(contents.bearings)
    parts = {
        part: np.array([float(value_of(contents, contents.rotor, n)) for n in start_names(count, part)])
        for part in ("", "_cos", "_sin")
    }
    offsets = [[value_of(contents, c, name) for name in offset_names()] for c in contents.bearings]
    return Start(
        loads=np.full((count, 2), np.nan),
        offsets=np.array(offsets, dtype=float),
        static=parts[""].reshape(count, 4),
        cosine=parts["_cos"].reshape(count, 4),
        sine=parts["_sin"].reshape(count, 4),
        static_line=np.full((contents.train.nodes, 2), np.nan),
    )
