"""Linear: stiffness and damping about a static load, as a depth.

``F = F_s - K (q - q_s) - C v`` with the journal's position and velocity relative to the bearing.  K and C
are 4x4 and full, so that cross terms and unsymmetric matrices have their place; they are constant, or
functions of speed through the points of a table.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.linear.monotone_cubic import MonotoneCubic
from fmus import port
from fmus.port.variable import Value

Floats = NDArray[np.float64]

_NO_MEMORY = np.zeros(0)
_SLACK = 1e-9
"""Share of the highest speed of a table by which rounding may leave it."""


class LinearBearing:
    """A bearing that is stiffness and damping, see `bearing_fmu.depths.Film`.

    Parameters
    ----------
    values : mapping
        Values of the depth's parameters by name.

    Raises
    ------
    ValueError
        A table that cannot be read, or geometry that is no bearing's.
    """

    def __init__(self, values: Mapping[str, Value]) -> None:
        rows = np.array(port.rows_of_values(values))
        self._speeds = rows[:, 0]
        if len(rows) == 1:
            self._constant = self._matrices(rows[0, 1:])
        else:
            self._curve = MonotoneCubic(self._speeds, rows[:, 1:])
        self._static = np.array([float(values[name]) for name in port.STATIC_WRENCH])
        self._centre = np.array([float(values.get(f"offset.{name}", 0.0)) for name in port.POSITION])
        self._centre = self._centre + [float(values[name]) for name in port.STATIC_POSITION]
        self._bore = self._centre[:2] - [float(values[name]) for name in port.STATIC_POSITION[:2]]
        for key in ("diameter", "width", "clearance", "viscosity"):
            variable = port.bearing_parameter(key)
            if not variable.admits(float(values[variable.name])):
                raise ValueError(
                    f"bearing parameter {key} = {values[variable.name]!r}: must be {variable.range}"
                )
        diameter, width, self._clearance, viscosity = (
            float(values[name]) for name in ("diameter", "width", "clearance", "viscosity")
        )
        self._supply = float(values["oil.supply_temperature"])
        self._unit_load = viscosity * diameter * width * (0.5 * diameter / self._clearance) ** 2

    def rest(self) -> Floats:
        """No memory, no state."""
        return _NO_MEMORY

    def coefficients(self, speed: float) -> tuple[Floats, Floats]:
        """Stiffness and damping at a speed [rad/s], (4, 4) each; ArithmeticError outside the table."""
        if len(self._speeds) == 1:
            return self._constant
        low, high = float(self._speeds[0]), float(self._speeds[-1])
        slack = _SLACK * max(abs(low), abs(high))
        if not low - slack <= speed <= high + slack:
            raise ArithmeticError(
                f"stiffness and damping are given from {low:g} to {high:g} rad/s, not at {speed:g} rad/s"
            )
        return self._matrices(self._curve(min(max(speed, low), high)))

    def evaluate(self, state: Floats, inputs: Floats, dt: float) -> tuple[Floats, Floats]:
        """Evaluate the port, see `bearing_fmu.depths.Film.evaluate`."""
        stiffness, damping = self.coefficients(float(inputs[16]))
        # the constant part first: the affine law is then what the wrench is made of
        constant = self._static + stiffness @ self._centre
        wrench = constant - stiffness @ (inputs[:4] - inputs[8:12]) - damping @ (inputs[4:8] - inputs[12:16])
        distance = float(np.hypot(*(inputs[:2] - inputs[8:10] - self._bore)))
        gap = self._clearance - distance
        rate = self._unit_load * abs(float(inputs[16]))
        others = dict.fromkeys((v.name for v in port.BEARING_OUTPUTS[40:]), 0.0)
        others |= {
            "oil_temperature": self._supply,
            "h_min": gap,
            "h_min_centre": gap,
            "eccentricity": distance / self._clearance,
        }
        others["sommerfeld"] = float(np.hypot(wrench[0], wrench[1])) / rate if rate > 0.0 else 0.0
        parts: list[Any] = [wrench, constant, stiffness.ravel(), damping.ravel(), list(others.values())]
        outputs = np.concatenate(parts)
        if not np.isfinite(outputs @ outputs):
            raise ArithmeticError("the wrench of the linear bearing is not finite")
        return outputs, state

    @staticmethod
    def _matrices(numbers: Floats) -> tuple[Floats, Floats]:
        return numbers[:16].reshape(4, 4), numbers[16:].reshape(4, 4)


def make(values: Mapping[str, Value]) -> LinearBearing:
    """Make the bearing of these parameters, see `bearing_fmu.depths.Depth.film`."""
    return LinearBearing(values)
