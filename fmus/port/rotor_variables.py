"""The variables of the rotor unit of a train."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from fmus.port.balance import BALANCE, TRACK_WORK, WORK
from fmus.port.connector import (
    KINEMATIC_UNITS,
    NOMINAL_SPEED,
    POSITION,
    SPEED,
    WRENCH,
    WRENCH_TEXT,
    WRENCH_UNITS,
    kinematics,
    law,
)
from fmus.port.drive import DRIVE_PARAMETERS, FRICTION_POWER, ROTATION_OUTPUT, drive_inputs
from fmus.port.failure import FAILURE
from fmus.port.start import ORBIT_FOLLOWS, START_PARTS, shape_follows, start_names
from fmus.port.variable import Value, Variable, with_starts

_SPEED = Variable(SPEED, "input", "rad/s", "", NOMINAL_SPEED, nominal=100.0)


def at_bearing(index: int, name: str) -> str:
    """Name on the rotor of the bearing port's variable `name`, bearing `index` from 1."""
    return f"bearing[{index}].{name}"


PARTS = "parts"
"""Parameter that says in how many equal parts the rotor goes each step."""

_ROTOR_PARAMETERS: tuple[Variable, ...] = (
    Variable(
        "gravity",
        "parameter",
        "m/s2",
        "gravity; against y, or as the train says",
        9.80665,
        minimum=0.0,
        nominal=10.0,
    ),
    Variable(
        "reduction", "parameter", "", "irs, irs-plain, guyan, craig-bampton, none", "irs", kind="String"
    ),
    Variable(
        "reduction.used",
        "calculatedParameter",
        "",
        "reduction carried out; and why, if it is another one than asked for",
        kind="String",
        starts_on=("reduction",),
    ),
    Variable(
        "start.from_law",
        "parameter",
        "",
        "start in equilibrium with the affine laws at the inputs instead of at start.*",
        False,
        kind="Boolean",
    ),
    Variable(
        "start.orbit",
        "parameter",
        "",
        "start with the linear unbalance response superposed",
        True,
        kind="Boolean",
    ),
    Variable("fracture.time", "parameter", "s", "instant of the blade fracture", 1.0, nominal=1.0),
    Variable(
        PARTS,
        "parameter",
        "",
        "equal parts in which a step is taken under one law; within each of them wrenches run straight",
        1,
        minimum=1,
        kind="Integer",
    ),
    TRACK_WORK,
)
_SUMMARY = (
    ("amplitude.max", "m", "largest vibration amplitude of the shaft, from the static line", 1e-4),
    ("amplitude.max_z", "m", "axial position of the largest vibration amplitude", 10.0),
    ("stress.max", "Pa", "largest normal stress from bending, both planes combined", 1e7),
    ("stress.max_z", "m", "axial position of the largest normal stress", 10.0),
)
_WHEEL = (
    ("unbalance", "kg.m", "nominal unbalance"),
    ("unbalance_phase", "rad", "angle of the nominal unbalance at t = 0"),
    ("blade_unbalance", "kg.m", "unbalance added by the blade fracture"),
    ("blade_phase", "rad", "angle at t = 0 of the unbalance of the lost blade"),
)
_FIELDS = (
    ("x", "m", "displacement in x", None, 1e-4),
    ("y", "m", "displacement in y, static sag included", None, 1e-3),
    ("amplitude", "m", "vibration amplitude from the static line", 0.0, 1e-4),
    ("stress", "Pa", "normal stress from bending, both planes combined", 0.0, 1e7),
)


def _position(name: str, owner: str) -> Variable:
    return Variable(name, "calculatedParameter", "m", f"{owner}: axial position", nominal=10.0, starts_on=())


def _rotor_journal(i: int, owner: str) -> Iterator[Variable]:
    """Yield the outputs at bearing `i`; initially they follow the start parameters."""
    for index, v in enumerate(kinematics(f"bearing[{i}].journal", f"{owner}, journal", "output")):
        yield replace(v, starts_on=ORBIT_FOLLOWS + start_names(i, POSITION[index % 4]))


def _housing(i: int, owner: str) -> Iterator[Variable]:
    """Yield the outputs of the housing at bearing `i`."""
    for v in kinematics(f"bearing[{i}].housing", f"{owner}, housing", "output"):
        yield replace(v, starts_on=())


def _on_foundation(i: int, owner: str, shape: tuple[str, ...]) -> Iterator[Variable]:
    """Yield the wrench on the foundation at bearing `i`."""
    for name, unit, text in zip(WRENCH, WRENCH_UNITS, WRENCH_TEXT, strict=True):
        described = f"{owner}, on the foundation: {text}"
        yield Variable(
            f"bearing[{i}].foundation.{name}", "output", unit, described,
            nominal=1e6, lazy="foundation", starts_on=shape,
        )  # fmt: skip


def _seat(i: int, name: str) -> Iterator[Variable]:
    """Yield start, load and position at bearing `i`."""
    for part, text in START_PARTS:
        for pos, unit in zip(POSITION, KINEMATIC_UNITS[:4], strict=True):
            described = f"{name}: journal at the start, {text} {pos}"
            start_name = f"bearing[{i}].start.{pos}{part}"
            yield Variable(start_name, "parameter", unit, described, 0.0, nominal=1e-4)
    load, on = f"{name}: static target load, against gravity", ("gravity",)
    yield Variable(f"bearing[{i}].load", "calculatedParameter", "N", load, nominal=1e6, starts_on=on)
    yield _position(f"bearing[{i}].z", name)


def _wheel(j: int, name: str) -> Iterator[Variable]:
    """Yield unbalance and position of wheel `j`."""
    for key, unit, text in _WHEEL:
        yield Variable(f"wheel[{j}].{key}", "parameter", unit, f"{name}: {text}", 0.0, nominal=1.0)
    yield _position(f"wheel[{j}].z", name)


def rotor(
    bearings: Sequence[str],
    wheels: Sequence[str],
    nodes: int,
    starts: Mapping[str, Value] | None = None,
    *,
    moving: bool = False,
) -> tuple[Variable, ...]:
    """The rotor unit of a train.

    Parameters
    ----------
    bearings, wheels : sequence of str
        Names, in the order of the train; they appear in the descriptions.
    nodes : int
        Nodes of the unreduced shaft.
    starts : mapping, optional
        Start values of the train, by variable name, in place of the port's.
    moving : bool
        Whether the housings of its bearings move.

    Returns
    -------
    tuple of Variable
        In the order of the value references: inputs, outputs on which a step
        depends, parameters, the fields over the nodes, and last the failure.  The fields
        are local variables: to look at, not to connect.

    Notes
    -----
    With ``start.from_law`` the initial outputs depend on the inputs, too.  That is
    for masters that ask for it; `Variable.starts_on` names what they depend on
    otherwise, so that other tools see no algebraic loop at the start.
    """
    variables: list[Variable] = [
        Variable(
            SPEED,
            "input",
            "rad/s",
            "rotor speed at the end of a step, positive from x to y",
            NOMINAL_SPEED,
            nominal=100.0,
        )
    ]
    for i, name in enumerate(bearings, 1):
        for v in law("input", f"bearing[{i}]."):
            variables.append(replace(v, description=f"{name}: {v.description}"))
    variables.extend(drive_inputs())
    for i, name in enumerate(bearings, 1):
        power = f"{name}: friction power, which slows a released rotor"
        variables.append(Variable(at_bearing(i, FRICTION_POWER), "input", "W", power, 0.0, nominal=1e5))
    for i, name in enumerate(bearings, 1):
        variables.extend(_rotor_journal(i, name))
    for i, name in enumerate(bearings if moving else (), 1):
        variables.extend(_housing(i, name))
    variables.append(ROTATION_OUTPUT)
    shape = shape_follows(len(bearings), len(wheels))
    for i, name in enumerate(bearings if moving else (), 1):
        variables.extend(_on_foundation(i, name, shape))
    for name, unit, text, nominal in _SUMMARY:
        summary = Variable(name, "output", unit, text, minimum=0.0, nominal=nominal, lazy="extremes")
        variables.append(replace(summary, starts_on=shape))
    started = {**dict.fromkeys(WORK, ()), "energy.rotation": (*shape, "drive.inertia")}
    variables.extend(replace(v, starts_on=started.get(v.name, shape)) for v in BALANCE)
    variables.extend((*_ROTOR_PARAMETERS, *DRIVE_PARAMETERS))
    for i, name in enumerate(bearings, 1):
        variables.extend(_seat(i, name))
    for j, name in enumerate(wheels, 1):
        variables.extend(_wheel(j, name))
    variables.extend(_position(f"node[{k}].z", f"shaft node {k}") for k in range(1, nodes + 1))
    for key, unit, text, minimum, nominal in _FIELDS:
        for k in range(1, nodes + 1):
            described = f"shaft node {k}: {text}"
            field = Variable(f"node[{k}].{key}", "local", unit, described, minimum=minimum, nominal=nominal)
            variables.append(replace(field, lazy="fields"))
    variables.append(replace(FAILURE, starts_on=shape))
    return with_starts(variables, starts or {})
