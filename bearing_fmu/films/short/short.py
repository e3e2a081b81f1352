"""V3: the short bearing (the paper's Eq. 16-17) in closed form.

Without the flow around the circumference, with v the velocity and everything as in `reynolds`::

    p = (b/d)^2 / 2 (1 - z^2) (a cos(phi) - b sin(phi)) / H^3,   a = speed y + 2 v_x,  b = speed x - 2 v_y

Half the circumference carries pressure; integrated over it the force is Capone's (1986, 1991), here in
a form without the degenerate branches of the published one.  An ambient pressure over the cavity
changes where the film ends; see `short_flooded`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.gap import ROUGH_LIMIT, flow_gap
from bearing_fmu.films.short.flooded import CIRCLE, RING, SMALL, flooded
from bearing_fmu.films.short.turbulent import turbulent_peak, turbulent_shear
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import COS, SIN
from bearing_fmu.result import DAMPING, FLOW, PEAK, SHEAR, STIFFNESS

Floats = NDArray[np.float64]

_SAMPLES = 12
_angles = 2.0 * np.pi / _SAMPLES * np.arange(_SAMPLES)
_COS, _SIN = np.cos(_angles), np.sin(_angles)


@inner_kernel
def capone(x: float, y: float, a: float, b: float, force: Floats, slope: Floats) -> None:
    """Force of the half film and its derivatives.

    Parameters
    ----------
    x, y : float
        Position over the clearance, x^2 + y^2 < 1.
    a, b : float
        As in the module's text, 1/s.
    force : ndarray, shape (2,)
        Result over eta R b (R/C)^2 (b/d)^2, 1/s.
    slope : ndarray, shape (2, 4)
        Result: derivatives by x, y, a, b.  Where a = b = 0 off the centre (whirl at half the speed) the
        film is empty and the force has a corner; finite one-sided values are returned.
    """
    rest = 1.0 - x * x - y * y
    root = np.sqrt(rest)
    rho = np.hypot(a, b)
    inverse = 1.0 / rho if rho > 0.0 else 0.0
    ca, sa = (a * inverse, b * inverse) if rho > 0.0 else (0.0, 1.0)
    p = x * ca - y * sa
    q = -(x * sa + y * ca)
    open_ = 1.0 / (1.0 - q * q)
    g = 2.0 / root * (0.5 * np.pi + np.arctan(p / root))
    v = (2.0 + p * g) / rest
    s = q * open_
    g_p = 2.0 * open_
    g_r = -(0.5 * g + p * open_) / rest
    v_p = (g + p * g_p) / rest
    v_r = (p * g_r - v) / rest
    s_q = (1.0 + q * q) * open_ * open_
    force[0] = -(3.0 * x * v * rho + a * g + 2.0 * b * s) / rest
    force[1] = -(3.0 * y * v * rho - b * g + 2.0 * a * s) / rest
    for k in range(4):
        dx, dy = (1.0 if k == 0 else 0.0), (1.0 if k == 1 else 0.0)
        da, db = (1.0 if k == 2 else 0.0), (1.0 if k == 3 else 0.0)
        drho = ca * da + sa * db
        dp = dx * ca - dy * sa + (x * da - y * db - p * drho) * inverse
        dq = -(dx * sa + dy * ca) - (x * db + y * da + q * drho) * inverse
        dr = -2.0 * (x * dx + y * dy)
        dg = g_p * dp + g_r * dr
        dv = v_p * dp + v_r * dr
        ds = s_q * dq
        part_x = 3.0 * (dx * v * rho + x * dv * rho + x * v * drho)
        part_y = 3.0 * (dy * v * rho + y * dv * rho + y * v * drho)
        part_x += da * g + a * dg + 2.0 * (db * s + b * ds)
        part_y += 2.0 * (da * s + a * ds) - db * g - b * dg
        slope[0, k] = -(part_x + force[0] * dr) / rest
        slope[1, k] = -(part_y + force[1] * dr) / rest


@inner_kernel
def largest_pressure(x: float, y: float, a: float, b: float) -> float:
    """Largest value of (a cos(phi) - b sin(phi)) / H^3 around the circumference.

    In Sommerfeld's angle t, measured from the narrowest gap, it is a trigonometric polynomial of
    degree three; the largest of twelve samples is refined by Newton's method.
    """
    e = np.hypot(x, y)
    nx, ny = (x / e, y / e) if e > 0.0 else (1.0, 0.0)
    root = np.sqrt(1.0 - e * e)
    along, across = a * nx - b * ny, -(a * ny + b * nx) * root
    t, best = 0.0, -np.inf
    for i in range(_SAMPLES):
        value = (along * (_COS[i] + e) + across * _SIN[i]) * (1.0 + e * _COS[i]) ** 2
        if value > best:
            best, t = value, 2.0 * np.pi / _SAMPLES * i
    for _ in range(4):
        c, s = np.cos(t), np.sin(t)
        f, f1, f2 = along * (c + e) + across * s, across * c - along * s, -(along * c + across * s)
        w, w1, w2 = 1.0 + e * c, -e * s, -e * c
        best = max(best, f * w * w)
        slope = f1 * w + 2.0 * f * w1
        curve = f2 * w + 3.0 * f1 * w1 + 2.0 * f * w2
        if not curve < 0.0:
            break
        t -= min(max(slope / curve, -0.3), 0.3)
    return best / (root * root) ** 3


@inner_kernel
def effective_state(q: Floats, v: Floats, sigma: float, state: Floats, jacobian: Floats) -> None:
    """State of a smooth short bearing whose least gap is the gap open to the oil.

    The eccentricity is replaced by 1 - T(1 - e), radially, and the velocity goes with it; the state
    itself while the least gap exceeds the reach of the asperities.

    Parameters
    ----------
    q, v : ndarray, shape (2,) or longer
        Position and velocity over the clearance.
    sigma : float
        Roughness over clearance.
    state : ndarray, shape (4,)
        Result: effective position and velocity.
    jacobian : ndarray, shape (4, 4)
        Result: derivative by position and velocity.
    """
    jacobian[:] = 0.0
    e = np.hypot(q[0], q[1])
    if 1.0 - e >= ROUGH_LIMIT * sigma:
        for i in range(2):
            state[i], state[2 + i] = q[i], v[i]
            jacobian[i, i] = 1.0
            jacobian[2 + i, 2 + i] = 1.0
        return
    t, t1, t2 = flow_gap(1.0 - e, sigma)
    ratio = (1.0 - t) / e
    change = t1 - ratio
    nx, ny = q[0] / e, q[1] / e
    radial = nx * v[0] + ny * v[1]
    for i in range(2):
        ni = nx if i == 0 else ny
        state[i] = ratio * q[i]
        state[2 + i] = ratio * v[i] + change * ni * radial
        for k in range(2):
            nk = nx if k == 0 else ny
            same = 1.0 if i == k else 0.0
            jacobian[i, k] = ratio * same + change * ni * nk
            jacobian[2 + i, 2 + k] = jacobian[i, k]
            jacobian[2 + i, k] = (
                change / e * nk * v[i]
                - (t2 + change / e) * nk * ni * radial
                + change / e * ((same - ni * nk) * radial + ni * (v[k] - radial * nk))
            )


@inner_kernel
def solve_short(
    q: Floats,
    v: Floats,
    speed: float,
    ambient: float,
    sigma: float,
    reynolds: float,
    ratio: float,
    film: Floats,
    result: Floats,
) -> None:
    """Wrench and tangent of the short bearing.

    Parameters
    ----------
    q, v, speed, ambient, sigma, reynolds, result
        As in `reynolds.solve_pressure`.
    ratio : float
        (b/d)^2.
    film : ndarray
        Work space from `short_flooded.short_film`.
    """
    result[:] = 0.0
    small = film[SMALL + 1]
    state, jacobian = small[:4], small[4:20].reshape(4, 4)
    force, slope = small[20:22], small[22:30].reshape(2, 4)
    effective_state(q, v, sigma, state, jacobian)
    x, y = state[0], state[1]
    a, b = speed * y + 2.0 * state[2], speed * x - 2.0 * state[3]
    if ambient > 0.0 or reynolds > 0.0:
        unit = 1.0
        flooded(x, y, a, b, ambient, 0.5 * ratio, reynolds, film, force, slope)
    else:
        unit = ratio / 3.0
        capone(x, y, a, b, force, slope)
    for i in range(2):
        result[i] = unit * force[i]
        by_x, by_y = slope[i, 0] + speed * slope[i, 3], slope[i, 1] + speed * slope[i, 2]
        by_vx, by_vy = 2.0 * slope[i, 2], -2.0 * slope[i, 3]
        for k in range(2):
            by_place = by_x * jacobian[0, k] + by_y * jacobian[1, k]
            by_rate = by_vx * jacobian[2, k] + by_vy * jacobian[3, k]
            result[STIFFNESS + 4 * i + k] = unit * (by_place + by_rate)
            result[DAMPING + 4 * i + k] = unit * (by_vx * jacobian[2, 2 + k] + by_vy * jacobian[3, 2 + k])
    if reynolds > 0.0:
        circle, ring = film[CIRCLE : CIRCLE + 2], film[RING:]
        result[SHEAR] = turbulent_shear(x, y, reynolds, circle, film[SMALL], ring)
        peak = turbulent_peak(x, y, a, b, reynolds, ring[COS], ring[SIN])
    else:
        result[SHEAR] = 4.0 * np.pi / np.sqrt(1.0 - x * x - y * y)
        peak = largest_pressure(x, y, a, b)
    result[PEAK] = ambient + 0.5 * ratio * max(peak, 0.0)
    # what the wedge drags in over half the circumference, whatever resists it
    result[FLOW] = 4.0 * np.sqrt(a * a + b * b)
