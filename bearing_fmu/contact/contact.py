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

from bearing_fmu.bore.bore import Bore
from bearing_fmu.contact.slice import NODES, POINTS, WEIGHTS, add_slice
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.scales import Scales

Floats = NDArray[np.float64]

CREEP = 1e-3


@inner_kernel
def sliding_sense(speed: float, radius: float) -> float:
    """Smooth sign of the journal's surface speed."""
    u = speed * radius
    return u / np.sqrt(u * u + CREEP * CREEP)


@inner_kernel
def add_aligned(bore: Bore, scales: Scales, table: Floats, q: Floats, grip: float, result: Floats) -> None:
    """Add the contact over the aligned gap; parameters as in `add_tilted`."""
    if bore is None:
        add_slice(bore, 0, scales, table, q[0], q[1], 0.0, scales.width, grip, result)
    else:
        for pad in range(bore.shift.shape[0]):
            ex, ey = (
                q[0] + scales.clearance * bore.shift[pad, 0],
                q[1] + scales.clearance * bore.shift[pad, 1],
            )
            add_slice(bore, pad, scales, table, ex, ey, 0.0, scales.width, grip, result)


@inner_kernel
def add_tilted(bore: Bore, scales: Scales, table: Floats, q: Floats, grip: float, result: Floats) -> None:
    """Add the contact over the tilted gap.

    Parameters
    ----------
    bore : Bore
        The bore.
    q : ndarray, shape (4,)
        Position of the journal, m and rad.
    scales, table, grip, result
        As in `add_slice`.
    """
    if bore is None:
        _add_reach(bore, 0, scales, table, q[0], q[1], q, grip, result)
    else:
        for pad in range(bore.shift.shape[0]):
            x, y = q[0] + scales.clearance * bore.shift[pad, 0], q[1] + scales.clearance * bore.shift[pad, 1]
            _add_reach(bore, pad, scales, table, x, y, q, grip, result)


@inner_kernel
def _add_reach(
    bore: Bore,
    pad: int,
    scales: Scales,
    table: Floats,
    x: float,
    y: float,
    q: Floats,
    grip: float,
    result: Floats,
) -> None:
    """Add the contact of one arc, whose centre sees the middle of the journal at x, y."""
    half = 0.5 * scales.width
    # e(z)^2 = square + 2 mixed z + tilt z^2 = first^2 bounds the contact.
    square = x * x + y * y
    mixed = x * q[3] - y * q[2]
    tilt = q[2] * q[2] + q[3] * q[3]
    reach = scales.contact_first * scales.contact_first
    ends_left = square - 2.0 * mixed * half + tilt * half * half > reach
    ends_right = square + 2.0 * mixed * half + tilt * half * half > reach
    if not (ends_left or ends_right):
        return
    root = mixed * mixed - tilt * (square - reach)
    if tilt == 0.0 or root <= 0.0:
        _add_interval(bore, pad, scales, table, x, y, q, -half, half, grip, result)
        return
    root = np.sqrt(root)
    # The stable pair of roots of tilt z^2 + 2 mixed z + (square - reach).
    pivot = -(mixed + root) if mixed >= 0.0 else root - mixed
    z1, z2 = pivot / tilt, (square - reach) / pivot if pivot != 0.0 else 0.0
    low, high = min(z1, z2), max(z1, z2)
    if high <= -half or low >= half:
        _add_interval(bore, pad, scales, table, x, y, q, -half, half, grip, result)
        return
    if ends_left:
        _add_interval(bore, pad, scales, table, x, y, q, -half, low, grip, result)
    if ends_right:
        _add_interval(bore, pad, scales, table, x, y, q, high, half, grip, result)


@inner_kernel
def _add_interval(
    bore: Bore,
    pad: int,
    scales: Scales,
    table: Floats,
    x: float,
    y: float,
    q: Floats,
    left: float,
    right: float,
    grip: float,
    result: Floats,
) -> None:
    """Gauss-Legendre over one interval of contact."""
    length = right - left
    for i in range(POINTS):
        z = left + length * NODES[i]
        add_slice(bore, pad, scales, table, x + q[3] * z, y - q[2] * z, z, length * WEIGHTS[i], grip, result)
