"""A tilting pad: what the kernels know of it, and how far it can tilt.

A pad turns about the axial line of its pivot and, where that gives way, recedes.  To the first order of the
clearance over the radius both move the centre of its arc: by d = tilt x radius across the direction of the
pivot, and by w away from the journal.  The film on it depends on how the journal stands and moves against the
pad, and on no other pad.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.pads import FEWEST, Pads, cells_of, pads
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.scales import Scales
from fmus.port.bore import TURN, Arc, to_text

Floats = NDArray[np.float64]
Pivot: TypeAlias = Floats
"""Of one pad: how the journal moves as seen from it with d and with w, x and y of each; compliance in m/N,
preload, and the angles that it reaches behind and before its pivot."""

ACROSS, TOWARDS, COMPLIANCE, PRELOAD, BEHIND, BEFORE, PIVOT = 0, 2, 4, 5, 6, 7, 8

_LEAST = 16  # columns that a film has
_PIECE = 2.0  # rad, between two columns beside the pad: little is to be seen there


def pivots(arcs: Sequence[Arc]) -> Floats:
    """The pivots of tilting pads, shape (pads, PIVOT)."""
    rows = []
    for arc in arcs:
        x, y = math.cos(arc.towards), math.sin(arc.towards)
        behind = (arc.towards - arc.start) % TURN
        rows.append((-y, x, -x, -y, arc.compliance or 0.0, arc.preload, behind, arc.length - behind))
    return np.array(rows)


def alone(parameters: BearingParameters) -> tuple[list[BearingParameters], Pads]:
    """Each pad as a bearing of its own, without solid friction, and their bores together.

    What surrounds a pad holds the feed pressure, which around a whole turn has no force: so the force is that
    of the film over the feed pressure, which presses on the back of the pad.  All have as many columns, so
    that one work space serves them.
    """
    arcs = [replace(arc, compliance=None) for arc in parameters.arcs]
    cells = max(cells_of(parameters.arcs, parameters.columns)[0])
    pieces = max(math.ceil((TURN - arc.length) / _PIECE) for arc in arcs)
    cells = max(cells, FEWEST, _LEAST - pieces)
    own = [replace(parameters, bore=to_text((arc,)), columns=cells + pieces, friction=0.0) for arc in arcs]
    bores = [pads((arc,), cells + pieces, ([cells], [pieces])) for arc in arcs]
    return own, Pads(*(np.stack(field) for field in zip(*bores, strict=True)))


@inner_kernel
def bounds(pivot: Pivot, scales: Scales, q: Floats, recess: float, least: float) -> tuple[float, float]:
    """Between which d no gap is below the least, m; the lower one is above where one at the pivot is.

    Parameters
    ----------
    pivot : ndarray, shape (PIVOT,)
        The pad.
    q : ndarray, shape (4,)
        Position of the journal in the bore, m and rad.
    recess : float
        w, m.
    least : float
        Gap over the clearance.
    """
    low, high, most = -np.inf, np.inf, 1.0 - least
    for end in (-0.5, 0.5):
        near, beside = _seen(pivot, scales, q, end * scales.width, recess)
        if near >= most:
            return np.inf, -np.inf
        low = max(low, -beside - _room(near, most, pivot[BEHIND]))
        high = min(high, -beside + _room(near, most, pivot[BEFORE]))
    return scales.clearance * low, scales.clearance * high


@inner_kernel
def least_recess(pivot: Pivot, scales: Scales, q: Floats) -> float:
    """Least w at which the gap is open at the pivot, m."""
    left, _ = _seen(pivot, scales, q, -0.5 * scales.width, 0.0)
    right, _ = _seen(pivot, scales, q, 0.5 * scales.width, 0.0)
    return scales.clearance * (max(left, right) - 1.0 + scales.deepest)


@inner_kernel
def _seen(pivot: Pivot, scales: Scales, q: Floats, z: float, recess: float) -> tuple[float, float]:
    """Where the journal stands as seen from the pad without tilt: towards its pivot and across."""
    x, y = q[0] + q[3] * z, q[1] - q[2] * z
    along = pivot[TOWARDS] * x + pivot[TOWARDS + 1] * y + recess
    across = pivot[ACROSS] * x + pivot[ACROSS + 1] * y
    return pivot[PRELOAD] - along / scales.clearance, across / scales.clearance


@inner_kernel
def _room(near: float, most: float, reach: float) -> float:
    """How far a pad tilts on one side of its pivot: least (most - near cos t) / sin t for t to `reach`."""
    if abs(near) < most and np.arccos(near / most) <= reach:
        return np.sqrt(most * most - near * near)
    return (most - near * np.cos(reach)) / np.sin(reach)
