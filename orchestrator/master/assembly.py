"""Instantiate the units of a scenario and give them their parameters."""

from __future__ import annotations

from pathlib import Path

from orchestrator.errors import FmuError
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.unit import Unit, UnitError
from orchestrator.master.coupling import SCHEMES
from orchestrator.master.system import System
from orchestrator.scenario.parameters import bearing_parameters, bearing_path, rotor_file, rotor_parameters
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.train import Train


def assemble(scenario: Scenario, train: Train, fmus: Path, store: FmuStore, threads: int = 1) -> System:
    """Make the system of a scenario.

    Parameters
    ----------
    scenario : Scenario
        Depths, reduction, unbalance, event, coupling.
    train : Train
        Its train.
    fmus : Path
        Folder with the FMUs.
    store : FmuStore
        Extracts them.
    threads : int
        On which the bearings step.

    Returns
    -------
    System
        In Initialization Mode, parameters set.

    Raises
    ------
    FmuError
        When an FMU is missing, cannot be instantiated, or refuses its parameters.
    PortError
        When an FMU does not carry the port.
    """
    units: list[Unit] = []
    try:
        units.append(Unit(store.open(fmus / rotor_file(train)), "rotor"))
        for seat in train.bearings:
            file = store.open(bearing_path(scenario, seat.name, fmus))
            units.append(Unit(file, seat.name, release_gil=threads > 1))
        system = System(units[0], units[1:], SCHEMES[scenario.coupling].wiring)
        system.bearing_group.employ(threads)
        system.rotor.set_parameters(rotor_parameters(scenario, train))
        for unit, seat in zip(system.bearings, train.bearings, strict=True):
            unit.check_steps(scenario.step, scenario.end, scenario.tolerance is not None)
            values = bearing_parameters(seat, scenario.film)  # a user's own bearing may do without some
            unit.set_parameters({name: x for name, x in values.items() if name in unit.file.variables})
        system.set_speed(train.speed)
        for unit in units:
            unit.enter_initialization(0.0, scenario.end)
    except UnitError as error:
        _close(units)
        raise FmuError(f"{fmus}: {error}") from None
    except Exception:
        _close(units)
        raise
    return system


def _close(units: list[Unit]) -> None:
    for unit in units:
        unit.close()
