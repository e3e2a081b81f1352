"""Parameter values of an SSP: sets, in files or inline, their units, mappings and transformations."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from urllib.parse import unquote
from xml.etree.ElementTree import Element

from fmus.port.variable import Value
from orchestrator.fmi.archive import inside
from orchestrator.fmi.xml import read_xml
from orchestrator.ssp.structure import SspError
from orchestrator.ssp.units import Given, UnitDefinition, definition
from orchestrator.ssp.writer import NAMESPACES

_WHOLE = ("Integer", *(f"{sign}Int{bits}" for sign in ("", "U") for bits in (8, 16, 32, 64)))
_CONVERSIONS: dict[str, Callable[[str], Value]] = {
    **dict.fromkeys(("Real", "Float64", "Float32"), float),
    **dict.fromkeys(_WHOLE, int),
    "String": str,
    "Boolean": {"true": True, "1": True, "false": False, "0": False}.__getitem__,
}
"""Types of SSP 1.0, and those of 2.0 that mean the same in FMI 2.0."""

_SET, _MAPPING = "application/x-ssp-parameter-set", "application/x-ssp-parameter-mapping"


def unit_definitions(root: Element, prefix: str) -> dict[str, UnitDefinition]:
    """Units that a file defines; `prefix` is that of the list, ``ssd`` or ``ssv``."""
    return {
        (name := unit.get("name", "")): definition(name, unit.find("ssc:BaseUnit", NAMESPACES))
        for unit in root.iterfind(f"{prefix}:Units/ssc:Unit", NAMESPACES)
    }


def transformation(element: Element, where: str) -> tuple[float, float]:
    """Return factor and offset of a connection or a mapping entry.

    Raises
    ------
    SspError
        For a mapping of Booleans, integers or enumerations.
    """
    for kind in (
        "BooleanMappingTransformation",
        "IntegerMappingTransformation",
        "EnumerationMappingTransformation",
    ):
        if element.find(f"ssc:{kind}", NAMESPACES) is not None:
            raise SspError(f"{where}: {kind}; allowed is LinearTransformation")
    linear = element.find("ssc:LinearTransformation", NAMESPACES)
    if linear is None:
        return 1.0, 0.0
    numbers = []
    for key, usual in (("factor", "1"), ("offset", "0")):
        text = linear.get(key, usual)
        numbers.append(_converted("Real", text, f"{where}: LinearTransformation: {key}"))
    return float(numbers[0]), float(numbers[1])


def suppressed(element: Element) -> bool:
    """Whether a connection or a mapping entry goes without conversion of units."""
    return element.get("suppressUnitConversion") in ("true", "1")


class Bindings:
    """Reads what parameter bindings say.

    Parameters
    ----------
    path, folder : Path
        The archive, for messages, and where it is extracted.
    units : mapping
        Units that the system definition defines.
    """

    def __init__(self, path: Path, folder: Path, units: Mapping[str, UnitDefinition]) -> None:
        self.path, self.folder, self.units = path, folder, units

    def of(self, element: Element) -> dict[str, Given]:
        """Values of all parameter sets bound to an element; later bindings win, as the standard says."""
        values: dict[str, Given] = {}
        for binding in element.findall("ssd:ParameterBindings/ssd:ParameterBinding", NAMESPACES):
            where = f"{self.path}: {element.get('name')}: parameter binding"
            inline = "ssd:ParameterValues/ssv:ParameterSet"
            root = self._source(binding, binding.find(inline, NAMESPACES), _SET, where)
            prefix = binding.get("prefix", "")
            given = {prefix + name: value for name, value in self._values(root)}
            values |= self._mapped(binding, given, where)
        return values

    def _source(self, element: Element, inline: Element | None, kind: str, where: str) -> Element:
        if element.get("type", kind) != kind:
            raise SspError(f"{where}: type {element.get('type')!r}; allowed is {kind}")
        if element.get("sourceBase", "SSD") != "SSD":
            raise SspError(f"{where}: sourceBase {element.get('sourceBase')!r}; allowed is SSD")
        source = element.get("source")
        root = inline if source is None else read_xml(inside(self.path, self.folder, unquote(source)))
        if root is None:
            raise SspError(f"{where} without values")
        return root

    def _mapped(self, binding: Element, given: dict[str, Given], where: str) -> dict[str, Given]:
        """Rename and transform by the binding's mapping; what it does not name keeps its name."""
        element = binding.find("ssd:ParameterMapping", NAMESPACES)
        if element is None:
            return given
        root = self._source(
            element, element.find("ssm:ParameterMapping", NAMESPACES), _MAPPING, f"{where}: mapping"
        )
        entries = root.findall("ssm:MappingEntry", NAMESPACES)
        named = {entry.get("source", "") for entry in entries}
        mapped = {name: value for name, value in given.items() if name not in named}
        for entry in entries:
            source, target = entry.get("source", ""), entry.get("target", "")
            if source in given:
                factor, offset = transformation(entry, f"{where}: {source} -> {target}")
                mapped[target] = given[source].through(factor, offset, not suppressed(entry))
        return mapped

    def _values(self, root: Element) -> Iterator[tuple[str, Given]]:
        units, seen = {**self.units, **unit_definitions(root, "ssv")}, set()
        for parameter in root.findall("ssv:Parameters/ssv:Parameter", NAMESPACES):
            name = parameter.get("name", "")
            if name in seen:
                raise SspError(f"{self.path}: parameter {name} stands twice in one parameter set")
            seen.add(name)
            found = [
                (kind, x)
                for kind in _CONVERSIONS
                if (x := parameter.find(f"ssv:{kind}", NAMESPACES)) is not None
            ]
            if len(found) != 1:
                raise SspError(f"{self.path}: parameter {name}: type not supported")
            kind, element = found[0]
            value = _converted(kind, element.get("value", ""), f"{self.path}: parameter {name}")
            unit = element.get("unit")
            yield name, Given(value, units.get(unit, UnitDefinition(unit)) if unit else None)


def _converted(kind: str, text: str, where: str) -> Value:
    try:
        value = _CONVERSIONS[kind](text)
    except (ValueError, KeyError):
        value = math.nan
    if value != value:
        raise SspError(f"{where}: {text!r} is no {kind} value")
    return value
