"""V3 with an ambient pressure over the cavity: the half film no longer ends where the wedge turns.

The paper's Eq. 17 adds the ambient pressure, p = p_amb + k (1 - z^2) g, k = (b/d)^2 / 2, with
g = (a cos(phi) - b sin(phi)) / H^3 as in `short`.  Where -k g exceeds p_amb the pressure is negative up to
z^2 = 1 - p_amb / (-k g) and zeroed there.  The integral over z is closed, the one around the
circumference takes the trapezoidal rule on the graded grid.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.short.turbulent import half_film
from bearing_fmu.films.turbulence import ALONG, LAMINAR_POWER, flow_share
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import COS, METRIC, MOTION, RING_ROWS, SIN, STRETCHING, grade, place

Floats = NDArray[np.float64]

# Rows of the work space: small arrays, uniform circle, Gauss and Legendre's rule, arc, graded ring.
SMALL, CIRCLE, RULE, ARC, RING = 0, 2, 4, 6, 8


def short_film(columns: int) -> Floats:
    """Work space of the short bearing with `columns` points around the circumference."""
    points = max(2 * columns, 48)
    film = np.zeros((RING + RING_ROWS, points))
    angle = 2.0 * np.pi / points * np.arange(points)
    film[CIRCLE], film[CIRCLE + 1] = np.cos(angle), np.sin(angle)
    node, weight = np.polynomial.legendre.leggauss(points)
    film[RULE], film[RULE + 1] = 0.5 * (node + 1.0), 0.5 * weight
    return film


@inner_kernel
def axial_integral(g: float, ambient: float) -> tuple[float, float]:
    """Integral over z in [-1, 1] of the positive part of ambient + (1 - z^2) g, and its derivative by g."""
    if g >= -ambient:
        return 2.0 * ambient + 4.0 / 3.0 * g, 4.0 / 3.0
    edge = np.sqrt(1.0 + ambient / g)
    part = 2.0 / 3.0 * (1.0 - edge) ** 2
    return -part * g * (1.0 + 2.0 * edge), part * (2.0 + edge)


@inner_kernel
def flooded(
    x: float,
    y: float,
    a: float,
    b: float,
    ambient: float,
    k: float,
    reynolds: float,
    film: Floats,
    force: Floats,
    slope: Floats,
) -> None:
    """Force of the short bearing, flooded or turbulent, and its derivatives.

    Parameters
    ----------
    x, y, a, b : float
        As in `short.capone`.
    ambient : float
        Ambient pressure over 6 eta R^2 / C^2, 1/s.
    k : float
        (b/d)^2 / 2.
    reynolds : float
        As in `reynolds.solve_pressure`.
    film : ndarray
        Work space from `short_film`.
    force, slope : ndarray, shape (2,), (2, 4)
        Results over 6 eta R^3 b / (2 C^2): force and its derivatives by x, y, a, b.
    """
    small, ring = film[SMALL], film[RING:]
    position, grading = small[:4], small[4:6]
    derivative = small[6:14].reshape(2, 4)
    position[0], position[1], position[2], position[3] = x, y, 0.0, 0.0
    grade(position, 1.0, grading, derivative, small[14:20].reshape(3, 2))
    if ambient > 0.0:
        place(film[CIRCLE : CIRCLE + 2], grading, derivative, 2, ring)
    else:
        half_film(a, b, grading, derivative, film[RULE : RULE + 2], film[ARC : ARC + 2], ring)
    cell = 2.0 * np.pi / film.shape[1]
    force[:] = 0.0
    slope[:] = 0.0
    for i in range(film.shape[1]):
        c, s, weight = ring[COS, i], ring[SIN, i], -cell * ring[METRIC, i]
        inverse = 1.0 / (1.0 - x * c - y * s)
        cube = k * inverse * inverse * inverse
        wedge = a * c - b * s
        power = LAMINAR_POWER
        if reynolds > 0.0:
            share, less = flow_share(reynolds / inverse, ALONG)
            cube /= share
            power -= less
        steep = power * wedge * inverse * cube
        load, change = axial_integral(wedge * cube, ambient)
        force[0] += weight * load * c
        force[1] += weight * load * s
        turn = (-a * s - b * c) * cube - steep * (x * s - y * c)
        for j in range(2):
            move, stretch = ring[MOTION + j, i], ring[STRETCHING + j, i]
            by_place = change * (steep * (c if j == 0 else s) + turn * move)
            slope[0, j] += weight * (by_place * c + load * (c * stretch - s * move))
            slope[1, j] += weight * (by_place * s + load * (s * stretch + c * move))
        slope[0, 2] += weight * change * cube * c * c
        slope[1, 2] += weight * change * cube * c * s
        slope[0, 3] -= weight * change * cube * s * c
        slope[1, 3] -= weight * change * cube * s * s
