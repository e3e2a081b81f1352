"""A run of a scenario, as it is carried out in a process that does many of them."""

from __future__ import annotations

import hashlib
import time
from collections import OrderedDict
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

from rich.console import Console

from orchestrator.case.carry_out import carry_out
from orchestrator.case.case import Case, FolderUnits
from orchestrator.case.simulate import Execution
from orchestrator.errors import OrchestratorError
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.folder import do_ahead, ensure_fmus
from orchestrator.fmi.watchdog import Watchdog
from orchestrator.master.assembly import Part, found_parameters, parts_in_folder
from orchestrator.master.rollback import forgets
from orchestrator.master.start.equilibrium import Start
from orchestrator.master.system import System
from orchestrator.results.result import Result
from orchestrator.results.verdicts.limits import ATTRIBUTE
from orchestrator.scenario.parameters import Values, needed_depths
from orchestrator.scenario.scenario import Scenario, is_fmu
from orchestrator.study.ensemble.running.bench import Bench
from orchestrator.study.ensemble.running.keep import row_of
from orchestrator.study.ensemble.running.row import REFUSED, Row
from orchestrator.study.ensemble.sampling.schema import Keep
from rotor_fmu.train.train import Train

_MOST = 24
"""Distinct FMUs that a process keeps extracted."""
_STARTS = 256
"""Starts that a process keeps."""
_QUIET = Console(quiet=True)


@dataclass
class _Known:
    """What runs of equal starts need not find again."""

    parameters: dict[str, Values] | None = None
    start: Start | None = None


class _Starts:
    """Starts of runs by what decides on them; runs that differ in what happens later share one."""

    def __init__(self) -> None:
        self._known: OrderedDict[str, _Known] = OrderedDict()

    @property
    def all(self) -> list[_Known]:
        """What is known, the latest last."""
        return list(self._known.values())

    def of(self, scenario: Scenario, train: Train) -> _Known:
        """What is known about the start of a scenario, to be completed."""
        begins_broken = any(event.time == 0.0 for event in scenario.events)
        if begins_broken or any(is_fmu(scenario.depth_of(seat.name)) for seat in train.bearings):
            return _Known()
        said = scenario.model_dump_json(exclude={"title", "events", "end"})
        key = hashlib.sha256(f"{said}\n{train!r}".encode()).hexdigest()
        found = self._known.setdefault(key, _Known())
        self._known.move_to_end(key)
        if len(self._known) > _STARTS:
            self._known.popitem(last=False)
        return found


class _Extracted:
    """FMUs that are built, and extracted once for all runs of a process."""

    def __init__(self) -> None:
        self._store: FmuStore | None = None
        self._seen: set[tuple[str, ...]] = set()

    def store_for(self, fmus: Path, rotor: Train, scenario: Scenario, train: Train) -> FmuStore:
        """The store of extracted FMUs, with those of a run built in their folder."""
        needed = needed_depths(scenario, train)
        key = (str(fmus), repr(rotor), *sorted(needed))
        if key not in self._seen:
            if len(self._seen) >= _MOST:
                self.close()
            ensure_fmus(fmus, rotor, needed, _QUIET)
            self._seen.add(key)
        do_ahead(scenario, train, needed, _QUIET)
        if self._store is None:
            self._store = FmuStore()
        return self._store

    def close(self) -> None:
        """Remove what is extracted."""
        if self._store is not None:
            self._store.close()
            self._store = None
        self._seen.clear()


@dataclass
class _SharedUnits(FolderUnits):
    """Units whose rotor serves all trains that differ in the films of their bearings only."""

    rotor: Train = field(kw_only=True)
    known: _Known = field(kw_only=True)

    def parts(self, scenario: Scenario) -> Iterator[Part]:
        """Return the units of the scenario's depths, with its parameters."""
        if self.known.parameters is None:
            self.known.parameters = found_parameters(scenario, self.train, self.place, self.store)
        return parts_in_folder(
            scenario, self.train, self.place, self.store, self.rotor, self.known.parameters
        )

    def find_start(self, system: System) -> Start:
        """The equilibrium of the train on its films; films with a memory find it themselves."""
        if self.known.start is not None:
            return self.known.start
        start = super().find_start(system)
        if all(forgets(unit) for unit in system.bearings):
            self.known.start = start
        return start


@dataclass(frozen=True)
class RunWork:
    """A run of a scenario.

    Attributes
    ----------
    scenario, train : Scenario, Train
        What is run.
    rotor : Train
        Whose rotor is that of the train.
    fmus : Path
        Folder of the FMUs.
    limits : str
        Of the machine, for verdicts.
    keep : Keep
        What is kept.
    budget : float
        Wall time in s that a call to a unit may take; 0 for any.
    """

    scenario: Scenario
    train: Train
    rotor: Train
    fmus: Path
    limits: str
    keep: Keep
    budget: float

    @cached_property
    def speed(self) -> float:
        """At the start, in rad/s."""
        return self.scenario.start_speed(self.train.speed)

    def carry_out(self, bench: Bench) -> Row:
        """Run it."""
        begin = time.perf_counter()
        try:
            extracted = bench.shared.setdefault("extracted", _Extracted())
            store = extracted.store_for(self.fmus, self.rotor, self.scenario, self.train)
            known = bench.shared.setdefault("starts", _Starts()).of(self.scenario, self.train)
            units = _SharedUnits(self.train, self.fmus, store, self.speed, rotor=self.rotor, known=known)
            case = Case(self.scenario, self.train, units)
            with Watchdog(self.budget, lambda hung: bench.give_up(self._row(hung, begin))) as watchdog:
                result = carry_out(case, _QUIET, Execution(watchdog=watchdog))
            return self._row(result, begin)
        except OrchestratorError as error:
            if error.outcome is not None:
                return Row(error.outcome.value, str(error))
            return Row(REFUSED, str(error))

    def _row(self, result: Result, begin: float) -> Row:
        record = result.record.assign_attrs({ATTRIBUTE: self.limits})
        row = row_of(replace(result, record=record), self.keep, {})
        spent = time.perf_counter() - begin
        return replace(row, timing={"loop": result.timing.loop, "run": spent})
