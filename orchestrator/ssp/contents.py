"""What an SSP holds, in the orchestrator's terms: train, rotor, bearings in order, scenario."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from fmus import port
from fmus.port.variable import UNITS, Value
from orchestrator.errors import FmuError
from orchestrator.fmi.archive import ArchiveError, inside
from orchestrator.fmi.file import FmuFile, FmuStore
from orchestrator.master.graph import Connection
from orchestrator.master.system import Wiring, port_connections
from orchestrator.ssp.structure import Component, SspError, Structure
from orchestrator.ssp.units import UnitDefinition, conversion, definition
from rotor_fmu.train.train import Train
from rotor_fmu.train.wording import likely

_LISTED = 12  # of the connections in a message


@dataclass(frozen=True)
class Contents:
    """An SSP in the orchestrator's terms.

    Attributes
    ----------
    structure : Structure
        As read.
    train : Train
        From the rotor FMU.
    rotor : Component
        The component with the rotor's port.
    bearings : tuple of Component
        In the order of the train.
    files : dict
        The FMU of each component, by its name.
    wiring : Wiring
        What the connections give the rotor.
    turning : bool
        Whether the rotor owns its speed.
    """

    structure: Structure
    train: Train
    rotor: Component
    bearings: tuple[Component, ...]
    files: Mapping[str, FmuFile]
    wiring: Wiring
    turning: bool = False


def understand(structure: Structure, path: Path, folder: Path, store: FmuStore) -> Contents:
    """Find rotor and bearings in a structure, and check that its connections are the port's.

    Parameters
    ----------
    structure : Structure
        From `orchestrator.ssp.reader.read_ssp`.
    path, folder : Path
        The archive, for messages, and where it is extracted.
    store : FmuStore
        Extracts the FMUs.

    Raises
    ------
    SspError
        Listing connections that are missing or not the port's.
    FmuError
        When an FMU is missing or cannot be read.
    """
    try:
        files = {c.name: store.open(inside(path, folder, c.source)) for c in structure.components}
    except (ArchiveError, FmuError) as error:
        text = str(error).removeprefix(f"{path}: ").replace(f"{folder.resolve()}/", "")
        raise SspError(f"{path}: {text}") from None
    components = tuple(_in_units(c, files[c.name], structure.units, path) for c in structure.components)
    structure = replace(structure, components=components)
    marker = port.at_bearing(1, port.JOURNAL[0])
    rotors = [c for c in structure.components if marker in files[c.name].variables]
    if len(rotors) != 1:
        names = ", ".join(c.name for c in rotors) or "none"
        raise SspError(f"{path}: rotors: {names}; allowed is one component with {marker}")
    (rotor,) = rotors
    train = _train(files[rotor.name], path)
    bearings = tuple(_in_order(structure, rotor, len(train.bearings), path))
    surplus = {c.name for c in structure.components} - {rotor.name, *(c.name for c in bearings)}
    if surplus:
        raise SspError(f"{path}: {', '.join(sorted(surplus))}: joined to no bearing of {rotor.name}")
    moving = train.has_moving_housings
    wiring, turning = _wiring(structure, rotor, bearings, moving, path)
    return Contents(structure, train, rotor, bearings, files, wiring, turning)


def _in_units(
    component: Component, file: FmuFile, defined: Mapping[str, UnitDefinition], path: Path
) -> Component:
    """Convert the values of a component to the units of its FMU, in which its connectors are, too."""
    known = {u.name: definition(u.name, u.baseUnit) for u in file.description.unitDefinitions}

    def unit_of(name: str) -> UnitDefinition:
        variable = file.variables.get(name)
        unit = (variable.unit or "") if variable else ""
        return known.get(unit) or definition(unit, vars(UNITS[unit]) if unit in UNITS else None)

    values: dict[str, Value] = {}
    for name, given in component.given.items():
        try:
            values[name] = given.in_unit(unit_of(name))
        except ValueError as error:
            raise SspError(f"{path}: {component.name}: {name} = {given.value!r}: {error}") from None
        if name != "fracture.time" and values[name] in (math.inf, -math.inf):
            raise SspError(f"{path}: {component.name}: {name} = {given.value!r}; allowed is a finite number")
    for connector in component.connectors:
        own = unit_of(connector.name)
        unit = defined.get(connector.unit) or definition(connector.unit, None)
        if not connector.unit or unit.name == own.name:
            continue
        try:
            same = conversion(unit, own) == (1.0, 0.0)
        except ValueError:
            same = False
        if not same:
            raise SspError(
                f"{path}: {component.name}: connector {connector.name} in {unit.name!r}; allowed is the unit "
                f"of its FMU, {own.name or '1'!r}"
            )
    return replace(component, parameters=values)


def _train(file: FmuFile, path: Path) -> Train:
    source = file.folder / "resources" / "train.json"
    if not source.is_file():
        raise SspError(f"{path}: {file.path.name}: without train.json, so no rotor of bladeloss")
    try:
        return Train.from_json(source.read_text(encoding="utf-8"))
    except Exception as error:  # whatever a file of somebody else can lack
        raise SspError(f"{path}: {file.path.name}: train.json is no train: {error!r}") from None


def _in_order(structure: Structure, rotor: Component, count: int, path: Path) -> Iterator[Component]:
    """Yield the component at each bearing of the rotor, known by the journal that it gets."""
    by_name = {c.name: c for c in structure.components}
    target = {c.output: c.target for c in structure.connections if c.source == rotor.name}
    seen: set[str] = set()
    for index in range(1, count + 1):
        name = target.get(port.at_bearing(index, port.JOURNAL[0]))
        if name not in by_name or name in seen:
            raise SspError(f"{path}: {rotor.name}: no component of its own is connected to bearing {index}")
        seen.add(name)
        yield by_name[name]


def _wiring(
    structure: Structure, rotor: Component, bearings: Iterable[Component], moving: bool, path: Path
) -> tuple[Wiring, bool]:
    """Return what the connections carry, and whether the rotor owns its speed."""
    found = set(structure.connections)
    names = [c.name for c in bearings]
    wanted = {
        (wiring, turning): set(port_connections(rotor.name, names, wiring, moving=moving, turning=turning))
        for turning in (False, True)
        for wiring in Wiring
    }
    for kind, connections in wanted.items():
        if found == connections:
            return kind
    nearest = min(wanted, key=lambda kind: len(found ^ wanted[kind]))
    problems = [f"  missing: {_text(c)}" for c in _sorted(wanted[nearest] - found)]
    problems += [f"  not of the port: {_text(c)}" for c in _sorted(found - wanted[nearest])]
    more = f"\n  and {len(problems) - _LISTED} more" if len(problems) > _LISTED else ""
    listed = "\n".join(problems[:_LISTED]) + more
    raise SspError(f"{path}: allowed are the connections of the affine law or of the force alone\n{listed}")


def _sorted(connections: Iterable[Connection]) -> list[Connection]:
    return sorted(connections, key=_text)


def _text(c: Connection) -> str:
    return f"{c.source}.{c.output} -> {c.target}.{c.input}"


def parameters(component: Component, file: FmuFile, path: Path) -> dict[str, Value]:
    """Return the values that the SSP gives a component.

    Raises
    ------
    SspError
        When the FMU has no such variable, or none that may be set.
    """
    for name in component.parameters:
        variable = file.variables.get(name)
        if variable is None or variable.causality not in ("input", "parameter"):
            what = "no variable" if variable is None else f"a {variable.causality}, and not to be set,"
            hint = "" if variable else f"; {likely(name, file.variables)}".rstrip("; ")
            raise SspError(f"{path}: {component.name}: {name} is {what} of {file.path.name}{hint}")
    return dict(component.parameters)


def value_of(contents: Contents, component: Component, name: str) -> Any:
    """Return a start value: of the SSP, else of the FMU."""
    variable = contents.files[component.name].variables[name]
    return component.parameters.get(name, variable.start)
