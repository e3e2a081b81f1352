"""A depth with memory: a spring beside one in series with a damper (Maxwell), in each direction.

The force in the element follows s' = K1 q' - s / tau. Along a step in which q moves evenly that is, exactly,
s + h = exp(-a) s + K1 dq (1 - exp(-a)) / a with a = h / tau. Importing it makes the depth known.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from bearing_fmu import depths
from fmus import port
from fmus.port.variable import Value

STIFFNESS, ADDED, DAMPING = 1e9, 6e8, 3e6  # N/m of the spring, of the element, and N s/m beside them
RELAXATION = 2e-3  # s


class RelaxingFilm:
    """F = -K q - C v - s; the state is the element's force s and the position q it belongs to."""

    def __init__(self, clearance: float, offset: np.ndarray) -> None:
        self.clearance, self.offset = clearance, offset

    def rest(self) -> np.ndarray:
        return np.zeros(4)

    def evaluate(self, state: np.ndarray, inputs: np.ndarray, dt: float) -> tuple[np.ndarray, np.ndarray]:
        q, v = inputs[:4] - inputs[8:12] - self.offset, inputs[4:8] - inputs[12:16]
        distance = float(np.hypot(q[0], q[1])) / self.clearance
        if not distance < 1.0:
            raise ArithmeticError(f"a journal at {distance:.3g} of the clearance: take a smaller step")
        element, share = np.zeros(2), 0.0
        if dt > 0.0:
            a = dt / RELAXATION
            share = -math.expm1(-a) / a
            element = math.exp(-a) * state[:2] + ADDED * (q[:2] - state[2:]) * share
        stiffness, damping, force = np.zeros((4, 4)), np.zeros((4, 4)), np.zeros(4)
        stiffness[:2, :2], damping[:2, :2] = (STIFFNESS + ADDED * share) * np.eye(2), DAMPING * np.eye(2)
        force[:2] = -STIFFNESS * q[:2] - DAMPING * v[:2] - element
        law = force + stiffness @ (inputs[:4] - inputs[8:12]) + damping @ v
        others = dict.fromkeys((v.name for v in port.BEARING_OUTPUTS[40:]), 0.0)
        others |= {"h_min": (1.0 - distance) * self.clearance, "eccentricity": distance}
        others["h_min_centre"] = others["h_min"]
        outputs = np.concatenate([force, law, stiffness.ravel(), damping.ravel(), list(others.values())])
        return outputs, np.concatenate([element, q[:2]])


def make(values: Mapping[str, Value]) -> RelaxingFilm:
    """The film of these parameters."""
    offset = np.array([float(values[f"offset.{name}"]) for name in port.POSITION])
    return RelaxingFilm(float(values["clearance"]), offset)


RELAXING = depths.register(
    depths.Depth(
        name="relaxing",
        title="relaxing spring",
        text="Journal bearing: a spring beside a spring in series with a damper.",
        film="tests.relaxing_film:make",
        memory=True,
        quick=True,
    )
)
