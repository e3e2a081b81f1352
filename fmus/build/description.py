"""The modelDescription.xml of a unit, written from its port (FMI 2.0, section 2.2)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from pythonfmu import Fmi2Slave

from fmus.build.promises import annotate
from fmus.port.variable import UNITS, Value, Variable

STEP_SIZE = 1e-4
STOP_TIME = 1.0


@dataclass(frozen=True)
class Identity:
    """What names an FMU.

    Attributes
    ----------
    name : str
        Model name and identifier.
    description : str
        One line.
    guid : str
        GUID, a function of the content.
    version : str
        Version of the distribution.
    date : str or None
        Generation date, ISO 8601; left out if None, so that a build repeats to the byte.
    """

    name: str
    description: str
    guid: str
    version: str
    date: str | None = None


def model_description(
    identity: Identity, variables: Sequence[Variable], *, promises: Sequence[str] = ()
) -> bytes:
    """Return the modelDescription.xml of a unit.

    Parameters
    ----------
    identity : Identity
        Name, GUID, version.
    variables : sequence of Variable
        The port, in the order of the value references.
    promises : sequence of str
        See `fmus.build.promises`.

    Returns
    -------
    bytes
        XML in UTF-8.
    """
    root = Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=identity.name,
        guid=f"{{{identity.guid}}}",
        description=identity.description,
        author="The bladeloss authors",
        version=identity.version,
        license="MIT",
        generationTool=f"bladeloss {identity.version}",
        variableNamingConvention="structured",
        numberOfEventIndicators="0",
    )
    if identity.date is not None:
        root.set("generationDateAndTime", identity.date)
    SubElement(
        root,
        "CoSimulation",
        modelIdentifier=identity.name,
        needsExecutionTool="false",  # the model is inside; tools that insist refuse true, see the README
        canHandleVariableCommunicationStepSize="true",
        canNotUseMemoryManagementFunctions="true",
        canGetAndSetFMUstate="true",
        canSerializeFMUstate="true",
    )
    _units(root, variables)
    categories = SubElement(root, "LogCategories")
    for name, text in Fmi2Slave.log_categories.items():
        SubElement(categories, "Category", name=name, description=text)
    SubElement(root, "DefaultExperiment", startTime="0.0", stopTime=repr(STOP_TIME), stepSize=repr(STEP_SIZE))
    if promises:
        annotate(root, promises)
    listed = SubElement(root, "ModelVariables")
    for reference, variable in enumerate(variables):
        listed.append(_scalar_variable(variable, reference))
    root.append(_structure(variables))
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True) + b"\n"


def _units(root: Element, variables: Iterable[Variable]) -> None:
    definitions = SubElement(root, "UnitDefinitions")
    used = {v.unit for v in variables}
    for name, unit in UNITS.items():
        if name in used:
            exponents = {base: str(power) for base, power in vars(unit).items() if power}
            SubElement(SubElement(definitions, "Unit", name=name), "BaseUnit", exponents)


def _text(value: Value) -> str:
    """Return a value as XML Schema writes it; Reals to the last bit."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def _scalar_variable(variable: Variable, reference: int) -> Element:
    computed = variable.causality in ("output", "calculatedParameter", "local")
    element = Element(
        "ScalarVariable",
        name=variable.name,
        valueReference=str(reference),
        description=variable.description,
        causality=variable.causality,
        variability=variable.variability,
    )
    if variable.causality != "input":  # an input's is exact by definition and may not be given
        element.set("initial", "calculated" if computed else "exact")
    kind = SubElement(element, variable.kind)
    if variable.kind == "Real":
        if variable.unit:
            kind.set("unit", variable.unit)
        for key, value in (("min", variable.minimum), ("nominal", variable.nominal)):
            if value is not None:
                kind.set(key, _text(float(value)))
    elif variable.kind == "Integer" and variable.minimum is not None:
        kind.set("min", str(int(variable.minimum)))
    if variable.start is not None:
        kind.set("start", _text(float(variable.start) if variable.kind == "Real" else variable.start))
    return element


def _structure(variables: Sequence[Variable]) -> Element:
    """Return ModelStructure: which unknown depends on what, in a step and at the start."""
    place = {v.name: index for index, v in enumerate(variables, 1)}
    structure = Element("ModelStructure")
    outputs = SubElement(structure, "Outputs")
    initial = SubElement(structure, "InitialUnknowns")
    for index, variable in enumerate(variables, 1):
        if variable.causality == "output":
            outputs.append(_unknown(index, variable.depends_on, place))
        if variable.causality in ("output", "calculatedParameter"):
            initial.append(_unknown(index, variable.starts_on, place))
    return structure


def _unknown(index: int, depends_on: Iterable[str] | None, place: dict[str, int]) -> Element:
    element = Element("Unknown", index=str(index))
    if depends_on is not None:
        indices = sorted(place[name] for name in depends_on)
        element.set("dependencies", " ".join(map(str, indices)))
        element.set("dependenciesKind", " ".join(["dependent"] * len(indices)))
    return element
