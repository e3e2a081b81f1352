"""What film, contact and outputs ask the bore.

To the kernels a plain bore is None, any other one its `Pads`.  numba drops the branch of the other kind when
it compiles, so that a plain bore costs nothing.

Lengths are over the clearance, tilts times half the width over the clearance.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.pads import Pads, pads, place_pads
from bearing_fmu.kernels.compiled import inner_kernel, kernel, stage
from bearing_fmu.kernels.grid import COS, LAND, METRIC, MOTION, SIN, grade, place, sharpen
from fmus.port.bore import Arc

Floats = NDArray[np.float64]
Bore: TypeAlias = Pads | None


def bore_of(arcs: tuple[Arc, ...], columns: int) -> Bore:
    """What the kernels know of a bore, for films of `columns`."""
    return pads(arcs, columns) if arcs else None


@kernel
def least_gap(bore: Bore, q: Floats) -> tuple[float, float, float]:
    """Least gap over the film, its position, and the least gap at the mid-plane.

    At one angle the gap is linear over z, so that the least gap lies at an end.

    Parameters
    ----------
    bore : Bore
        The bore.
    q : ndarray, shape (4,)
        Position.

    Returns
    -------
    least, z, centre : float
        z over half the width, 0 for an aligned journal.
    """
    centre = gap_around(bore, q[0], q[1])
    left = gap_around(bore, q[0] - q[3], q[1] + q[2])
    right = gap_around(bore, q[0] + q[3], q[1] - q[2])
    if q[2] == 0.0 and q[3] == 0.0:
        return centre, 0.0, centre
    if left < right:
        return left, -1.0, centre
    return right, 1.0, centre


@inner_kernel
def gap_around(bore: Bore, ex: float, ey: float) -> float:
    """Least gap around the circumference at one z."""
    if bore is None:
        return 1.0 - np.hypot(ex, ey)
    least = np.inf
    for pad in range(bore.shift.shape[0]):
        x, y = ex + bore.shift[pad, 0], ey + bore.shift[pad, 1]
        (c0, s0), (c1, s1) = bore.edges[pad, 0], bore.edges[pad, 1]
        least = min(least, 1.0 - x * c0 - y * s0, 1.0 - x * c1 - y * s1)
        if is_on(bore, pad, np.arctan2(y, x)):
            least = min(least, 1.0 - np.hypot(x, y))
    return least


@inner_kernel
def is_on(bore: Pads, pad: int, angle: float) -> bool:
    """Whether an arc covers an angle."""
    turned = (angle - bore.ends[pad, 0]) / (2.0 * np.pi)
    return 2.0 * np.pi * (turned - np.floor(turned)) <= bore.ends[pad, 1] - bore.ends[pad, 0]


@inner_kernel
def relative_eccentricity(bore: Bore, q: Floats, centre: float) -> float:
    """Eccentricity at the mid-plane, where the least gap is `centre`."""
    if bore is None:
        return 1.0 - centre
    return np.hypot(q[0], q[1])


@inner_kernel
def place_rings(
    bore: Bore, circle: Floats, q: Floats, coordinates: int, part: float, grading: Floats, rings: Floats
) -> None:
    """Place columns and faces.

    Parameters
    ----------
    bore, q
        As in `least_gap`.
    circle : ndarray, shape (2, 2, m)
        Columns and faces; cos and sin of the uniform angle.
    coordinates : int
        For how many of the coordinates the motion is wanted: 4, or 2 for an aligned journal.
    part : float
        Of the usual grading of a plain bore, 1, or less where the pressure lies in the wide gap; above 1 what
        it exceeds 1 by grades on.
    grading : ndarray, shape (7, 4)
        Work space.
    rings : ndarray, shape (2, RING_ROWS, m)
        Result, see `kernels.grid`.
    """
    if bore is None:
        a, da = grading[0, :2], grading[1:3]
        grade(q, 1.0, a, da, grading[3:, :2])
        if part > 1.0:
            sharpen(part - 1.0, a, da)
        elif part != 1.0:
            a *= part
            da *= part
        for side in range(2):
            place(circle[side], a, da, coordinates, rings[side])
    else:
        place_pads(bore, q, coordinates, grading, rings)


@inner_kernel
def fill_gap(bore: Bore, side: int, ex: float, ey: float, ring: Floats, gap: Floats) -> None:
    """Gap at one z, at the columns (side 0) or the faces (1)."""
    cos, sin = ring[COS], ring[SIN]
    if bore is None:
        for i in range(cos.shape[0]):
            gap[i] = 1.0 - ex * cos[i] - ey * sin[i]
    else:
        for i in range(cos.shape[0]):
            x, y = ex + bore.centre[side, 0, i], ey + bore.centre[side, 1, i]
            gap[i] = 1.0 - bore.inside[side, i] * (x * cos[i] + y * sin[i])


@inner_kernel
def deepen(bore: Bore, side: int, z: float, gap: Floats) -> None:
    """Add the depth of pockets to the gap at one z over half the width."""
    if bore is not None:
        for i in range(bore.reach.shape[1]):
            if abs(z) <= bore.reach[side, i]:
                gap[i] += bore.deep[side, i]


@inner_kernel
def fill_gap_change(
    bore: Bore, side: int, ex: float, ey: float, fc: float, fs: float, k: int, ring: Floats, change: Floats
) -> None:
    """Change at a fixed angle, fc cos(phi) + fs sin(phi), and what the motion of the grid with q_k adds."""
    cos, sin, motion = ring[COS], ring[SIN], ring[MOTION + k]
    if bore is None:
        for i in range(change.shape[0]):
            change[i] = fc * cos[i] + fs * sin[i] + (ex * sin[i] - ey * cos[i]) * motion[i]
    else:
        for i in range(change.shape[0]):
            turn = gap_turn(bore, side, ex, ey, ring, i)
            change[i] = bore.inside[side, i] * (fc * cos[i] + fs * sin[i]) + turn * motion[i]


@inner_kernel
def gap_turn(bore: Bore, side: int, ex: float, ey: float, ring: Floats, i: int) -> float:
    """dH/dphi at one z and point."""
    if bore is None:
        return ex * ring[SIN, i] - ey * ring[COS, i]
    return (ex + bore.centre[side, 0, i]) * ring[SIN, i] - (ey + bore.centre[side, 1, i]) * ring[COS, i]


@stage
def land(bore: Bore, ring: Floats) -> Floats:
    """Metric of that part of the columns' cells which lies on the bore and not in grooves."""
    if bore is None:
        return ring[METRIC]
    return ring[LAND]
