"""V3 with a turbulent film: the pressure of the short bearing grows with the resistance to the axial flow.

p = k (1 - z^2) g, g = (a cos(phi) - b sin(phi)) / H^3 times k_along / 12, see `bearing_fmu.films.turbulence`.
The integral around the circumference is no longer closed.  Without ambient pressure the film ends where the
wedge turns, and the integral takes Gauss and Legendre's rule over that half in Sommerfeld's angle, where the
integrand is smooth; the points need not move in the tangent, since it vanishes at both ends.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.turbulence import ALONG, drag, flow_share
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import COS, METRIC, MOTION, SIN, STRETCHING, grade, place

Floats = NDArray[np.float64]

_GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)
_HALVINGS = 20


@inner_kernel
def half_film(
    a: float, b: float, grading: Floats, derivative: Floats, rule: Floats, arc: Floats, ring: Floats
) -> None:
    """Place the points of the half that carries pressure.

    Parameters
    ----------
    a, b : float
        As in `short.capone`.
    grading, derivative : ndarray
        From `grade`.
    rule : ndarray, shape (2, m)
        Gauss and Legendre's nodes in [0, 1] and weights.
    arc : ndarray, shape (2, m)
        Work space.
    ring : ndarray, shape (RING_ROWS, m)
        Result, resting points; the metric holds their weights over 2 pi / m.
    """
    middle = np.arctan2(-b, a)
    first = _sommerfeld(middle - 0.5 * np.pi, grading)
    span = _sommerfeld(middle + 0.5 * np.pi, grading) - first
    span += 2.0 * np.pi if span <= 0.0 else 0.0
    points = arc.shape[1]
    for i in range(points):
        t = first + span * rule[0, i]
        arc[0, i], arc[1, i] = np.cos(t), np.sin(t)
    place(arc, grading, derivative, 0, ring)
    ring[MOTION : MOTION + 2] = 0.0
    ring[STRETCHING : STRETCHING + 2] = 0.0
    for i in range(points):
        ring[METRIC, i] *= span * rule[1, i] * points / (2.0 * np.pi)


@inner_kernel
def _sommerfeld(phi: float, grading: Floats) -> float:
    """Angle of the uniform circle that the map of `kernels.grid` takes to phi."""
    c, s, ax, ay = np.cos(phi), np.sin(phi), grading[0], grading[1]
    # (e^{i phi} - a) / (1 - conj(a) e^{i phi})
    dx, dy = 1.0 - (ax * c + ay * s), -(ax * s - ay * c)
    return np.arctan2((s - ay) * dx - (c - ax) * dy, (c - ax) * dx + (s - ay) * dy)


@inner_kernel
def turbulent_peak(
    x: float, y: float, a: float, b: float, reynolds: float, cos: Floats, sin: Floats
) -> float:
    """Largest g: the best of the points, then by golden section between its neighbours."""
    best, at = -np.inf, 0
    for i in range(cos.shape[0]):
        value = _wedge(x, y, a, b, reynolds, cos[i], sin[i])
        if value > best:
            best, at = value, i
    back, fore = at - 1 if at > 0 else cos.shape[0] - 1, at + 1 if at + 1 < cos.shape[0] else 0
    left = np.arctan2(sin[back], cos[back])
    width = np.arctan2(sin[fore], cos[fore]) - left
    width += 2.0 * np.pi if width < 0.0 else 0.0
    low, high = left, left + width
    for _ in range(_HALVINGS):
        p, q = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        one = _wedge(x, y, a, b, reynolds, np.cos(p), np.sin(p))
        two = _wedge(x, y, a, b, reynolds, np.cos(q), np.sin(q))
        best = max(best, one, two)
        low, high = (low, q) if one > two else (p, high)
    return best


@inner_kernel
def _wedge(x: float, y: float, a: float, b: float, reynolds: float, c: float, s: float) -> float:
    h = 1.0 - x * c - y * s
    return (a * c - b * s) / (h * h * h * flow_share(reynolds * h, ALONG)[0])


@inner_kernel
def turbulent_shear(
    x: float, y: float, reynolds: float, circle: Floats, small: Floats, ring: Floats
) -> float:
    """Integral of the drag over H, both over the film; `small` is work space of 20."""
    position, grading, derivative = small[:4], small[4:6], small[6:14].reshape(2, 4)
    position[0], position[1], position[2], position[3] = x, y, 0.0, 0.0
    grade(position, 1.0, grading, derivative, small[14:20].reshape(3, 2))
    place(circle, grading, derivative, 0, ring)
    total = 0.0
    for i in range(circle.shape[1]):
        h = 1.0 - x * ring[COS, i] - y * ring[SIN, i]
        total += ring[METRIC, i] / h * drag(reynolds * h)
    return 4.0 * np.pi / circle.shape[1] * total
