"""Reads an SSP 1.0 archive, also as another tool wrote it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.parse import unquote
from xml.etree.ElementTree import Element

from fmus.port.variable import Value
from orchestrator.fmi.archive import ArchiveError, extract, inside
from orchestrator.fmi.xml import XmlError, read_xml
from orchestrator.master.graph import Connection
from orchestrator.ssp.structure import Component, Connector, SspError, Structure
from orchestrator.ssp.writer import DEFINITION, NAMESPACES, OSP, RUN

_CONVERSIONS: dict[str, Callable[[str], Value]] = {
    "Real": float,
    "Integer": int,
    "String": str,
    "Boolean": lambda text: text in ("true", "1"),
}


def read_ssp(path: Path, folder: Path) -> Structure:
    """Read an SSP and extract its resources.

    Parameters
    ----------
    path : Path
        The ``.ssp`` file.
    folder : Path
        Where the archive is extracted to; sources of components count from there.

    Returns
    -------
    Structure

    Raises
    ------
    SspError
        When the file is no SSP, or uses a part of the standard that the orchestrator does not know:
        nested systems, transformations, parameter mappings.
    """
    try:
        extract(path, folder, "SSP")
        return _Reader(path, folder).structure(read_xml(folder / DEFINITION))
    except FileNotFoundError as error:
        missing = Path(str(error.filename))
        within = missing.relative_to(folder) if missing.is_relative_to(folder) else None
        raise SspError(f"{path}: no such file" + (f" in the archive: {within}" if within else "")) from None
    except ArchiveError as error:
        raise SspError(str(error)) from None
    except XmlError as error:
        raise SspError(f"{path}: {error}") from None
    except (OSError, ValueError) as error:
        raise SspError(f"{path}: not a readable SSP: {error}") from None


class _Reader:
    def __init__(self, path: Path, folder: Path) -> None:
        self.path, self.folder = path, folder

    def structure(self, root: Element) -> Structure:
        system = root.find("ssd:System", NAMESPACES)
        if system is None:
            raise SspError(f"{self.path}: {DEFINITION} holds no System")
        if system.find("ssd:Elements/ssd:System", NAMESPACES) is not None:
            raise SspError(f"{self.path}: nested systems; allowed are components at the top only")
        for kind in ("ssc:LinearTransformation", "ssc:BooleanMappingTransformation", "ssd:ParameterMapping"):
            if system.find(f".//{kind}", NAMESPACES) is not None:
                raise SspError(f"{self.path}: {kind.partition(':')[2]}; values must travel as they are")
        elements = system.findall("ssd:Elements/ssd:Component", NAMESPACES)
        common = self._bound(system)
        components = tuple(self._component(element, common) for element in elements)
        experiment = root.find("ssd:DefaultExperiment", NAMESPACES)
        step, run = _annotations(experiment)
        interval = run.get("recordInterval")
        return Structure(
            name=root.get("name", self.path.stem),
            title=root.get("description", ""),
            components=components,
            connections=tuple(self._connections(system, components)),
            end=None if experiment is None else _number(experiment.get("stopTime")),
            step=step,
            coupling=run.get("coupling"),
            tolerance=_number(run.get("tolerance")),
            record_interval=_number(interval),
            analysed_bearing=run.get("analysedBearing"),
        )

    def _component(self, element: Element, common: dict[str, Value]) -> Component:
        name = element.get("name", "")
        prefix = f"{name}."
        of_system = {key.removeprefix(prefix): x for key, x in common.items() if key.startswith(prefix)}
        return Component(
            name=name,
            source=unquote(element.get("source", "")),
            description=element.get("description", ""),
            connectors=tuple(
                Connector(c.get("name", ""), c.get("kind", ""), _unit(c))
                for c in element.findall("ssd:Connectors/ssd:Connector", NAMESPACES)
            ),
            # what the system around prescribes wins
            parameters=self._bound(element) | of_system,
        )

    def _bound(self, element: Element) -> dict[str, Value]:
        """Values of all parameter sets bound to an element, in files or inline."""
        values: dict[str, Value] = {}
        for binding in element.findall("ssd:ParameterBindings/ssd:ParameterBinding", NAMESPACES):
            source, prefix = binding.get("source"), binding.get("prefix", "")
            root = (
                binding.find("ssd:ParameterValues/ssv:ParameterSet", NAMESPACES)
                if source is None
                else read_xml(inside(self.path, self.folder, unquote(source)))
            )
            if root is None:
                raise SspError(f"{self.path}: {element.get('name')}: a parameter binding without values")
            for name, value in self._values(root):
                values[prefix + name] = value
        return values

    def _values(self, root: Element) -> Iterator[tuple[str, Value]]:
        for parameter in root.findall("ssv:Parameters/ssv:Parameter", NAMESPACES):
            for kind in _CONVERSIONS:
                found = parameter.find(f"ssv:{kind}", NAMESPACES)
                if found is not None:
                    yield parameter.get("name", ""), self._value(parameter, kind, found.get("value", ""))
                    break
            else:
                raise SspError(f"{self.path}: parameter {parameter.get('name')}: type not supported")

    def _value(self, parameter: Element, kind: str, text: str) -> Value:
        try:
            value = _CONVERSIONS[kind](text)
        except ValueError:
            value = math.nan
        if value != value:
            raise SspError(f"{self.path}: parameter {parameter.get('name')}: {text!r} is no {kind} value")
        return value

    def _connections(self, system: Element, components: tuple[Component, ...]) -> Iterator[Connection]:
        inputs = {(c.name, k.name) for c in components for k in c.connectors if k.kind == "input"}
        for element in system.findall("ssd:Connections/ssd:Connection", NAMESPACES):
            start = element.get("startElement", ""), element.get("startConnector", "")
            end = element.get("endElement", ""), element.get("endConnector", "")
            if start in inputs and end not in inputs:  # the standard gives the order no meaning
                start, end = end, start
            yield Connection(*start, *end)


def _annotations(experiment: Element | None) -> tuple[float | None, dict[str, str]]:
    """Return the macro step and the orchestrator's settings."""
    step, run = None, {}
    if experiment is not None:
        for annotation in experiment.findall("ssd:Annotations/ssc:Annotation", NAMESPACES):
            fixed = annotation.find("osp:Algorithm/osp:FixedStepAlgorithm", NAMESPACES)
            if annotation.get("type") == OSP and fixed is not None:
                step = _number(fixed.get("baseStepSize"))
            own = annotation.find("bladeloss:Run", NAMESPACES)
            if annotation.get("type") == RUN and own is not None:
                run = dict(own.attrib)
    return step, run


def _number(text: str | None) -> float | None:
    return None if text is None else float(text)


def _unit(connector: Element) -> str:
    kind = connector.find("ssc:Real", NAMESPACES)
    return "" if kind is None else kind.get("unit", "")
