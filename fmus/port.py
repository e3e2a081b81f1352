"""The port: every variable that the rotor FMU and the bearing FMUs exchange.

This is the one declaration of the interface.  The builder writes the
modelDescription from it, the facades address their values by it, the master and
the SSP export connect by it.  SI units and rad throughout.

Frame: fixed, z along the shaft, y up.  ``q = (x, y, tilt_x, tilt_y)`` is the
displacement of the journal centre at the bearing's mid-plane and the rotation of
the journal axis about x and y, so that at the axial distance z from the mid-plane
the journal centre lies at ``(x + tilt_y z, y - tilt_x z)``; ``v = dq/dt``.

The affine law: a bearing returns, besides the wrench ``F(q, v)`` on the rotor, ::

    K = -dF/dq,   C = -dF/dv,   F0 = F + K q + C v

so that ``F0 - K q' - C v'`` is the wrench near the state.  The rotor integrates
that law; see the README of this folder.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

Causality = Literal["input", "output", "parameter", "calculatedParameter"]
Kind = Literal["Real", "Integer", "Boolean", "String"]
Variability = Literal["continuous", "discrete", "fixed", "tunable"]


@dataclass(frozen=True)
class Variable:
    """One scalar variable of a unit as other tools see it.

    Attributes
    ----------
    name : str
        Structured name (FMI 2.0, section 2.2.9).
    causality : str
        FMI causality.
    unit : str
        Name of the unit, a key of `UNITS`; empty for dimensionless.
    description : str
        One line, with sign convention where it matters.
    start : float, int, bool, str or None
        Start value of inputs and parameters.
    minimum, nominal : float or None
        For Real variables, where physics gives them.
    depends_on : tuple of str
        Names of the inputs an output depends on directly.
    kind : str
        FMI type.
    """

    name: str
    causality: Causality
    unit: str = ""
    description: str = ""
    start: float | int | bool | str | None = None
    minimum: float | None = None
    nominal: float | None = None
    depends_on: tuple[str, ...] = ()
    kind: Kind = "Real"

    @property
    def variability(self) -> Variability:
        """FMI variability that follows from causality and type."""
        if self.causality in ("parameter", "calculatedParameter"):
            return "fixed"
        return "continuous" if self.kind == "Real" else "discrete"


@dataclass(frozen=True)
class Unit:
    """A unit as exponents of the SI base units (kg, m, s, rad)."""

    kg: int = 0
    m: int = 0
    s: int = 0
    rad: int = 0


UNITS: dict[str, Unit] = {
    "m": Unit(m=1),
    "m/s": Unit(m=1, s=-1),
    "m/s2": Unit(m=1, s=-2),
    "rad": Unit(rad=1),
    "rad/s": Unit(s=-1, rad=1),
    "s": Unit(s=1),
    "N": Unit(kg=1, m=1, s=-2),
    "N.m": Unit(kg=1, m=2, s=-2),
    "N/m": Unit(kg=1, s=-2),
    "N/rad": Unit(kg=1, m=1, s=-2, rad=-1),
    "N.m/rad": Unit(kg=1, m=2, s=-2, rad=-1),
    "N.s/m": Unit(kg=1, s=-1),
    "N.s/rad": Unit(kg=1, m=1, s=-1, rad=-1),
    "N.s": Unit(kg=1, m=1, s=-1),
    "N.m.s/rad": Unit(kg=1, m=2, s=-1, rad=-1),
    "Pa": Unit(kg=1, m=-1, s=-2),
    "Pa.s": Unit(kg=1, m=-1, s=-1),
    "W": Unit(kg=1, m=2, s=-3),
    "J": Unit(kg=1, m=2, s=-2),
    "kg": Unit(kg=1),
    "kg.m": Unit(kg=1, m=1),
}

POSITION = ("x", "y", "tilt_x", "tilt_y")
VELOCITY = ("v_x", "v_y", "tilt_rate_x", "tilt_rate_y")
KINEMATICS = POSITION + VELOCITY
WRENCH = ("Fx", "Fy", "Mx", "My")

_KINEMATIC_UNITS = ("m", "m", "rad", "rad", "m/s", "m/s", "rad/s", "rad/s")
_KINEMATIC_NOMINAL = (1e-4, 1e-4, 1e-4, 1e-4, 1e-2, 1e-2, 1e-2, 1e-2)
_KINEMATIC_TEXT = (
    "displacement in x (horizontal) at the mid-plane",
    "displacement in y (up) at the mid-plane",
    "rotation of the axis about x",
    "rotation of the axis about y",
    "velocity in x at the mid-plane",
    "velocity in y at the mid-plane",
    "rate of rotation about x",
    "rate of rotation about y",
)
_WRENCH_UNITS = ("N", "N", "N.m", "N.m")
_WRENCH_TEXT = ("force in x", "force in y", "moment about x", "moment about y")
_STIFFNESS_UNITS = (("N/m", "N/rad"), ("N", "N.m/rad"))
_DAMPING_UNITS = (("N.s/m", "N.s/rad"), ("N.s", "N.m.s/rad"))

JOURNAL = tuple(f"journal.{name}" for name in KINEMATICS)
HOUSING = tuple(f"housing.{name}" for name in KINEMATICS)
FORCE = tuple(f"wrench.{name}" for name in WRENCH)
F0 = tuple(f"F0.{name}" for name in WRENCH)
K = tuple(f"K[{i},{j}]" for i in range(1, 5) for j in range(1, 5))
C = tuple(f"C[{i},{j}]" for i in range(1, 5) for j in range(1, 5))
LAW = F0 + K + C
SPEED = "speed"
NOMINAL_SPEED = 157.07963267948966  # 25 Hz


def _kinematics(prefix: str, owner: str, causality: Causality) -> Iterator[Variable]:
    for name, unit, nominal, text in zip(
        KINEMATICS, _KINEMATIC_UNITS, _KINEMATIC_NOMINAL, _KINEMATIC_TEXT, strict=True
    ):
        start = 0.0 if causality == "input" else None
        yield Variable(
            f"{prefix}.{name}", causality, unit, f"{owner}: {text}", start, nominal=nominal
        )


def _law(causality: Causality, prefix: str = "", depends_on: tuple[str, ...] = ()) -> Iterator[Variable]:
    start = 0.0 if causality == "input" else None
    for name, unit, text in zip(F0, _WRENCH_UNITS, _WRENCH_TEXT, strict=True):
        yield Variable(
            prefix + name,
            causality,
            unit,
            f"affine law on the rotor, constant part: {text}; F0 = F + K q + C v",
            start,
            nominal=1e6,
            depends_on=depends_on,
        )
    for names, units, symbol, rate, nominal in (
        (K, _STIFFNESS_UNITS, "stiffness", "q", 1e9),
        (C, _DAMPING_UNITS, "damping", "v", 1e7),
    ):
        for index, name in enumerate(names):
            i, j = divmod(index, 4)
            yield Variable(
                prefix + name,
                causality,
                units[i // 2][j // 2],
                f"affine law, {symbol}: -d{WRENCH[i]}/d{(POSITION if rate == 'q' else VELOCITY)[j]}",
                start,
                nominal=nominal,
                depends_on=depends_on,
            )


BEARING_INPUTS: tuple[Variable, ...] = (
    *_kinematics("journal", "journal", "input"),
    *_kinematics("housing", "housing", "input"),
    Variable(SPEED, "input", "rad/s", "rotor speed, positive from x to y", NOMINAL_SPEED, nominal=100.0),
)
_ON_STATE = tuple(v.name for v in BEARING_INPUTS)

BEARING_OUTPUTS: tuple[Variable, ...] = (
    *(
        Variable(name, "output", unit, f"wrench on the rotor: {text}", nominal=1e6, depends_on=_ON_STATE)
        for name, unit, text in zip(FORCE, _WRENCH_UNITS, _WRENCH_TEXT, strict=True)
    ),
    *_law("output", depends_on=_ON_STATE),
    *(
        Variable(name, "output", unit, text, minimum=minimum, nominal=nominal, depends_on=_ON_STATE)
        for name, unit, text, minimum, nominal in (
            ("h_min", "m", "least gap over the whole film; negative: asperities flattened", None, 1e-4),
            ("h_min_centre", "m", "least gap on the centre line of the bearing", None, 1e-4),
            ("h_min_z", "m", "axial position of the least gap, from the mid-plane", None, 1e-1),
            ("p_max", "Pa", "largest film pressure", 0.0, 1e7),
            ("contact_force", "N", "integral of the solid contact pressure", 0.0, 1e6),
            ("contact.Fx", "N", "part of the wrench from solid contact: force in x", None, 1e6),
            ("contact.Fy", "N", "part of the wrench from solid contact: force in y", None, 1e6),
            ("contact.Mx", "N.m", "part of the wrench from solid contact: moment about x", None, 1e6),
            ("contact.My", "N.m", "part of the wrench from solid contact: moment about y", None, 1e6),
            ("friction_power", "W", "power lost in film shear and solid friction", 0.0, 1e6),
            ("eccentricity", "", "relative eccentricity at the mid-plane, |e|/C", 0.0, 1.0),
            ("sommerfeld", "", "So = |F| psi^2 / (b d eta omega)", 0.0, 1.0),
        )
    ),
)

BEARING_PARAMETERS: tuple[Variable, ...] = (
    Variable("diameter", "parameter", "m", "journal diameter d", 0.80, minimum=0.0, nominal=1.0),
    Variable("width", "parameter", "m", "bearing width b", 0.64, minimum=0.0, nominal=1.0),
    Variable("clearance", "parameter", "m", "radial clearance C = psi d/2", 8.62e-4, minimum=0.0, nominal=1e-3),
    Variable("viscosity", "parameter", "Pa.s", "dynamic viscosity eta of the oil", 0.0242, minimum=0.0, nominal=1e-2),
    Variable("ambient_pressure", "parameter", "Pa", "pressure at the bearing's ends, over the cavity", 0.0, nominal=1e5),
    Variable("contact.roughness", "parameter", "m", "combined roughness sigma of journal and bore", 3e-6, minimum=0.0, nominal=1e-6),
    Variable("contact.modulus", "parameter", "Pa", "contact factor K'E' of p_c = K'E' F_5/2(h/sigma)", 1e9, minimum=0.0, nominal=1e9),
    Variable("contact.friction", "parameter", "", "friction coefficient of solid contact", 0.1, minimum=0.0, nominal=0.1),
    *(
        Variable(f"offset.{name}", "parameter", unit, f"bearing centre in the fixed frame: {text}", 0.0, nominal=1e-4)
        for name, unit, text in zip(POSITION, _KINEMATIC_UNITS[:4], _KINEMATIC_TEXT[:4], strict=True)
    ),
    Variable("film.columns", "parameter", "", "film resolution around the circumference", 48, minimum=16, kind="Integer"),
    Variable("film.rows", "parameter", "", "film resolution along the axis", 8, minimum=3, kind="Integer"),
)

BEARING: tuple[Variable, ...] = BEARING_INPUTS + BEARING_OUTPUTS + BEARING_PARAMETERS
"""The unit of every bearing depth, in the order of its value references."""


def at_bearing(index: int, name: str) -> str:
    """Name on the rotor of the bearing port's variable `name`, bearing `index` from 1."""
    return f"bearing[{index}].{name}"


def rotor(bearings: Sequence[str], wheels: Sequence[str], nodes: int) -> tuple[Variable, ...]:
    """The rotor unit of a train.

    Parameters
    ----------
    bearings, wheels : sequence of str
        Names, in the order of the train; they appear in the descriptions.
    nodes : int
        Nodes of the unreduced shaft.

    Returns
    -------
    tuple of Variable
        In the order of the value references: inputs, outputs on which a step
        depends, parameters, and last the fields over the nodes.
    """
    variables: list[Variable] = [
        Variable(SPEED, "input", "rad/s", "rotor speed, positive from x to y", NOMINAL_SPEED, nominal=100.0)
    ]
    for i, name in enumerate(bearings, 1):
        for v in _law("input", f"bearing[{i}]."):
            variables.append(replace(v, description=f"{name}: {v.description}"))
    for i, name in enumerate(bearings, 1):
        variables.extend(_kinematics(f"bearing[{i}].journal", f"{name}, journal", "output"))
    summary = (
        ("amplitude.max", "m", "largest vibration amplitude of the shaft, from the static line", 1e-4),
        ("amplitude.max_z", "m", "axial position of the largest vibration amplitude", 10.0),
        ("stress.max", "Pa", "largest normal stress from bending, both planes combined", 1e7),
        ("stress.max_z", "m", "axial position of the largest normal stress", 10.0),
    )
    for name, unit, text, nominal in summary:
        variables.append(Variable(name, "output", unit, text, minimum=0.0, nominal=nominal))
    variables += [
        Variable("gravity", "parameter", "m/s2", "gravity, against y", 9.80665, minimum=0.0, nominal=10.0),
        Variable("reduction", "parameter", "", "irs, guyan, craig-bampton or none", "irs", kind="String"),
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
    ]
    for i, name in enumerate(bearings, 1):
        for part, text in (
            ("", "static"),
            ("_cos", "1X orbit, part with cos(speed t):"),
            ("_sin", "1X orbit, part with sin(speed t):"),
        ):
            for pos, unit in zip(POSITION, _KINEMATIC_UNITS, strict=False):
                variables.append(
                    Variable(
                        f"bearing[{i}].start.{pos}{part}",
                        "parameter",
                        unit,
                        f"{name}: journal at the start, {text} {pos}",
                        0.0,
                        nominal=1e-4,
                    )
                )
        variables += [
            Variable(f"bearing[{i}].load", "calculatedParameter", "N", f"{name}: static target load", nominal=1e6),
            Variable(f"bearing[{i}].z", "calculatedParameter", "m", f"{name}: axial position", nominal=10.0),
        ]
    for j, name in enumerate(wheels, 1):
        for key, unit, text in (
            ("unbalance", "kg.m", "nominal unbalance"),
            ("unbalance_phase", "rad", "angle of the nominal unbalance at t = 0"),
            ("blade_unbalance", "kg.m", "unbalance added by the blade fracture"),
            ("blade_phase", "rad", "angle at t = 0 of the unbalance of the lost blade"),
        ):
            variables.append(
                Variable(f"wheel[{j}].{key}", "parameter", unit, f"{name}: {text}", 0.0, nominal=1.0)
            )
    fields = (
        ("x", "m", "displacement in x", None, 1e-4),
        ("y", "m", "displacement in y, static sag included", None, 1e-3),
        ("amplitude", "m", "vibration amplitude from the static line", 0.0, 1e-4),
        ("stress", "Pa", "normal stress from bending, both planes combined", 0.0, 1e7),
    )
    for key, unit, text, minimum, nominal in fields:
        for k in range(1, nodes + 1):
            variables.append(
                Variable(f"node[{k}].{key}", "output", unit, f"shaft node {k}: {text}", minimum=minimum, nominal=nominal)
            )
    return tuple(variables)
