"""The mechanical connector between rotor and bearing: names, units and texts of its variables.

``q = (x, y, tilt_x, tilt_y)`` and ``v = dq/dt`` go one way, the wrench or the affine
law ``F0 - K q - C v`` the other; see `fmus.port`.
"""

from __future__ import annotations

from collections.abc import Iterator

from fmus.port.variable import Causality, Variable

POSITION = ("x", "y", "tilt_x", "tilt_y")
VELOCITY = ("v_x", "v_y", "tilt_rate_x", "tilt_rate_y")
KINEMATICS = POSITION + VELOCITY
WRENCH = ("Fx", "Fy", "Mx", "My")

KINEMATIC_UNITS = ("m", "m", "rad", "rad", "m/s", "m/s", "rad/s", "rad/s")
_KINEMATIC_NOMINAL = (1e-4, 1e-4, 1e-4, 1e-4, 1e-2, 1e-2, 1e-2, 1e-2)
KINEMATIC_TEXT = (
    "displacement in x (horizontal) at the mid-plane",
    "displacement in y (up) at the mid-plane",
    "rotation of the axis about x",
    "rotation of the axis about y",
    "velocity in x at the mid-plane",
    "velocity in y at the mid-plane",
    "rate of rotation about x",
    "rate of rotation about y",
)
WRENCH_UNITS = ("N", "N", "N.m", "N.m")
WRENCH_TEXT = ("force in x", "force in y", "moment about x", "moment about y")
STIFFNESS_UNITS = (("N/m", "N/rad"), ("N", "N.m/rad"))
DAMPING_UNITS = (("N.s/m", "N.s/rad"), ("N.s", "N.m.s/rad"))

JOURNAL = tuple(f"journal.{name}" for name in KINEMATICS)
HOUSING = tuple(f"housing.{name}" for name in KINEMATICS)
FOUNDATION = tuple(f"foundation.{name}" for name in WRENCH)
FORCE = tuple(f"wrench.{name}" for name in WRENCH)
F0 = tuple(f"F0.{name}" for name in WRENCH)
K = tuple(f"K[{i},{j}]" for i in range(1, 5) for j in range(1, 5))
C = tuple(f"C[{i},{j}]" for i in range(1, 5) for j in range(1, 5))
LAW = F0 + K + C
SPEED = "speed"
NOMINAL_SPEED = 157.07963267948966  # 25 Hz


def kinematics(prefix: str, owner: str, causality: Causality) -> Iterator[Variable]:
    """Yield the eight variables q, v of `owner`, named ``prefix.x`` and so on."""
    for name, unit, nominal, text in zip(
        KINEMATICS, KINEMATIC_UNITS, _KINEMATIC_NOMINAL, KINEMATIC_TEXT, strict=True
    ):
        start = 0.0 if causality == "input" else None
        yield Variable(f"{prefix}.{name}", causality, unit, f"{owner}: {text}", start, nominal=nominal)


def law(causality: Causality, prefix: str = "", depends_on: tuple[str, ...] = ()) -> Iterator[Variable]:
    """Yield the 36 variables F0, K, C of the affine law, row by row."""
    start = 0.0 if causality == "input" else None
    for name, unit, text in zip(F0, WRENCH_UNITS, WRENCH_TEXT, strict=True):
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
        (K, STIFFNESS_UNITS, "stiffness", "q", 1e9),
        (C, DAMPING_UNITS, "damping", "v", 1e7),
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
