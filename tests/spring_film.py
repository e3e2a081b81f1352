"""A depth of its own in one file: a film that is a linear spring and damper, stiffer in one direction.

Importing it makes it known; nothing else names it but its test.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from bearing_fmu import depths
from fmus import port
from fmus.port.variable import Value, Variable

STIFFNESS = np.array([[6e8, 3e8], [-1e8, 2e9]])  # N/m, crossed and unlike, for a film of unit scale
DAMPING = np.array([[2e6, 0.0], [0.0, 4e6]])  # N s/m


class LinearFilm:
    """F = -scale (stiffness q + damping v) on the position relative to the bearing."""

    def __init__(self, scale: float, clearance: float, offset: np.ndarray) -> None:
        self.scale, self.clearance, self.offset = scale, clearance, offset

    def rest(self) -> np.ndarray:
        return np.zeros(0)

    def evaluate(self, state: np.ndarray, inputs: np.ndarray, dt: float) -> tuple[np.ndarray, np.ndarray]:
        q, v = inputs[:4] - inputs[8:12] - self.offset, inputs[4:8] - inputs[12:16]
        distance = float(np.hypot(q[0], q[1])) / self.clearance
        if not distance < 1.0:
            raise ArithmeticError(f"a journal at {distance:.3g} of the clearance: take a smaller step")
        stiffness, damping = np.zeros((4, 4)), np.zeros((4, 4))
        stiffness[:2, :2], damping[:2, :2] = self.scale * STIFFNESS, self.scale * DAMPING
        force = -stiffness @ q - damping @ v
        law = force + stiffness @ (inputs[:4] - inputs[8:12]) + damping @ v
        others = dict.fromkeys((v.name for v in port.BEARING_OUTPUTS[40:]), 0.0)
        others |= {"h_min": (1.0 - distance) * self.clearance, "eccentricity": distance}
        others["h_min_centre"] = others["h_min"]
        outputs = np.concatenate([force, law, stiffness.ravel(), damping.ravel(), list(others.values())])
        return outputs, state


def make(values: Mapping[str, Value]) -> LinearFilm:
    """The film of these parameters."""
    offset = np.array([float(values[f"offset.{name}"]) for name in port.POSITION])
    return LinearFilm(float(values["film.scale"]), float(values["clearance"]), offset)


SPRING = depths.register(
    depths.Depth(
        name="spring",
        title="spring and damper",
        text="Journal bearing: a linear spring and damper.",
        film="tests.spring_film:make",
        parameters=(
            *port.BEARING_PARAMETERS,
            Variable(
                "film.scale", "parameter", "", "scale of stiffness and damping", 1.0, minimum=0.0, nominal=1.0
            ),
        ),
        isotropic=False,
        quick=True,
    )
)
