"""Where the film holds a pad in balance.

The pad has no mass, and friction on it no lever about the pivot: the force of film and asperities passes
through the pivot, and presses on its spring::

    F t = 0,    -F n = w / compliance        t across, n towards the pivot

Within a step dt the velocity of the pad follows from the trapezoidal rule, velocity = rate (place - anchor)
with rate = 2/dt and anchor = place_then + velocity_then dt/2; at rest the rate is 0.

The moment F t falls as a pad tilts towards d, from a pad that is wide open behind its pivot to one that
touches there; between these bounds its root is bracketed, and found by Newton's method with the exact
tangent, or by bisection where that leaves the bracket.  Of several roots, as where a feed pressure presses a
pad's leading edge to the journal, the one with the smallest film at its trailing edge counts at rest, and the
next in motion.  Where the film carries nothing, the moment vanishes over a range of tilts: at rest such a pad
takes the one at which it would begin to carry; in motion it goes on as it moved until the film takes hold of
it.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.outputs import OUT_C, OUT_K, OUTPUTS
from bearing_fmu.status import NOT_CONVERGED, NOT_FINITE, OK
from bearing_fmu.tilting.pad import Pad

Floats = NDArray[np.float64]

ROUNDS = 200
#: Force across the pivot that is left, over the force of the pad; the tangent takes it away in the end.
BALANCED = 1e-8
_NARROW = 1e-14
_SHARES = (0.1, 0.15, 0.22, 0.33, 0.5, 0.75)  # of the way between the bounds


class Balance:
    """A pad at one state of the journal.

    Parameters
    ----------
    pad : Pad
        The pad.
    inputs : ndarray, shape (17,)
        Of the port.
    offset : ndarray, shape (4,)
        Of the bearing.
    rate : float
        See above.
    anchor : (float, float)
        Of d and w.
    nothing : float
        Force that counts as none, N.

    Attributes
    ----------
    out : ndarray, shape (58,)
        What the film of the pad has written last.
    """

    def __init__(
        self,
        pad: Pad,
        inputs: Floats,
        offset: Floats,
        rate: float,
        anchor: tuple[float, float],
        nothing: float,
    ) -> None:
        self.pad, self.rate, self.anchor = pad, rate, anchor
        self.out = np.empty(OUTPUTS)
        self._nothing = nothing
        self._sense = 1.0 if inputs[16] >= 0.0 else -1.0
        self._inputs, self._offset = inputs.copy(), offset
        self._x, self._y, self._vx, self._vy = inputs[[0, 1, 4, 5]].tolist()
        self._q = (inputs[:4] - inputs[8:12] - offset).tolist()
        if not pad.film.solver.tilts:
            self._q[2:] = 0.0, 0.0

    def settle(self, d: float, w: float, data: tuple[Any, ...]) -> tuple[int, float, float]:
        """Find the place of the pad.

        Parameters
        ----------
        d, w : float
            Where the search starts, m.
        data : tuple
            What the kernel of the pad's film takes.

        Returns
        -------
        status : int
            A code of `FilmStatus`.
        d, w : float
            The place, at which `out` was written.
        """
        if self.pad.compliance == 0.0:
            status, d = self._tilt(d, 0.0, data)
            return status, d, 0.0
        clearance, spring = self.pad.clearance, 1.0 / self.pad.compliance
        low, high = self.pad.least_recess(self._q), math.inf
        if not w > low:
            w = low + 0.1 * clearance
        for _ in range(ROUNDS):
            status, d = self._tilt(d, w, data)
            if status != OK:
                return status, d, w
            across, along = self.pad.axes
            missing = self._force(along) - spring * w
            narrow = high - low < _NARROW * clearance
            if narrow or abs(missing) <= BALANCED * abs(spring * w) + self._nothing:
                return OK, d, w
            low, high = (max(low, w), high) if missing > 0.0 else (low, min(high, w))
            held = self._slope(across, across)
            turned = self._slope(along, across) * self._slope(across, along) / held if held > 0.0 else 0.0
            new = w + missing / (self._slope(along, along) - turned + spring)
            if not low < new < high:
                new = 0.5 * (low + high) if high < math.inf else w + 0.5 * clearance
            w = new
        return NOT_CONVERGED, d, w

    def _tilt(self, d: float, w: float, data: tuple[Any, ...]) -> tuple[int, float]:
        """Find d at a w."""
        low, high = self.pad.bounds(self._q, w)
        if not low < high:
            return self.pad.closed, d
        if self.rate == 0.0:
            low, high = self._bracket(low, high, w, data)
        if self.rate == 0.0 or not low < d < high:
            d = 0.5 * (low + high)
        across = self.pad.axes[0]
        for _ in range(ROUNDS):
            status = self._evaluate(d, w, data)
            if status == NOT_FINITE:
                return status, d
            step = math.inf
            if status != OK:  # at a bound, but for rounding
                forth = d < 0.5 * (low + high)
            else:
                moment, size = self._force(across), math.hypot(self.out[0], self.out[1])
                carries = size > self._nothing
                if carries and abs(moment) <= BALANCED * size:
                    return OK, d
                if not carries and (self.rate > 0.0 or self._sense * moment < 0.0):
                    return OK, d
                forth = moment > 0.0 if carries else self._sense > 0.0
                slope = self._slope(across, across) if carries else 0.0
                step = moment / slope if slope > 0.0 else math.inf
            low, high = (d, high) if forth else (low, d)
            if high - low < _NARROW * self.pad.clearance and status == OK:
                return OK, d
            d = d + step if low < d + step < high else 0.5 * (low + high)
        return NOT_CONVERGED, d

    def _bracket(self, low: float, high: float, w: float, data: tuple[Any, ...]) -> tuple[float, float]:
        """Bounds of the first root from where the trailing edge touches."""
        edge, other = (high, low) if self._sense > 0.0 else (low, high)
        before = edge
        for share in _SHARES:
            d = edge + share * (other - edge)
            status = self._evaluate(d, w, data)
            if status == OK and not self._sense * self._force(self.pad.axes[0]) < 0.0:
                return min(d, before), max(d, before)
            before = d
        return min(other, before), max(other, before)

    def _evaluate(self, d: float, w: float, data: tuple[Any, ...]) -> int:
        """The film of the pad at a place."""
        (tx, ty), (nx, ny) = self.pad.axes
        inputs, rate = self._inputs, self.rate
        fast_d, fast_w = rate * (d - self.anchor[0]), rate * (w - self.anchor[1])
        inputs[0], inputs[1] = self._x + d * tx + w * nx, self._y + d * ty + w * ny
        inputs[4], inputs[5] = self._vx + fast_d * tx + fast_w * nx, self._vy + fast_d * ty + fast_w * ny
        return int(self.pad.film.solver.kernel(inputs, self._offset, self.out, *data))

    def _force(self, axis: tuple[float, float]) -> float:
        """Force on the journal along an axis of the pad."""
        return float(axis[0] * self.out[0] + axis[1] * self.out[1])

    def _slope(self, axis: tuple[float, float], moved: tuple[float, float]) -> float:
        """Its decrease in the step with the place along an axis."""
        (x, y), out, rate = moved, self.out, self.rate
        fx = (out[OUT_K] + rate * out[OUT_C]) * x + (out[OUT_K + 1] + rate * out[OUT_C + 1]) * y
        fy = (out[OUT_K + 4] + rate * out[OUT_C + 4]) * x + (out[OUT_K + 5] + rate * out[OUT_C + 5]) * y
        return float(axis[0] * fx + axis[1] * fy)
