"""What the length of a step does to the bearing forces, from what is known at its ends.

The defect sees the interface: whether rotor and bearings agree at the end of a step.  An iterated step has
none, however long it is.  Between both ends the rotor lets each wrench run straight; the film would follow
the motion.  In the middle of a step of length H, with position and velocity of the journal known at both
ends, a cubic through them (Hermite) differs from the straight line by ::

    q: H (v0 - v1) / 8          v: 3 (q1 - q0 - H (v0 + v1) / 2) / (2 H)

The first is of second order, the second, too, while the motion is smooth in the step; where it vibrates
faster than the step sees, the second grows without bound.  K and C of the film make a wrench of both.
Two thirds of it is its mean over the step (a parabola), and `PASSED` of that is found again in the bearing
forces: measured against converged runs, see `error_of_step`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import compiled, dot

Array = NDArray[np.float64]

PASSED = 0.1
"""Share of the wrench missed within a step that is found in the forces; the shaft's inertia bears the rest.

Largest error of a force against the largest force, estimated with this share and found: newton on the small
train at 1 and 2 ms 0.7 and 7.5 %, 0.6 and 8.2 %; through contact of the big train at 0.2 ms 2.7 and 3.9 %.
"""


def error_of_step(start: Array, end: Array, tangent: Array, step: float) -> Array:
    """Return the error of the bearing wrenches that comes of the length of a step.

    Parameters
    ----------
    start, end : ndarray (bearings, 8)
        q and v of the journals at both ends.
    tangent : ndarray (bearings, 2, 4, 4)
        K and C of the bearings.
    step : float
        Its length in s.

    Returns
    -------
    ndarray (bearings, 4)
    """
    missed = np.empty((len(start), 4))
    _missed(start, end, tangent, step, np.empty((2, 4)), missed)
    return missed


@compiled
def _missed(start: Array, end: Array, tangent: Array, step: float, room: Array, missed: Array) -> None:
    of_position, of_velocity = room[0], room[1]
    for b in range(len(missed)):
        for j in range(4):
            turned = end[b, 4 + j] - start[b, 4 + j]
            of_position[j] = -0.125 * step * turned
            of_velocity[j] = 1.5 * ((end[b, j] - start[b, j]) / step - 0.5 * turned - start[b, 4 + j])
        for i in range(4):
            wrench = dot(tangent[b, 0, i], of_position) + dot(tangent[b, 1, i], of_velocity)
            missed[b, i] = wrench * (-2.0 / 3.0 * PASSED)
