"""What a speed off that of the coordinates does to a step: the gyroscopic force, as it is in the middle.

At the speed W + d, with the acceleration a, the force -G (d p' + a p) acts besides on a shaft that is stepped
with the maps of W: the spin's angular momentum grows along the axis of each section, and with the drive's
torque along the axis of the bearings a moment a G p is left (Genta 2005, Dynamics of Rotating Systems,
section 6).  It is held through the step as it is in its middle, where the force itself has moved the shaft
for half a step: a midpoint rule of second order (Hochbruck and Ostermann 2010, Acta Numerica 19, 209-286,
section 2.5), that gives modes slower than the step next to no energy.  On a grid of speeds d is at most half
of `SPACING`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SPACING = 2.0
"""Of the grid of speeds at which modes are found [rad/s]."""


def grid_speed(speed: float) -> float:
    """The speed of the grid nearest to a speed [rad/s]."""
    return SPACING * round(speed / SPACING)


@dataclass(frozen=True, eq=False)
class Detuning:
    """The gyroscopic force of a difference of speed, and what it moves in a step.

    Attributes
    ----------
    gyroscopic : ndarray, (m, m)
        G, or the polar inertia of shafts in the complex plane.
    sign : float or complex
        -1, or i in the complex plane, of the force.
    push : ndarray, (s, m)
        Motion at the end of the step from a force held through it; real, or complex for motions of pairs.
    step : float
        Its length [s].
    states : ndarray, (2 m, s), or None
        Displacements and velocities of a motion; None where it is these.
    """

    gyroscopic: Array
    sign: complex
    push: NDArray[Any]
    step: float
    states: NDArray[Any] | None = None

    def pushed(self, middle: Array, difference: float, acceleration: float) -> tuple[Array, float]:
        """What is added to the motion at the end of the step, and the power of the force [W].

        Parameters
        ----------
        middle : ndarray
            The motion in the middle of the step; where a foundation follows in it, that stays out of this.
        difference, acceleration : float
            d [rad/s] and a [rad/s2].
        """
        kind, m = self.push.dtype, len(self.gyroscopic)
        own = len(self.push) * kind.itemsize // 8
        motion = middle[:own].view(kind)
        if self.states is not None:
            motion = self.states @ motion
        p, v = motion[:m], motion[m:]
        v = v + 0.5 * self.step * self._force(difference * v + acceleration * p)
        force = self._force(difference * v + acceleration * p)
        pushed = (self.push @ force).view(np.float64)
        if own < len(middle):
            pushed = np.append(pushed, np.zeros(len(middle) - own))
        return pushed, float(np.vdot(v, force).real)

    def _force(self, arm: NDArray[Any]) -> NDArray[Any]:
        turned = self.gyroscopic @ arm.view(np.float64).reshape(len(arm), -1)
        return np.asarray(self.sign * turned.reshape(-1).view(arm.dtype))
