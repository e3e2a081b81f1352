"""A case: what is run, on which train, and where its units come from; the same for scenario and SSP."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.trust import own_bearings
from orchestrator.master.assembly import Part, parts_in_folder
from orchestrator.master.start.equilibrium import Start, find_start
from orchestrator.master.system import System
from orchestrator.scenario.scenario import Scenario
from orchestrator.ssp.scenario import as_scenario
from orchestrator.ssp.source import SspUnits
from rotor_fmu.train.train import Train


class Units(Protocol):
    """Where the units of a case come from, and from where they start.

    Attributes
    ----------
    place : Path
        Folder or archive, for messages.
    store : FmuStore
        Extracts the FMUs.
    speed : float
        In rad/s.
    """

    place: Path
    store: FmuStore
    speed: float

    def parts(self, scenario: Scenario) -> Iterable[Part]:
        """Return the rotor and the bearings in its order."""

    def find_start(self, system: System) -> Start:
        """Find the start of a system of these units."""

    def foreign(self, scenario: Scenario) -> Mapping[str, Path]:
        """Return FMUs that may be of somebody else, by the name to show."""


@dataclass
class FolderUnits:
    """Units of a train from a folder of FMUs; the start is its static equilibrium. Otherwise as `Units`."""

    train: Train
    place: Path
    store: FmuStore
    speed: float

    def parts(self, scenario: Scenario) -> Iterable[Part]:
        """Return the units of the scenario's depths, with its parameters."""
        return parts_in_folder(scenario, self.train, self.place, self.store)

    def find_start(self, system: System) -> Start:
        """Search the equilibrium of the train on its films."""
        return find_start(system, self.train, self.speed)

    def foreign(self, scenario: Scenario) -> Mapping[str, Path]:
        """Return the FMUs that the scenario names for its bearings."""
        return own_bearings(scenario)


@dataclass(frozen=True)
class Case:
    """A scenario ready to be run.

    Attributes
    ----------
    scenario, train : Scenario, Train
        What is run, and how it is coupled and recorded.
    units : Units
        Where its units come from.
    attributes : mapping
        Of the record, besides the usual.
    about : mapping
        Kept with checkpoints: whatever leads to the same case again.
    """

    scenario: Scenario
    train: Train
    units: Units
    attributes: Mapping[str, str] = field(default_factory=dict)
    about: Mapping[str, Any] = field(default_factory=dict)


@contextmanager
def folder_case(
    scenario: Scenario, train: Train, fmus: Path, about: Mapping[str, Any] | None = None
) -> Iterator[Case]:
    """A case of a scenario on FMUs in a folder; extracts them on demand and removes that at the end."""
    with FmuStore() as store:
        yield Case(
            scenario,
            train,
            FolderUnits(train, fmus, store, scenario.start_speed(train.speed)),
            about=about or {},
        )


@contextmanager
def ssp_case(path: Path, overrides: Mapping[str, Any] | None = None) -> Iterator[Case]:
    """A case of an SSP on the FMUs inside it; removes at the end what it extracts.

    Parameters
    ----------
    path : Path
        The ``.ssp`` file.
    overrides : mapping, optional
        See `orchestrator.ssp.scenario.as_scenario`.

    Raises
    ------
    SspError, ScenarioError, FmuError
        When it cannot be run.
    """
    with FmuStore() as store:
        units = SspUnits(path, store)
        scenario = as_scenario(units.contents, overrides or {}, path)
        about = {"ssp_sha256": units.digest, "overrides": dict(overrides or {})}
        attributes = {"ssp": f"{path.name} sha256 {units.digest}"}
        yield Case(scenario, units.contents.train, units, attributes, about)
