"""The modelling depths of a bearing: the one place that lists them.

To add a depth, write its film and register a `Depth` for it; units, command line, scenarios, SSPs and
figures follow.  Nothing but the standard library and the port is imported here, so that listing the
depths costs nothing.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from importlib import import_module
from typing import Any, Protocol

from fmus import port
from fmus.port.variable import Value, Variable


class Film(Protocol):
    """What a depth evaluates: a film with its parameters."""

    def rest(self) -> Any:
        """State of the film before the first evaluation, a float64 array; empty for a film without memory."""

    def evaluate(self, state: Any, inputs: Any, dt: float) -> tuple[Any, Any]:
        """Evaluate the film at the end of a step.

        Nothing is kept: the caller takes the state on when it accepts the step.

        Parameters
        ----------
        state : ndarray
            At the beginning of the step; never changed in place.
        inputs : ndarray, shape (17,)
            At its end, in the order of `fmus.port.BEARING_INPUTS`.
        dt : float
            Length of the step in s; 0 where the film is to be in balance with the inputs, at the start.

        Returns
        -------
        outputs : ndarray, shape (58,) or more
            In the order of `fmus.port.BEARING_OUTPUTS`, and of what it tells of `fmus.port.BEARING_DETAILS`.
        state : ndarray
            At the end of the step.

        Raises
        ------
        ArithmeticError
            The film has no answer; says why, at which state, and what helps.
        """


@dataclass(frozen=True)
class Depth:
    """A modelling depth.

    Attributes
    ----------
    name : str
        The word for it in scenarios, options and file names.
    title : str
        What it is in a few words, for help and figures.
    text : str
        One line, the description of its FMU.
    film : str
        ``module:function`` that makes a `Film` of the parameters' values by name; importing the module
        registers the depth.
    parameters : tuple of Variable
        With units, start values and ranges. All depths have those of the port; own ones stand behind them.
    memory : bool
        Whether outputs depend on earlier inputs whatever the parameters; then the film's state belongs to
        that of the unit.
    tilts : bool
        Whether it sees tilts and gives moments.
    isotropic : bool
        Whether no direction is unlike another, as in a plain bore: turned inputs give turned outputs.
    affine : bool
        Whether its wrench is an affine function of position and velocity, and no film is solved.
    quick : bool
        Whether an evaluation takes some microseconds only, which threads would but delay.
    boundaries : tuple of str
        What it offers of ``film.boundary``.
    ahead : str
        ``module:function`` that does for a bearing's values once what its films then share, and returns a
        line about it, empty where it was done before; empty: nothing to be done.
    remembering : tuple of str
        Those of `boundaries` with which outputs depend on earlier inputs.
    pads : bool
        Whether it knows tilting pads, whose places belong to the state.
    colour : str
        Of its lines in figures; empty: the next that is free.
    """

    name: str
    title: str
    text: str
    film: str
    parameters: tuple[Variable, ...] = port.BEARING_PARAMETERS
    memory: bool = False
    tilts: bool = False
    isotropic: bool = True
    affine: bool = False
    quick: bool = False
    boundaries: tuple[str, ...] = ("guembel",)
    ahead: str = ""
    remembering: tuple[str, ...] = ()
    pads: bool = False
    colour: str = ""

    @property
    def variables(self) -> tuple[Variable, ...]:
        """The unit, in the order of its value references."""
        own = tuple(v.name for v in self.parameters[len(port.BEARING_PARAMETERS) :])
        computed = (*port.BEARING_OUTPUTS, *port.BEARING_DETAILS, port.BEARING_FAILURE)
        *outputs, failure = (replace(v, starts_on=(*(v.starts_on or ()), *own)) for v in computed)
        return (*port.BEARING_INPUTS, *outputs, *self.parameters, failure)

    def make(self, values: Mapping[str, Value]) -> Film:
        """Make the film of these parameters; ValueError names the one that is out of range."""
        make: Callable[[Mapping[str, Value]], Film] = _found(self.film)
        return make(values)

    def prepare(self, values: Mapping[str, Value]) -> str:
        """Do what is to be done `ahead` for these parameters; ValueError as of `make`."""
        return str(_found(self.ahead)(values)) if self.ahead else ""


def _found(place: str) -> Any:
    """What ``module:name`` names."""
    module, _, name = place.partition(":")
    return getattr(import_module(module), name)


_DEPTHS: dict[str, Depth] = {}


def register(depth: Depth) -> Depth:
    """Make a depth known to everything that lists depths; ValueError if its name is taken or unfit."""
    if not re.fullmatch(r"[a-z][a-z0-9_]*", depth.name):
        raise ValueError(f"bearing depth {depth.name!r}: allowed are small letters, digits and underscores")
    if depth.parameters[: len(port.BEARING_PARAMETERS)] != port.BEARING_PARAMETERS:
        raise ValueError(f"bearing depth {depth.name!r}: its parameters must begin with those of the port")
    if _DEPTHS.setdefault(depth.name, depth) != depth:
        raise ValueError(f"bearing depth {depth.name!r}: the name is taken")
    return depth


def depths() -> tuple[Depth, ...]:
    """All depths, the most detailed of bladeloss first."""
    return tuple(_DEPTHS.values())


def names() -> tuple[str, ...]:
    """Names of all depths."""
    return tuple(_DEPTHS)


def films() -> tuple[str, ...]:
    """Names of the depths that solve a film, the most detailed of bladeloss first."""
    return tuple(depth.name for depth in _DEPTHS.values() if not depth.affine)


def find(name: str) -> Depth:
    """The depth of this name; ValueError if there is none."""
    if name not in _DEPTHS:
        raise ValueError(f"bearing depth {name!r}: allowed are {', '.join(_DEPTHS)}")
    return _DEPTHS[name]


register(
    Depth(
        name="v1",
        title="Reynolds with misalignment",
        text="Journal bearing: Reynolds equation with misalignment and solid contact.",
        film="bearing_fmu.films.tilted.depth:make",
        tilts=True,
        boundaries=("guembel", "reynolds", "jfo"),
        pads=True,
        remembering=("jfo",),
    )
)
register(
    Depth(
        name="v2",
        title="Reynolds, aligned",
        text="Journal bearing: Reynolds equation of the aligned journal, with solid contact.",
        film="bearing_fmu.films.aligned.depth:make",
        boundaries=("guembel", "reynolds"),
        pads=True,
        quick=True,
    )
)
register(
    Depth(
        name="table",
        title="Reynolds, aligned, looked up",
        text="Journal bearing: the aligned journal's Reynolds equation as a table, with solid contact.",
        film="bearing_fmu.films.table.depth:make",
        boundaries=("guembel", "reynolds"),
        ahead="bearing_fmu.films.table.depth:ahead",
        quick=True,
    )
)
register(
    Depth(
        name="v3",
        title="short bearing",
        text="Journal bearing: short-bearing formula, with solid contact.",
        film="bearing_fmu.films.short.depth:make",
        quick=True,
    )
)
LINEAR = register(
    Depth(
        name="linear",
        title="stiffness and damping",
        text="Journal bearing: stiffness and damping about a static load, constant or over speed.",
        film="bearing_fmu.films.linear.depth:make",
        parameters=(*port.BEARING_PARAMETERS, *port.LINEAR_PARAMETERS),
        tilts=True,
        isotropic=False,
        affine=True,
        quick=True,
    )
)
