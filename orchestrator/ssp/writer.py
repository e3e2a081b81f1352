"""Writes a structure as SSD and SSV files, in the subset of SSP 1.0 that tools agree on.

That subset, found by trying OMSimulator, libcosim and ecos: parameter sets in files of their
own, bound to components, each named "initialValues", Real values only; prefixes as in the standard.
"""

from __future__ import annotations

from collections.abc import Iterable
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from fmus.port.variable import UNITS
from orchestrator.ssp.structure import Component, SspError, Structure

NAMESPACES = {
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
    "ssm": "http://ssp-standard.org/SSP1/SystemStructureParameterMapping",
    "osp": "http://opensimulationplatform.com/SSP/OSPAnnotations",
    "oms": "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd",
    "bladeloss": "urn:bladeloss:run",
}
OSP, OMS, RUN = "com.opensimulationplatform", "org.openmodelica", "bladeloss.run"
"""Types of the annotations: macro step as libcosim and OMSimulator read it, settings of the orchestrator."""

_LISTS = ("Connectors", "Connections", "Units", "Parameters", "Annotations")

DEFINITION = "SystemStructure.ssd"
PARAMETER_SET = "initialValues"  # libcosim takes this one without being asked


def parameter_file(component: str) -> str:
    """Path in the archive of a component's parameter set."""
    return f"resources/{component}.ssv"


def documents(structure: Structure) -> dict[str, bytes]:
    """Return the SSD and SSV files of a structure by their path in the archive.

    Raises
    ------
    SspError
        When a parameter is not Real.
    """
    files = {parameter_file(c.name): _parameter_set(c) for c in structure.components}
    return {DEFINITION: _definition(structure), **files}


def _definition(structure: Structure) -> bytes:
    root = Element(
        "ssd:SystemStructureDescription",
        {
            **_names("ssc", "ssd", "osp", "oms", "bladeloss"),
            "version": "1.0",
            "name": structure.name,
            "description": structure.title,
        },
    )
    system = SubElement(root, "ssd:System", name=structure.name)
    elements = SubElement(system, "ssd:Elements")
    for component in structure.components:
        elements.append(_component(component))
    connections = SubElement(system, "ssd:Connections")
    for c in structure.connections:
        SubElement(
            connections,
            "ssd:Connection",
            startElement=c.source,
            startConnector=c.output,
            endElement=c.target,
            endConnector=c.input,
        )
    if structure.step is not None:
        _master(system, structure.step)
    _units(root, "ssd:Units", (k.unit for c in structure.components for k in c.connectors))
    experiment = SubElement(root, "ssd:DefaultExperiment", startTime="0.0")
    if structure.end is not None:
        experiment.set("stopTime", repr(structure.end))
    annotations = SubElement(experiment, "ssd:Annotations")
    if structure.step is not None:
        osp = SubElement(annotations, "ssc:Annotation", type=OSP)
        algorithm = SubElement(osp, "osp:Algorithm")  # libcosim takes an attribute here for an algorithm
        SubElement(algorithm, "osp:FixedStepAlgorithm", baseStepSize=repr(structure.step))
    settings = {
        "coupling": structure.coupling,
        "tolerance": structure.tolerance,
        "recordInterval": structure.record_interval,
        "analysedBearing": structure.analysed_bearing,
        "events": structure.events,
    }
    own = SubElement(annotations, "ssc:Annotation", type=RUN)
    given = {key: str(value) for key, value in settings.items() if value is not None}
    SubElement(own, "bladeloss:Run", given)
    return _text(root)


def _master(system: Element, step: float) -> None:
    """Append the master of weak coupling that OMSimulator asks for: a system without one it cannot add."""
    annotation = SubElement(SubElement(system, "ssd:Annotations"), "ssc:Annotation", type=OMS)
    information = SubElement(SubElement(annotation, "oms:Annotations"), "oms:SimulationInformation")
    SubElement(
        information,
        "oms:FixedStepMaster",
        description="oms-ma",
        stepSize=repr(step),
        absoluteTolerance="0.0001",
        relativeTolerance="0.0001",
    )


def _component(component: Component) -> Element:
    element = Element(
        "ssd:Component",
        name=component.name,
        description=component.description,
        type="application/x-fmu-sharedlibrary",
        source=component.source,
        implementation="CoSimulation",
    )
    connectors = SubElement(element, "ssd:Connectors")
    for c in component.connectors:
        connector = SubElement(connectors, "ssd:Connector", name=c.name, kind=c.kind)
        SubElement(connector, "ssc:Real", {"unit": c.unit} if c.unit else {})
    bindings = SubElement(element, "ssd:ParameterBindings")
    SubElement(
        bindings, "ssd:ParameterBinding", type="application/x-ssp-parameter-set",
        source=parameter_file(component.name),
    )  # fmt: skip
    return element


def _parameter_set(component: Component) -> bytes:
    root = Element("ssv:ParameterSet", {**_names("ssc", "ssv"), "version": "1.0", "name": PARAMETER_SET})
    parameters = SubElement(root, "ssv:Parameters")
    for name, value in component.parameters.items():
        if not isinstance(value, float):
            raise SspError(f"{component.name}: {name} = {value!r} is not Real; tools agree on Real only")
        SubElement(SubElement(parameters, "ssv:Parameter", name=name), "ssv:Real", value=repr(value))
    return _text(root)


def _units(root: Element, tag: str, used: Iterable[str]) -> None:
    names = set(used)
    units = SubElement(root, tag)
    for name, unit in UNITS.items():
        if name in names:
            exponents = {base: str(power) for base, power in vars(unit).items() if power}
            SubElement(SubElement(units, "ssc:Unit", name=name), "ssc:BaseUnit", exponents)


def _names(*prefixes: str) -> dict[str, str]:
    return {f"xmlns:{prefix}": NAMESPACES[prefix] for prefix in prefixes}


def _without_empty(element: Element) -> None:
    """Take out lists without members, which the schema does not allow."""
    for child in list(element):
        _without_empty(child)
        if not len(child) and child.tag.partition(":")[2] in _LISTS:
            element.remove(child)


def _text(root: Element) -> bytes:
    _without_empty(root)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True) + b"\n"
