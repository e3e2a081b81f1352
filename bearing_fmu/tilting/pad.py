"""A tilting pad: the film on it, and how far it can tilt.

A pad turns about the axial line of its pivot and, where that gives way, recedes.  To the first order of the
clearance over the radius both move the centre of its arc: by d = tilt x radius across the direction of the
pivot, and by w away from the journal.  The film on it depends on how the journal stands and moves against the
pad, and on no other pad.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from bearing_fmu.bore.pads import FEWEST
from bearing_fmu.film import Film, Solver
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.status import FilmStatus
from fmus.port.bore import TURN, Arc, to_text

_LEAST = 16  # columns that a film has
_PIECES = 0.25 * math.pi  # of the groove, see `bore.pads`


class Pad:
    """One pad with the film on it.

    Parameters
    ----------
    solver : Solver
        Of the film.
    parameters : BearingParameters
        Of the whole bearing.
    arc : Arc
        The pad, with its pivot at `towards`.
    cells : int
        Of its film around the circumference.

    Attributes
    ----------
    film : Film
        In a bore of this arc alone, without solid friction.  What surrounds the arc holds the feed pressure,
        which around a whole turn has no force: so the force is that of the film over the feed pressure, which
        presses on the back of the pad.
    axes : pair of (float, float)
        How the journal moves as seen from the pad with d and with w.
    closed : int
        Status of a gap that is closed at the pivot.
    """

    def __init__(self, solver: Solver, parameters: BearingParameters, arc: Arc, cells: int) -> None:
        behind = math.ceil((TURN - arc.length) / _PIECES)
        own = replace(
            parameters,
            bore=to_text((replace(arc, compliance=None),)),
            columns=max(cells, FEWEST, _LEAST - behind) + behind,
            friction=0.0,
        )
        self.arc = arc
        self.film = Film(solver, own)
        self.clearance, self.half = parameters.clearance, 0.5 * parameters.width
        self.compliance = arc.compliance or 0.0
        x, y = math.cos(arc.towards), math.sin(arc.towards)
        self.axes = (-y, x), (-x, -y)
        self.closed = FilmStatus.TOO_DEEP if parameters.has_contact else FilmStatus.GAP_CLOSED
        self._most = 1.0 - parameters.deepest_gap / parameters.clearance
        behind_it = (arc.towards - arc.start) % TURN
        self._reach = behind_it, arc.length - behind_it

    def bounds(self, q: Sequence[float], recess: float) -> tuple[float, float]:
        """Between which d the gap is open, m; the lower one is above where it is closed at the pivot.

        Parameters
        ----------
        q : sequence of float, shape (4,)
            Position of the journal in the bore, m and rad.
        recess : float
            w, m.
        """
        low, high = -math.inf, math.inf
        for z in (0.0,) if q[2] == 0.0 and q[3] == 0.0 else (-self.half, self.half):
            near, beside = self._seen(q, z, recess)
            if near >= self._most:
                return math.inf, -math.inf
            low = max(low, -beside - _room(near, self._most, self._reach[0]))
            high = min(high, -beside + _room(near, self._most, self._reach[1]))
        return self.clearance * low, self.clearance * high

    def least_recess(self, q: Sequence[float]) -> float:
        """Least w at which the gap is open at the pivot, m."""
        most = max(self._seen(q, z, 0.0)[0] for z in (-self.half, self.half))
        return self.clearance * (most - self._most)

    def _seen(self, q: Sequence[float], z: float, recess: float) -> tuple[float, float]:
        """Where the journal stands as seen from the pad without tilt: towards its pivot and across."""
        x, y = q[0] + q[3] * z, q[1] - q[2] * z
        (tx, ty), (nx, ny) = self.axes
        near = self.arc.preload - (nx * x + ny * y + recess) / self.clearance
        return near, (tx * x + ty * y) / self.clearance


def _room(near: float, most: float, reach: float) -> float:
    """How far a pad tilts on one side of its pivot: least (most - near cos t) / sin t for t to `reach`."""
    if abs(near) < most and math.acos(near / most) <= reach:
        return math.sqrt(most * most - near * near)
    return (most - near * math.cos(reach)) / math.sin(reach)
