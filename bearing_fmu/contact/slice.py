"""Contact of one slice: of the whole circumference by a table, of an arc by quadrature over its angle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.bore.pads import Pads
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.scales import Scales

Floats = NDArray[np.float64]

POINTS = 24
_gauss = np.polynomial.legendre.leggauss(POINTS)
NODES, WEIGHTS = 0.5 * (_gauss[0] + 1.0), 0.5 * _gauss[1]

# Result of the contact: wrench (4), dF/dq (16), integral of the contact pressure, area in which solids really
# touch, area in which the softer metal yields, largest pressure.
FORCE, FORCE_SLOPE, LOAD, AREA, WIPED, PRESSURE, CONTACT_RESULTS = 0, 4, 20, 21, 22, 23, 24


@inner_kernel
def add_slice(
    bore: Bore,
    pad: int,
    scales: Scales,
    table: Floats,
    ex: float,
    ey: float,
    z: float,
    weight: float,
    grip: float,
    result: Floats,
) -> None:
    """Add the contact of one slice.

    Parameters
    ----------
    bore, pad
        The bore, and which of its arcs.
    scales, table
        Constants of the bearing, and coefficients of its `SliceTable`.
    ex, ey, z, weight : float
        Position as seen from the centre of the arc; axial position and width of the slice, m.
    grip : float
        Friction coefficient times sense of sliding.
    result : ndarray, shape (CONTACT_RESULTS,)
        To which is added.
    """
    if bore is None:
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
        c = table[index, 2]
        result[AREA] += weight * (c[0] + s * (c[1] + s * (c[2] + s * c[3])))
        if e > scales.yields:
            result[WIPED] += weight * 2.0 * scales.radius * np.arccos(scales.yields / e)
        nx, ny = ex / e, ey / e
        dx, dy = nx - grip * ny, ny + grip * nx
        fx, fy = -force * dx, -force * dy
        # d(N n)/de = N' n n' + N/e (1 - n n'), then the friction turns it.
        even = force / e
        kxx, kyy = slope * nx * nx + even * ny * ny, slope * ny * ny + even * nx * nx
        kxy = (slope - even) * nx * ny
        jxx, jxy = -(kxx - grip * kxy), -(kxy - grip * kyy)
        jyx, jyy = -(kxy + grip * kxx), -(kyy + grip * kxy)
    else:
        fx, fy, jxx, jxy, jyx, jyy, load, touching, wiped = _of_arc(bore, pad, scales, table, ex, ey, grip)
        fx, fy, jxx, jxy, jyx, jyy = (
            weight * fx,
            weight * fy,
            weight * jxx,
            weight * jxy,
            weight * jyx,
            weight * jyy,
        )
        result[LOAD] += weight * load
        result[AREA] += weight * touching
        result[WIPED] += weight * wiped
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


@inner_kernel
def _of_arc(
    bore: Pads, pad: int, scales: Scales, table: Floats, ex: float, ey: float, grip: float
) -> tuple[float, float, float, float, float, float, float, float, float]:
    """Of an arc force (2), its derivatives by the position (2, 2), load, width that touches and that yields.

    Asperities reach each other over at most two parts of it.
    """
    fx, fy, jxx, jxy, jyx, jyy, load, touching, wiped = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    half = np.arccos(min(scales.contact_first / np.hypot(ex, ey), 1.0))
    start, length = bore.ends[pad, 0], bore.ends[pad, 1] - bore.ends[pad, 0]
    low = np.arctan2(ey, ex) - half - start
    low -= 2.0 * np.pi * np.floor(low / (2.0 * np.pi))
    for turn in range(2):
        left = max(low - 2.0 * np.pi * turn, 0.0)
        right = min(low - 2.0 * np.pi * turn + 2.0 * half, length)
        for i in range(POINTS if right > left else 0):
            angle = start + left + (right - left) * NODES[i]
            c, s = np.cos(angle), np.sin(angle)
            place = max(ex * c + ey * s - scales.contact_first, 0.0) / scales.contact_step
            index = min(int(place), table.shape[0] - 1)
            r = place - index
            part = table[index, 0]
            share = (right - left) * WEIGHTS[i]
            force = share * (part[0] + r * (part[1] + r * (part[2] + r * part[3])))
            pressed = min(force / (share * scales.radius * scales.hardness), 1e60)
            touching += share * scales.radius * pressed / (1.0 + pressed**4) ** 0.25
            wiped += share * scales.radius if pressed >= 1.0 else 0.0
            slope = share * (part[1] + r * (2.0 * part[2] + 3.0 * r * part[3])) / scales.contact_step
            dx, dy = c - grip * s, s + grip * c
            load += force
            fx -= force * dx
            fy -= force * dy
            jxx -= slope * dx * c
            jxy -= slope * dx * s
            jyx -= slope * dy * c
            jyy -= slope * dy * s
    return fx, fy, jxx, jxy, jyx, jyy, load, touching, wiped


@inner_kernel
def largest_pressure(bore: Bore, scales: Scales, table: Floats, gap: float) -> float:
    """Contact pressure of the least gap, both SI."""
    place = (scales.clearance - gap - scales.contact_first) / scales.contact_step
    if not place > 0.0:
        return 0.0
    index = min(int(place), table.shape[0] - 1)
    s, c = place - index, table[index, table.shape[1] - 1]
    value = c[0] + s * (c[1] + s * (c[2] + s * c[3]))
    return value if bore is None else value / scales.radius
