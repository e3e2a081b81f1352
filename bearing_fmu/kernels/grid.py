"""The circumferential grid, graded towards the narrow gap.

A uniform angle t becomes phi by the Moebius map of the unit circle ::

    exp(i phi) = (w + a) / (1 + conj(a) w),   w = exp(i t)

For a circular gap 1 - e cos(phi) and a = e / (1 + sqrt(1 - e^2)) this is the Sommerfeld
substitution, with the phase fixed so that it is smooth through e = 0.  Under tilt `a` is the mean
over both ends of the bearing.  The grid moves with the journal, so its motion is part of the exact
tangent.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel

Floats = NDArray[np.float64]

#: Rows of a ring of points: functions of phi, the metric dphi/dt, and for each of the four
#: coordinates q_k the motion of the point dphi/dq_k and the change of the metric dlog(m)/dq_k; of a bore with
#: grooves the part of the metric that is none.
COS, SIN, METRIC, MOTION, STRETCHING, LAND, RING_ROWS = 0, 1, 2, 3, 7, 11, 12


@inner_kernel
def _grading_of(ex: float, ey: float, most: float, a: Floats, da: Floats) -> None:
    """Map parameter of one eccentricity, a = e g(|e|^2), and its derivative (2, 2).

    The eccentricity saturates smoothly below 1, e (1 + |e|^32)^(-1/32), so that the grid stays
    regular while asperities overlap; its square goes in with the factor `most`, of at most 1.
    """
    square = ex * ex + ey * ey
    power = square**15
    large = power * square
    mu = (1.0 + large) ** (-1.0 / 32.0)
    dmu = -0.5 * mu * power / (1.0 + large)
    tau = most * (square * mu * mu)
    dtau = most * (mu * mu + 2.0 * square * mu * dmu)
    root = np.sqrt(1.0 - tau)
    g = mu / (1.0 + root)
    dg = dmu / (1.0 + root) + mu * dtau / (2.0 * root * (1.0 + root) ** 2)
    a[0] = ex * g
    a[1] = ey * g
    da[0, 0] = g + 2.0 * dg * ex * ex
    da[0, 1] = 2.0 * dg * ex * ey
    da[1, 0] = da[0, 1]
    da[1, 1] = g + 2.0 * dg * ey * ey


@inner_kernel
def grade(q: Floats, most: float, a: Floats, da: Floats, part: Floats) -> None:
    """Map parameter of a tilted journal and its derivative.

    Parameters
    ----------
    q : ndarray, shape (4,)
        Dimensionless position (x, y, tilt_x, tilt_y): the centre at z lies at (x + tilt_y z, y - tilt_x z).
    most : float
        1; less where eccentricities beyond 1 are usual, as seen from an arc of a bore.
    a, da : ndarray, shape (2,), (2, 4)
        Results: a and da/dq.
    part : ndarray, shape (3, 2)
        Work space.
    """
    a[:] = 0.0
    da[:] = 0.0
    for end in (-1.0, 1.0):
        _grading_of(q[0] + end * q[3], q[1] - end * q[2], most, part[0], part[1:])
        for i in range(2):
            a[i] += 0.5 * part[0, i]
            da[i, 0] += 0.5 * part[1 + i, 0]
            da[i, 1] += 0.5 * part[1 + i, 1]
            da[i, 2] -= 0.5 * end * part[1 + i, 1]
            da[i, 3] += 0.5 * end * part[1 + i, 0]


@inner_kernel
def sharpen(more: float, a: Floats, da: Floats) -> None:
    """Grade more strongly: map on with the parameter ``more a``, which stays a map of the circle.

    The maps of a and of b = more a in the same direction make that of (a + b) / (1 + a b).
    """
    square = a[0] * a[0] + a[1] * a[1]
    below = 1.0 / (1.0 + more * square)
    for k in range(da.shape[1]):
        bend = 2.0 * more * below * (a[0] * da[0, k] + a[1] * da[1, k])
        for i in range(2):
            da[i, k] = (1.0 + more) * below * (da[i, k] - bend * a[i])
    a *= (1.0 + more) * below


@inner_kernel
def place(circle: Floats, a: Floats, da: Floats, coordinates: int, ring: Floats) -> None:
    """Place a ring of points.

    Parameters
    ----------
    circle : ndarray, shape (2, m)
        cos t, sin t of the uniform points.
    a, da : ndarray
        From `grade`.
    coordinates : int
        For how many of the coordinates the motion is wanted: 4, or 2 for an aligned journal.
    ring : ndarray, shape (RING_ROWS, m)
        Result.
    """
    ax, ay = a[0], a[1]
    rest = 1.0 - ax * ax - ay * ay
    cos, sin, metric = ring[COS], ring[SIN], ring[METRIC]
    for i in range(circle.shape[1]):
        wx = circle[0, i]
        wy = circle[1, i]
        bx = wx + ax
        by = wy + ay
        inverse = 1.0 / (bx * bx + by * by)
        # (w + a)/(1 + conj(a) w) = b^2 conj(w)/|b|^2
        real = bx * bx - by * by
        imaginary = 2.0 * bx * by
        cos[i] = (real * wx + imaginary * wy) * inverse
        sin[i] = (imaginary * wx - real * wy) * inverse
        metric[i] = rest * inverse
    for k in range(coordinates):
        ux, uy = 2.0 * da[0, k], 2.0 * da[1, k]
        common = -(ax * ux + ay * uy) / rest
        motion, stretching = ring[MOTION + k], ring[STRETCHING + k]
        for i in range(circle.shape[1]):
            bx = circle[0, i] + ax
            by = circle[1, i] + ay
            inverse = 1.0 / (bx * bx + by * by)
            motion[i] = (bx * uy - by * ux) * inverse
            stretching[i] = common - (bx * ux + by * uy) * inverse
