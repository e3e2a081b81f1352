"""A run of a scenario, as it is carried out in a process that does many of them."""

from __future__ import annotations

import time
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
from orchestrator.master.assembly import Part, parts_in_folder
from orchestrator.results.result import Result
from orchestrator.results.verdicts.limits import ATTRIBUTE
from orchestrator.scenario.parameters import needed_depths
from orchestrator.scenario.scenario import Scenario
from orchestrator.study.ensemble.bench import Bench
from orchestrator.study.ensemble.keep import row_of
from orchestrator.study.ensemble.row import REFUSED, Row
from orchestrator.study.ensemble.schema import Keep
from rotor_fmu.train.train import Train

_MOST = 24
"""Distinct FMUs that a process keeps extracted."""
_QUIET = Console(quiet=True)


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
            if self._store is not None and len(self._seen) >= _MOST:
                self._store.close()
                self._store = None
                self._seen.clear()
            ensure_fmus(fmus, rotor, needed, _QUIET)
            self._seen.add(key)
        do_ahead(scenario, train, needed, _QUIET)
        if self._store is None:
            self._store = FmuStore()
        return self._store


@dataclass
class _SharedUnits(FolderUnits):
    """Units whose rotor serves all trains that differ in the films of their bearings only."""

    rotor: Train = field(kw_only=True)

    def parts(self, scenario: Scenario) -> Iterator[Part]:
        """Return the units of the scenario's depths, with its parameters."""
        return parts_in_folder(scenario, self.train, self.place, self.store, self.rotor)


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
            units = _SharedUnits(self.train, self.fmus, store, self.speed, rotor=self.rotor)
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
