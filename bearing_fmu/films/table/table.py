"""The film of the aligned journal in a plain bore, looked up.

With lengths over the clearance the pressure follows from the position q and the drive ``D = 2 v - w x q``,
w the speed, and is proportional to D (Guembel's condition or Reynolds', no ambient pressure).  So the force
is |D| times a function of three numbers, of which a plain bore drops one; what tends to infinity or zero
towards the wall is divided out.  With e = |q|, T the open gap at the narrowest place and
r = sqrt(T (2 - T)), which is sqrt(1 - e^2) of smooth surfaces,

    D' = D along q, r D across it        a = e / (1 + r), psi = angle of q over that of D'
    F  = -S (D' turned by t) / (r^3 (k + r^2)),   k = (b/d)^2,   log S and t of a table over (a, psi)

The drive across is shortened as the pressure zone is, which is Sommerfeld's substitution; ``r^3`` is how a
film grows that is narrow against the width, ``r^5`` a short one.  A journal that leaves the wall has a
hundred-thousandth of the force of one that meets it, hence the logarithm.  (a, psi) are polar coordinates of
a disc on which all is smooth, its middle included.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.gap import flow_gap
from bearing_fmu.films.table.spline import blend
from bearing_fmu.kernels.compiled import inner_kernel, kernel, stage
from bearing_fmu.result import DAMPING, FLOW, PEAK, SHEAR, STIFFNESS

Floats = NDArray[np.float64]

#: Parts of a table: logarithm of the force, its angle, logarithm of the largest pressure, shear integral, and
#: side flow over |D'|.
FORCE, TURN, SUMMIT, RUB, RUN, PARTS = range(6)
_NEAR = 1e-9


class Table(NamedTuple):
    """What the kernel takes."""

    coefficients: Floats  #: (n + 2, m + 3, PARTS)
    step: float  #: of a
    last: float  #: largest a
    work: Floats  #: (7, PARTS) work space


@kernel
def narrowing(e: float, sigma: float) -> tuple[float, float, float, float]:
    """Root r of the narrowest gap, coordinate a, and their derivatives by the eccentricity."""
    t, t1, _ = flow_gap(1.0 - e, sigma)
    r = np.sqrt(t * (2.0 - t))
    dr = -(1.0 - t) * t1 / r
    a = e / (1.0 + r)
    return r, a, dr, (1.0 - a * dr) / (1.0 + r)


@inner_kernel
def _look_up(table: Table, a: float, psi: float, found: Floats, by_a: Floats, by_psi: Floats) -> None:
    """Parts of the table and their derivatives."""
    coefficients, work = table.coefficients, table.work
    m = coefficients.shape[1] - 3
    place = min(a, table.last) / table.step
    i = min(int(place), coefficients.shape[0] - 4) if a < table.last else coefficients.shape[0] - 4
    turn = psi * m / (2.0 * np.pi)
    down = np.floor(turn)
    blend(place - i, work[0], work[1])
    blend(turn - down, work[2], work[3])
    j = int(down) % m
    found[:], by_a[:], by_psi[:] = 0.0, 0.0, 0.0
    for k in range(4):
        here, ahead = work[0, k], work[1, k] / table.step
        for n in range(4):
            value, by_radius, by_angle = here * work[2, n], ahead * work[2, n], here * work[3, n]
            for part in range(PARTS):
                c = coefficients[i + k, j + n, part]
                found[part] += value * c
                by_a[part] += by_radius * c
                by_psi[part] += by_angle * c
    for part in range(PARTS):
        by_a[part] *= 1.0 if a < table.last else 0.0
        by_psi[part] *= m / (2.0 * np.pi)


@stage
def solve_table(
    table: Table, q: Floats, v: Floats, speed: float, sigma: float, ratio: float, result: Floats
) -> None:
    """Wrench and tangent; parameters as in `short.solve_short`."""
    result[:] = 0.0
    x, y = q[0], q[1]
    if np.hypot(x, y) < _NEAR:
        x, y = _NEAR, 0.0
    e = np.hypot(x, y)
    dx, dy = 2.0 * v[0] + speed * y, 2.0 * v[1] - speed * x
    r, a, r_e, a_e = narrowing(e, sigma)
    # (1 - r)/e^2, whose first form is that of smooth surfaces
    if e < 0.5:
        m, m_e = 1.0 / (1.0 + r), -r_e / (1.0 + r) ** 2
    else:
        m, m_e = (1.0 - r) / (e * e), -r_e / (e * e) - 2.0 * (1.0 - r) / e**3
    mixed = x * dx + y * dy
    sx, sy = r * dx + m * mixed * x, r * dy + m * mixed * y
    square = sx * sx + sy * sy
    # without drive the force has a corner; finite one-sided derivatives are returned
    psi = np.arctan2(sx * y - sy * x, sx * x + sy * y) if square > 0.0 else np.arctan2(y, x)
    inverse = 1.0 / square if square > 0.0 else 0.0
    found, by_a, by_psi = table.work[4], table.work[5], table.work[6]
    _look_up(table, a, psi, found, by_a, by_psi)
    wall = ratio + r * r
    size = np.exp(found[FORCE]) / (r * r * r * wall)
    c, s = np.cos(found[TURN]), np.sin(found[TURN])
    fx, fy = size * (c * sx - s * sy), size * (c * sy + s * sx)
    result[0], result[1] = -fx, -fy
    for k in range(4):
        qx, qy = (1.0 if k == 0 else 0.0), (1.0 if k == 1 else 0.0)
        if k < 2:  # the drive goes with the position
            vx, vy = speed * qy, -speed * qx
        else:
            vx, vy = (2.0 if k == 2 else 0.0), (2.0 if k == 3 else 0.0)
        de = (x * qx + y * qy) / e
        dr, dm = r_e * de, m_e * de
        bent = dm * mixed + m * (qx * dx + qy * dy + x * vx + y * vy)
        tx = dr * dx + r * vx + bent * x + m * mixed * qx
        ty = dr * dy + r * vy + bent * y + m * mixed * qy
        turned = (x * qy - y * qx) / (e * e) - (sx * ty - sy * tx) * inverse
        grown = by_a[FORCE] * a_e * de + by_psi[FORCE] * turned - dr * (3.0 / r + 2.0 * r / wall)
        swung = by_a[TURN] * a_e * de + by_psi[TURN] * turned
        at = STIFFNESS + k if k < 2 else DAMPING + k - 2
        result[at] = -(grown * fx - swung * fy + size * (c * tx - s * ty))
        result[at + 4] = -(grown * fy + swung * fx + size * (c * ty + s * tx))
    result[PEAK] = np.sqrt(square) * np.exp(found[SUMMIT]) / (r**4 * wall)
    result[SHEAR] = found[RUB] / r
    result[FLOW] = np.sqrt(square) * found[RUN]
