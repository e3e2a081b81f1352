"""What an SSP says, as plain data; `writer` and `reader` turn it into files and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from fmus.port.variable import Value
from orchestrator.errors import OrchestratorError
from orchestrator.master.graph import Connection
from orchestrator.ssp.units import Given, UnitDefinition

ROTOR = "rotor"
"""Name of the rotor's component, and of its unit."""


class SspError(OrchestratorError):
    """An SSP that cannot be written, read or run; the text says where and why."""


@dataclass(frozen=True)
class Connector:
    """A variable of a component that others may be connected to.

    Attributes
    ----------
    name, kind, unit : str
        Of the FMU's variable; `kind` is its causality.
    """

    name: str
    kind: str
    unit: str


@dataclass(frozen=True)
class Component:
    """An instance of an FMU.

    Attributes
    ----------
    name : str
        Identifier: letters, digits, underscores.
    source : str
        The FMU's path in the archive.
    description : str
        The name that people know it by.
    connectors : tuple of Connector
        In the order of the FMU.
    parameters : mapping
        Start values of inputs and parameters by name, in the FMU's units.
    given : mapping
        The same as read, before the FMU's units are known.
    """

    name: str
    source: str
    description: str = ""
    connectors: tuple[Connector, ...] = ()
    parameters: Mapping[str, Value] = field(default_factory=dict)
    given: Mapping[str, Given] = field(default_factory=dict)


@dataclass(frozen=True)
class Structure:
    """A system of components.

    Attributes
    ----------
    name : str
        Identifier of the system.
    title : str
        One line.
    components : tuple of Component
        The order carries no meaning.
    connections : tuple of Connection
        From output to input.
    end, step : float or None
        End time and macro step in s.
    coupling : str or None
        Coupling of the orchestrator; other tools have their own.
    tolerance : float or None
        Largest relative defect of a step of that coupling.
    record_interval : float or None
        In s.
    analysed_bearing : str or None
        Shown in summary and figures.
    events : str or None
        Events that no parameter of the rotor tells, as JSON.
    units : mapping
        Units that the system definition defines.
    """

    name: str
    title: str
    components: tuple[Component, ...]
    connections: tuple[Connection, ...]
    end: float | None = None
    step: float | None = None
    coupling: str | None = None
    tolerance: float | None = None
    record_interval: float | None = None
    analysed_bearing: str | None = None
    events: str | None = None
    units: Mapping[str, UnitDefinition] = field(default_factory=dict)
