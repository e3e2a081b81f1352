"""Units as a system: instantiated, with their parameters, in Initialization Mode."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bearing_fmu.depths import LINEAR
from bearing_fmu.recipe import bearing_recipe
from fmus import port
from fmus.build.builder import place
from fmus.build.recipe import Recipe
from orchestrator.errors import EquilibriumError, FmuError
from orchestrator.fmi.file import FmuFile, FmuStore
from orchestrator.fmi.unit import Unit, UnitError
from orchestrator.master.coupling import SCHEMES
from orchestrator.master.start.equilibrium import find_start
from orchestrator.master.start.heat import effective_viscosities
from orchestrator.master.system import System
from orchestrator.scenario.events import Change
from orchestrator.scenario.parameters import (
    Values,
    bearing_parameters,
    linearised,
    rotor_parameters,
)
from orchestrator.scenario.scenario import Scenario, is_fmu
from rotor_fmu.linear.analysis import target_loads
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.train.train import Train


@dataclass(frozen=True)
class Part:
    """A unit to be made: its name, its FMU, and its parameters by name."""

    name: str
    file: FmuFile
    parameters: Values


def parts_in_folder(
    scenario: Scenario,
    train: Train,
    fmus: Path,
    store: FmuStore,
    rotor: Train | None = None,
    found: dict[str, Values] | None = None,
) -> Iterator[Part]:
    """Yield rotor and bearings of a scenario; a user's own bearing may do without some parameters.

    Where depth linear has no stiffness and damping from the train, it has those of the film of
    `Scenario.linear_from` at the static equilibrium on these films, which is found here; and so is the
    viscosity of oils whose temperature is not given. `rotor` is a train with the same shaft, whose rotor
    serves; `found` is what `found_parameters` has returned for an equal start.

    Raises
    ------
    FmuError
        When an FMU in the folder is not that of this train, these films and this program.
    EquilibriumError
        When films that are to be linearised find none.
    """
    own = found_parameters(scenario, train, fmus, store) if found is None else found
    yield from _parts(scenario, train, fmus, store, own, rotor)


def found_parameters(scenario: Scenario, train: Train, fmus: Path, store: FmuStore) -> dict[str, Values]:
    """Parameters by bearing that follow from an equilibrium: of depth linear, viscosities of warm oils.

    Raises
    ------
    FmuError, EquilibriumError
        As `parts_in_folder`.
    """
    linear = _linear_parameters(scenario, train, fmus, store)
    warm = _warm_parameters(scenario, train, fmus, store, linear)
    return {name: linear.get(name, {}) | warm.get(name, {}) for name in {**linear, **warm}}


def _warm_parameters(
    scenario: Scenario, train: Train, fmus: Path, store: FmuStore, linear: dict[str, Values]
) -> dict[str, Values]:
    """Viscosities by name of the bearings whose oil finds its temperature at the static equilibrium."""
    if not any(
        seat.oil is not None and scenario.depth_of(seat.name) != LINEAR.name for seat in train.bearings
    ):
        return {}
    held = scenario.film.model_copy(update={"temperature": "held"})
    # statics go through the unreduced shaft, and oils are where they are told to be
    quick = scenario.model_copy(update={"reduction": "guyan", "film": held})
    system = join(_parts(quick, train, fmus, store, linear), quick, train.speed, fmus)
    try:
        found = effective_viscosities(system, train, train.speed)
    except UnitError as error:
        raise EquilibriumError(str(error)) from None
    finally:
        system.close()
    return {name: {"viscosity": viscosity} for name, viscosity in found.items()}


def _parts(
    scenario: Scenario,
    train: Train,
    fmus: Path,
    store: FmuStore,
    found: dict[str, Values],
    rotor: Train | None = None,
) -> Iterator[Part]:
    """Yield the units; viscosities of oils are first guesses where they are not among those found."""
    rotor_file = _built(rotor_recipe(rotor or train), fmus, store)
    yield Part("rotor", rotor_file, rotor_parameters(scenario, train))
    depths = {scenario.depth_of(seat.name) for seat in train.bearings}
    files = {
        depth: store.open(scenario.folder / depth)
        if is_fmu(depth)
        else _built(bearing_recipe(depth), fmus, store)
        for depth in sorted(depths)
    }
    for seat in train.bearings:
        file = files[scenario.depth_of(seat.name)]
        values = bearing_parameters(seat, scenario.film) | found.get(seat.name, {})
        yield Part(seat.name, file, {name: x for name, x in values.items() if name in file.variables})


def _built(recipe: Recipe, fmus: Path, store: FmuStore) -> FmuFile:
    """Open the FMU of a recipe, and make sure that what was loaded is what is meant."""
    file = store.open(place(fmus, recipe))
    if file.description.guid != f"{{{recipe.guid}}}":
        raise FmuError(f"{file.path}: is another unit than {recipe.name} as it is now; build it anew")
    return file


def assemble(scenario: Scenario, train: Train, fmus: Path, store: FmuStore, threads: int = 1) -> System:
    """Make the system of a scenario from a folder of FMUs; otherwise as `join`."""
    speed = scenario.start_speed(train.speed)
    return join(parts_in_folder(scenario, train, fmus, store), scenario, speed, fmus, threads)


def _linear_parameters(scenario: Scenario, train: Train, fmus: Path, store: FmuStore) -> dict[str, Values]:
    """What bearings of depth linear have by name: static wrench, where it acts, stiffness, damping."""
    linear = [seat for seat in train.bearings if scenario.depth_of(seat.name) == LINEAR.name]
    found: dict[str, Values] = {}
    if any(seat.coefficients for seat in linear):
        loads = dict(zip((seat.name for seat in train.bearings), target_loads(train), strict=True))
        for seat in linear:
            values = port.coefficient_values(seat.coefficients) if seat.coefficients else {}
            # At a height that is given the springs carry what they carry there.
            load = float(loads[seat.name]) if seat.height is None else 0.0
            along = zip(port.STATIC_WRENCH, train.upwards, strict=False)
            found[seat.name] = {**{name: load * share for name, share in along}, **values}
    if not linearised(scenario, train):
        return found
    films = {seat.name: scenario.linear_from for seat in linearised(scenario, train)}
    depth = scenario.linear_from if scenario.depth == LINEAR.name else scenario.depth
    given = {seat.name: LINEAR.name for seat in linear if seat.coefficients}
    changes = {"depth": depth, "depth_at": {**scenario.depth_at, **given, **films}}
    system = assemble(scenario.model_copy(update=changes), train, fmus, store)
    try:
        start = find_start(system, train, scenario.start_speed(train.speed))
        names = (*port.STATIC_WRENCH, *port.STATIC_POSITION, *port.STIFFNESS, *port.DAMPING)
        stiffness, damping = np.split(system.tangents, 2, axis=2)
        positions = system.bearing_inputs[:, :4] - start.offsets
        for i, seat in enumerate(train.bearings):
            if seat.name in films:
                parts = system.forces[i], positions[i], stiffness[i].ravel(), damping[i].ravel()
                found[seat.name] = dict(zip(names, np.concatenate(parts).tolist(), strict=True))
    except UnitError as error:
        raise EquilibriumError(str(error)) from None
    finally:
        system.close()
    return found


def join(parts: Iterable[Part], scenario: Scenario, speed: float, place: Path, threads: int = 1) -> System:
    """Make a system of units.

    Parameters
    ----------
    parts : iterable of Part
        The rotor, then the bearings in its order.
    scenario : Scenario
        Its coupling says what the bearings give the rotor, and how long it runs.
    speed : float
        In rad/s.
    place : Path
        Where the units come from, for messages.
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
        parameters = []
        for part in parts:
            units.append(Unit(part.file, part.name, release_gil=bool(units) and threads > 1))
            parameters.append(part.parameters)
        scheme = SCHEMES[scenario.coupling]
        own = scheme.parts if port.PARTS in units[0].file.variables else 1
        system = System(units[0], units[1:], scheme.wiring, turning=scenario.turns, parts=own)
        system.bearing_group.employ(threads)
        halved = scenario.tolerance is not None or scheme.many_rates
        for event in scenario.events:
            if isinstance(event, Change):
                _check_change(event, next(unit for unit in units if unit.name == event.bearing))
        for unit, values in zip(units, parameters, strict=True):
            unit.file.check_steps(scenario.step, scenario.end, halved)
            unit.set_parameters(values)
        if own > 1:
            units[0].set_parameters({port.PARTS: own})
        system.set_speed(speed)
        for unit in units:
            unit.enter_initialization(0.0, scenario.end)
    except Exception as error:
        for unit in units:
            unit.close()
        if isinstance(error, UnitError):
            raise FmuError(f"{place}: {error}") from None
        raise
    return system


def _check_change(event: Change, unit: Unit) -> None:
    """Raise FmuError where a unit does not take a parameter while it runs."""
    variable = unit.file.variables.get(event.variable)
    if variable is None or variable.variability != "tunable":
        what = "has none" if variable is None else f"is {variable.variability}, allowed is tunable"
        raise FmuError(
            f"{unit.file.path}: {event.variable}, that an event changes at {event.bearing}: {what}"
        )
