"""Systems within systems, as components and connections of one: connectors of systems only pass on."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote
from xml.etree.ElementTree import Element

from orchestrator.master.graph import Connection
from orchestrator.ssp.structure import Component, Connector, SspError
from orchestrator.ssp.units import Given, UnitDefinition, conversion, definition
from orchestrator.ssp.values import Bindings, suppressed, transformation
from orchestrator.ssp.writer import NAMESPACES

_FMU = "application/x-fmu-sharedlibrary"
_GIVEN = ("input", "parameter", "inout")  # connectors of a system that take values from outside

_ROUNDING = 1e-12  # of factors there and back
_REAL = ("Real", "Float64", "Float32")  # of SSP 1.0, and of 2.0

Point = tuple[str, str]
"""Hierarchical name of an element, empty for the system at the top, and name of its connector."""


class _Way(NamedTuple):
    """A connection in one of its directions."""

    target: Point
    factor: float
    offset: float
    converts: bool
    """Whether units are converted on it."""


class Systems:
    """Components and connections of a system, those of systems inside it among them.

    Parameters
    ----------
    path : Path
        The archive, for messages.
    bindings : Bindings
        Reads parameter values.
    units : mapping
        Units that the system definition defines.

    Attributes
    ----------
    components : list of Component
        Names of those in inner systems begin with the names of these, with dots.

    Raises
    ------
    SspError
        For elements that are no FMU for co-simulation, and connections that change values on their way.
    """

    def __init__(
        self, path: Path, system: Element, bindings: Bindings, units: Mapping[str, UnitDefinition]
    ) -> None:
        self._path, self._bindings, self._units = path, bindings, units
        self.components: list[Component] = []
        self._connectors: dict[Point, Connector] = {}
        self._ways: defaultdict[Point, list[_Way]] = defaultdict(list)
        self._starts: dict[Point, bool] = {}  # whether a connection in the file begins there
        self._gather(system, "", {})

    def _gather(self, system: Element, within: str, from_above: dict[str, Given]) -> None:
        # what the system around prescribes wins
        values = self._bindings.of(system) | from_above
        own = self._read_connectors(system, within)
        connections = system.findall("ssd:Connections/ssd:Connection", NAMESPACES)
        for element in connections:
            self._connect(element, within, own, values)
        used = set(own)
        for element in system.iterfind("ssd:Elements/*", NAMESPACES):
            name, kind = element.get("name", ""), element.tag.rpartition("}")[2]
            prefix, full = f"{name}.", f"{within}.{name}".lstrip(".")
            inside = {key.removeprefix(prefix): x for key, x in values.items() if key.startswith(prefix)}
            used |= {key for key in values if key.startswith(prefix)}
            if kind == "System":
                self._gather(element, full, inside)
            elif kind == "Component":
                self._add(element, full, inside)
            else:
                raise SspError(f"{self._path}: {full}: {kind}; allowed are components and systems")
        if unknown := sorted(values.keys() - used):
            raise SspError(
                f"{self._path}: {within or system.get('name')}: parameter {unknown[0]} belongs to nothing"
            )

    def _add(self, element: Element, name: str, values: dict[str, Given]) -> None:
        if element.get("type", _FMU) != _FMU:
            raise SspError(
                f"{self._path}: {name}: component of type {element.get('type')!r}; allowed is {_FMU}"
            )
        if element.get("implementation", "any") not in ("any", "CoSimulation"):
            raise SspError(
                f"{self._path}: {name}: implementation "
                f"{element.get('implementation')!r}; allowed is CoSimulation"
            )
        if name in (c.name for c in self.components):
            raise SspError(f"{self._path}: {name} is the name of two components; allowed is a name for each")
        connectors = tuple(self._read_connectors(element, name).values())
        source, given = unquote(element.get("source", "")), self._bindings.of(element) | values
        description = element.get("description", "")
        self.components.append(Component(name, source, description, connectors, given=given))

    def _read_connectors(self, element: Element, name: str) -> dict[str, Connector]:
        found = {}
        for c in element.findall("ssd:Connectors/ssd:Connector", NAMESPACES):
            if any(child.tag.endswith("}Dimension") for child in c):
                raise SspError(
                    f"{self._path}: {name}: connector {c.get('name')} is an array; allowed are numbers"
                )
            reals = (c.find(f"ssc:{kind}", NAMESPACES) for kind in _REAL)
            unit = next((real.get("unit", "") for real in reals if real is not None), "")
            connector = Connector(c.get("name", ""), c.get("kind", ""), unit)
            found[connector.name] = self._connectors[name, connector.name] = connector
        return found

    def _connect(
        self, element: Element, within: str, own: Mapping[str, Connector], values: dict[str, Given]
    ) -> None:
        """Note a connection; a value given to the system's own connector moves on to where it leads."""
        ends: list[Point] = []
        inner: list[str] = []
        for side in ("start", "end"):
            name, connector = element.get(f"{side}Element", ""), element.get(f"{side}Connector", "")
            inner.append(f"{name}.{connector}".lstrip("."))
            ends.append((f"{within}.{name}".strip("."), connector))
        start, end = ends
        where = f"{self._path}: {'.'.join(start)} -> {'.'.join(end)}"
        factor, offset = transformation(element, where)
        for given, led_to in (inner, inner[::-1]):
            if given in values and given in own and own[given].kind in _GIVEN:
                unit = own[given].unit
                value = values[given]
                if unit and value.unit is None:
                    value = Given(value.value, self._unit(unit), value.factor, value.offset)
                values.setdefault(led_to, value.through(factor, offset, not suppressed(element)))
        for source, target in ((start, end), (end, start)):
            self._ways[source].append(_Way(target, factor, offset, not suppressed(element)))
        self._starts[start] = True
        self._starts.setdefault(end, False)

    def _conversion(self, source: Point, target: Point) -> tuple[float, float]:
        units = [self._connectors[point].unit for point in (source, target) if point in self._connectors]
        if len(units) < 2 or not all(units):
            return 1.0, 0.0
        try:
            return conversion(self._unit(units[0]), self._unit(units[1]))
        except ValueError as error:
            raise SspError(f"{self._path}: {'.'.join(source)} -> {'.'.join(target)}: {error}") from None

    def _unit(self, name: str) -> UnitDefinition:
        return self._units.get(name, definition(name, None))

    def connections(self) -> Iterator[Connection]:
        """Yield them from output to input; the order of their ends in the file carries no meaning."""
        names = {c.name for c in self.components}
        for start, begins in self._starts.items():
            kind = self._connectors[start].kind if start in self._connectors else ""
            if start[0] not in names or kind in ("input", "parameter") or not (kind or begins):
                continue
            for end in self._reached(start, names):
                yield Connection(*start, *end)

    def _reached(self, start: Point, names: set[str]) -> Iterator[Point]:
        waiting, seen = [(start, 1.0, 0.0)], {start}
        while waiting:
            point, factor, offset = waiting.pop(0)
            if point[0] in names and point != start:
                if not (math.isclose(factor, 1.0, rel_tol=_ROUNDING) and abs(offset) < _ROUNDING):
                    raise SspError(
                        f"{self._path}: {'.'.join(start)} -> {'.'.join(point)}: by transformation or units x "
                        f"comes as {factor:g} x + {offset:g}; signals must travel as they are"
                    )
                yield point
                continue
            for way in self._ways[point]:
                if way.target not in seen:
                    seen.add(way.target)
                    by, plus = self._conversion(point, way.target) if way.converts else (1.0, 0.0)
                    by, plus = way.factor * by, way.factor * plus + way.offset
                    waiting.append((way.target, by * factor, by * offset + plus))
