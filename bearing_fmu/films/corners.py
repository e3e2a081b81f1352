"""States in which the usual grid or quadrature of a film does not serve, and how much of another it takes.

With H = 1 - x cos(phi) - y sin(phi) the pressure is driven by ::

    -(speed dH/dphi + 2 dH/dt) = u cos(phi) + w sin(phi),   (u, w) = (2 x' + speed y, 2 y' - speed x)

and is positive, by and large, where this is.  The grid is graded to the narrow gap; where (u, w) points away
from it, the journal *leaves* the wall, and what is positive lies in the wide gap.  Under tilt (u, w) changes
over z; where it *turns round* between the ends, the positive part ends along lines of constant z.  Where the
gap opens steeply from a narrow end, the pressure *crowds* there, which its largest value alone suffers from.
The shares go smoothly from 0 to 1 with the state, so that the wrench does; their change is in its tangent.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.result import DAMPING, RESULTS, STIFFNESS

Floats = NDArray[np.float64]

#: Part of the usual grading with which a journal is followed that leaves the wall; on a layer.
SPREAD, LAYERED_SPREAD = 0.4, 0.3
#: Where its share begins and ends, of the cosine between (u, w) and the way off the wall; on a layer, where
#: the grid has no more columns than the usual one.
AWAY, LAYERED_AWAY = (0.1, 0.4), (0.35, 0.85)
#: Likewise, of that share: the largest pressure, which has no tangent, goes over sooner than the wrench.
SOON = (0.0, 0.5)
# Likewise, of the squared eccentricity; of how much more of the drive is the tilt's,
# (tilt^2 - centre^2) / (tilt^2 + centre^2).
_FAR = (0.25, 0.5)
_TILTED = (0.65, 0.85)
# Likewise, of the gap at the narrower end over its slope along the axis, within which the peak lies so close
# to the end that few rows do not resolve it.
_CROWDED = (0.2, 0.35)
# Of that gap in roughnesses: below the first one asperities bear.
_APART = (3.0, 6.0)
# Of the cosine, and what it takes off the grading of the grid on which that peak is looked for.
_LEADS, _LESS = (0.05, 0.2), 0.2


@inner_kernel
def rise(x: float, ends: tuple[float, float]) -> tuple[float, float]:
    """Smooth step from 0 to 1 between two ends, and its derivative."""
    s = (x - ends[0]) / (ends[1] - ends[0])
    if s <= 0.0:
        return 0.0, 0.0
    if s >= 1.0:
        return 1.0, 0.0
    return s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / (ends[1] - ends[0])


@inner_kernel
def leaving(q: Floats, v: Floats, speed: float, ends: tuple[float, float], change: Floats) -> float:
    """How far a journal leaves the wall, 0 to 1; its change by q (4) and v (4) where it is above 0.

    It begins and ends at the `ends` of the cosine, see `AWAY`.
    """
    along = 2.0 * (v[0] * q[0] + v[1] * q[1])
    square = q[0] * q[0] + q[1] * q[1]
    if along >= 0.0 or square <= _FAR[0]:
        return 0.0
    u, w = 2.0 * v[0] + speed * q[1], 2.0 * v[1] - speed * q[0]
    drive = u * u + w * w
    cosine = -along / np.sqrt(drive * square)
    away, by_cosine = rise(cosine, ends)
    far, by_square = rise(square, _FAR)
    if away == 0.0:
        return 0.0
    scale = cosine / along
    change[:] = 0.0
    for k in range(2):
        turned = -speed * w if k == 0 else speed * u
        own = 2.0 * v[k] * scale - cosine * (turned / drive + q[k] / square)
        change[k] = by_cosine * own * far + away * by_square * 2.0 * q[k]
        change[4 + k] = far * by_cosine * (2.0 * q[k] * scale - cosine * 2.0 * (u if k == 0 else w) / drive)
    return away * far


@inner_kernel
def turning_round(q: Floats, v: Floats, speed: float, change: Floats) -> float:
    """How far the drive turns round between the ends, 0 to 1; its change by q (4) and v (4)."""
    u, w = 2.0 * v[0] + speed * q[1], 2.0 * v[1] - speed * q[0]
    a, b = 2.0 * v[3] - speed * q[2], -2.0 * v[2] - speed * q[3]
    centre, tilt = u * u + w * w, a * a + b * b
    if tilt <= centre:
        return 0.0
    whole = tilt + centre
    share, slope = rise((tilt - centre) / whole, _TILTED)
    if share > 0.0:
        by_centre, by_tilt = -4.0 * slope * tilt / (whole * whole), 4.0 * slope * centre / (whole * whole)
        change[0], change[1] = -by_centre * w * speed, by_centre * u * speed
        change[2], change[3] = -by_tilt * a * speed, -by_tilt * b * speed
        change[4], change[5] = 2.0 * by_centre * u, 2.0 * by_centre * w
        change[6], change[7] = -2.0 * by_tilt * b, 2.0 * by_tilt * a
    return share


@inner_kernel
def crowded(q: Floats, v: Floats, speed: float, sigma: float) -> tuple[float, float]:
    """How far the pressure crowds at the narrower end, 0 to 1, and the part of the grading that serves.

    Not where solids of roughness `sigma` touch there: a rigid wall's peak is of no real metal.
    """
    end = 1.0 if (q[0] * q[3] - q[1] * q[2]) >= 0.0 else -1.0
    x, y = q[0] + end * q[3], q[1] - end * q[2]
    e = np.sqrt(x * x + y * y)
    slope = end * (x * q[3] - y * q[2])
    gap = max(1.0 - e, 0.0)
    apart = rise(gap / sigma, _APART)[0] if sigma > 0.0 else 1.0
    if slope <= 0.0 or apart == 0.0 or gap * e >= _CROWDED[1] * slope:
        return 0.0, 1.0
    ux, uy = v[0] + end * v[3], v[1] - end * v[2]
    u, w = 2.0 * ux + speed * y, 2.0 * uy - speed * x
    drive = u * u + w * w
    away = -2.0 * (ux * x + uy * y) / (np.sqrt(drive) * e) if drive > 0.0 else 0.0
    return apart * (1.0 - rise(gap * e / slope, _CROWDED)[0]), 1.0 - _LESS * rise(away, _LEADS)[0]


@inner_kernel
def add_change(step: Floats, change: Floats, result: Floats) -> None:
    """Add what a changing share, `change`, of a `step` of the wrench adds to its tangent."""
    for i in range(4):
        for k in range(4):
            result[STIFFNESS + 4 * i + k] += step[i] * change[k]
            result[DAMPING + 4 * i + k] += step[i] * change[4 + k]


@inner_kernel
def mix(usual: Floats, share: float, change: Floats, result: Floats) -> None:
    """Keep a share of a result, with its change by q and v, and take the rest from the `usual` one."""
    for i in range(RESULTS):
        step = result[i] - usual[i]
        result[i] = usual[i] + share * step
        usual[i] = step
    add_change(usual, change, result)
