"""Reads an SSP archive, also as another tool wrote it: version 1.0, and 2.0 as far as that says no more."""

from __future__ import annotations

import math
from pathlib import Path
from xml.etree.ElementTree import Element

from orchestrator.fmi.archive import ArchiveError, extract
from orchestrator.fmi.xml import XmlError, read_xml
from orchestrator.ssp.structure import SspError, Structure
from orchestrator.ssp.systems import Systems
from orchestrator.ssp.values import Bindings, unit_definitions
from orchestrator.ssp.writer import DEFINITION, NAMESPACES, OMS, OSP, RUN

_VERSIONS = ("1.0", "2.0")


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
        When the file is no SSP, or uses a part of the standard that the orchestrator does not know,
        such as connections that change a signal on its way.
    """
    try:
        extract(path, folder, "SSP")
        return _structure(path, folder, read_xml(folder / DEFINITION))
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


def _structure(path: Path, folder: Path, root: Element) -> Structure:
    system = root.find("ssd:System", NAMESPACES)
    if system is None:
        raise SspError(f"{path}: {DEFINITION} holds no System")
    version = root.get("version", "1.0")
    if version not in _VERSIONS:
        raise SspError(f"{path}: SSP version {version!r}; allowed are {' and '.join(_VERSIONS)}")
    units = unit_definitions(root, "ssd")
    try:
        systems = Systems(path, system, Bindings(path, folder, units), units)
        connections = tuple(systems.connections())
    except SspError as error:
        raise SspError(f"{error} (SSP version {version})" if version != "1.0" else str(error)) from None
    experiment = root.find("ssd:DefaultExperiment", NAMESPACES)
    step, run = _annotations(experiment, path)
    step = _master_step(system, path) if step is None else step
    times = {} if experiment is None else experiment.attrib
    start = _number(path, "startTime", times.get("startTime"), least=-math.inf)
    if start:
        raise SspError(
            f"{path}: startTime = {start!r}; allowed is 0, from which angles and the fracture count"
        )
    return Structure(
        name=root.get("name", path.stem),
        title=root.get("description", ""),
        components=tuple(systems.components),
        connections=connections,
        end=_number(path, "stopTime", times.get("stopTime")),
        step=step,
        coupling=run.get("coupling"),
        tolerance=_number(path, "tolerance", run.get("tolerance")),
        record_interval=_number(path, "recordInterval", run.get("recordInterval")),
        analysed_bearing=run.get("analysedBearing"),
        events=run.get("events"),
        units=units,
    )


def _annotations(experiment: Element | None, path: Path) -> tuple[float | None, dict[str, str]]:
    """Return the macro step and the orchestrator's settings."""
    step, run = None, {}
    if experiment is not None:
        for annotation in experiment.findall("ssd:Annotations/ssc:Annotation", NAMESPACES):
            fixed = annotation.find("osp:Algorithm/osp:FixedStepAlgorithm", NAMESPACES)
            if annotation.get("type") == OSP and fixed is not None:
                step = _number(path, "baseStepSize", fixed.get("baseStepSize"))
            own = annotation.find("bladeloss:Run", NAMESPACES)
            if annotation.get("type") == RUN and own is not None:
                run = dict(own.attrib)
    return step, run


def _master_step(system: Element, path: Path) -> float | None:
    """Return the macro step as OMSimulator keeps it."""
    annotations = system.findall("ssd:Annotations/ssc:Annotation", NAMESPACES)
    masters = (a.find(".//oms:FixedStepMaster", NAMESPACES) for a in annotations if a.get("type") == OMS)
    master = next((m for m in masters if m is not None), None)
    return None if master is None else _number(path, "stepSize", master.get("stepSize"))


def _number(path: Path, name: str, text: str | None, least: float = 0.0) -> float | None:
    """Return a number above `least`, 0 never being none: what is given counts or is refused."""
    if text is None:
        return None
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not (math.isfinite(number) and number > least):
        allowed = "a number" if least < 0.0 else "a number above 0"
        raise SspError(f"{path}: {name} = {text!r}; allowed is {allowed}")
    return number
