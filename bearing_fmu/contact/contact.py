"""Solid contact of journal and bore: wrench, stiffness, load and friction power.

At one axial position z the contact force per width is ::

    f(z) = -N(e) (n + mu s t),   e = |e(z)|, n = e(z)/e, t = n turned by 90 degrees from x to y

with N(e) from `greenwood_tripp`.  The journal surface slides in the direction of rotation, so the
friction opposes it; s = U / sqrt(U^2 + U_0^2) with the surface speed U = speed R and U_0 = 1 mm/s takes
the sign smoothly through standstill.  The translation of the journal, three orders smaller than the
surface speed, is left out of the sliding, so the contact has no damping matrix of its own.

Over z the contact is confined to the ends of the bearing where e(z) exceeds the reach of the
asperities: at most two intervals, known exactly since e(z)^2 is quadratic.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.scales import Scales

Floats = NDArray[np.float64]

CREEP = 1e-3
POINTS = 24
_gauss = np.polynomial.legendre.leggauss(POINTS)
NODES, WEIGHTS = 0.5 * (_gauss[0] + 1.0), 0.5 * _gauss[1]

# Result of the contact: wrench (4), dF/dq (16), integral of the contact pressure.
FORCE, FORCE_SLOPE, LOAD, CONTACT_RESULTS = 0, 4, 20, 21


@inner_kernel
def sliding_sense(speed: float, radius: float) -> float:
    """Smooth sign of the journal's surface speed."""
    u = speed * radius
    return u / np.sqrt(u * u + CREEP * CREEP)


@inner_kernel
def add_slice(
    scales: Scales, table: Floats, ex: float, ey: float, z: float, weight: float, grip: float, result: Floats
) -> None:
    """Add the contact of one slice.

    Parameters
    ----------
    scales : record of SCALES
        The bearing.
    table : ndarray, shape (intervals, 2, 4)
        Coefficients of its `SliceTable`.
    ex, ey : float
        Eccentricity, m.
    z, weight : float
        Axial position and width of the slice, m.
    grip : float
        Friction coefficient times sense of sliding.
    result : ndarray, shape (CONTACT_RESULTS,)
        To which is added.
    """
    e = np.hypot(ex, ey)
    place = (e - scales.contact_first) / scales.contact_step
    if not place > 0.0:
        return
    index = min(int(place), table.shape[0] - 1)
    s = place - index
    c = table[index, 0]
    force = weight * (c[0] + s * (c[1] + s * (c[2] + s * c[3])))
    slope = weight * (c[1] + s * (2.0 * c[2] + 3.0 * s * c[3])) / scales.contact_step
    c = table[index, 1]
    result[LOAD] += weight * (c[0] + s * (c[1] + s * (c[2] + s * c[3])))
    nx, ny = ex / e, ey / e
    dx, dy = nx - grip * ny, ny + grip * nx
    fx, fy = -force * dx, -force * dy
    # d(N n)/de = N' n n' + N/e (1 - n n'), then the friction turns it.
    even = force / e
    kxx, kyy = slope * nx * nx + even * ny * ny, slope * ny * ny + even * nx * nx
    kxy = (slope - even) * nx * ny
    jxx, jxy = -(kxx - grip * kxy), -(kxy - grip * kyy)
    jyx, jyy = -(kxy + grip * kxx), -(kyy + grip * kxy)
    result[0] += fx
    result[1] += fy
    result[2] -= z * fy
    result[3] += z * fx
    # e depends on q as (x + tilt_y z, y - tilt_x z).
    for row in range(4):
        a = jxx if row == 0 else (jyx if row == 1 else (-z * jyx if row == 2 else z * jxx))
        b = jxy if row == 0 else (jyy if row == 1 else (-z * jyy if row == 2 else z * jxy))
        at = FORCE_SLOPE + 4 * row
        result[at] += a
        result[at + 1] += b
        result[at + 2] -= z * b
        result[at + 3] += z * a


@stage
def add_aligned(scales: Scales, table: Floats, q: Floats, grip: float, result: Floats) -> None:
    """Add the contact over the aligned gap; parameters as in `add_tilted`."""
    add_slice(scales, table, q[0], q[1], 0.0, scales.width, grip, result)


@inner_kernel
def add_tilted(scales: Scales, table: Floats, q: Floats, grip: float, result: Floats) -> None:
    """Add the contact over the tilted gap.

    Parameters
    ----------
    q : ndarray, shape (4,)
        Position of the journal, m and rad.
    scales, table, grip, result
        As in `add_slice`.
    """
    half = 0.5 * scales.width
    # e(z)^2 = square + 2 mixed z + tilt z^2 = first^2 bounds the contact.
    square = q[0] * q[0] + q[1] * q[1]
    mixed = q[0] * q[3] - q[1] * q[2]
    tilt = q[2] * q[2] + q[3] * q[3]
    reach = scales.contact_first * scales.contact_first
    ends_left = square - 2.0 * mixed * half + tilt * half * half > reach
    ends_right = square + 2.0 * mixed * half + tilt * half * half > reach
    if not (ends_left or ends_right):
        return
    root = mixed * mixed - tilt * (square - reach)
    if tilt == 0.0 or root <= 0.0:
        _add_interval(scales, table, q, -half, half, grip, result)
        return
    root = np.sqrt(root)
    # The stable pair of roots of tilt z^2 + 2 mixed z + (square - reach).
    pivot = -(mixed + root) if mixed >= 0.0 else root - mixed
    z1, z2 = pivot / tilt, (square - reach) / pivot if pivot != 0.0 else 0.0
    low, high = min(z1, z2), max(z1, z2)
    if high <= -half or low >= half:
        _add_interval(scales, table, q, -half, half, grip, result)
        return
    if ends_left:
        _add_interval(scales, table, q, -half, low, grip, result)
    if ends_right:
        _add_interval(scales, table, q, high, half, grip, result)


@inner_kernel
def _add_interval(
    scales: Scales, table: Floats, q: Floats, left: float, right: float, grip: float, result: Floats
) -> None:
    """Gauss-Legendre over one interval of contact."""
    length = right - left
    for i in range(POINTS):
        z = left + length * NODES[i]
        add_slice(scales, table, q[0] + q[3] * z, q[1] - q[2] * z, z, length * WEIGHTS[i], grip, result)
