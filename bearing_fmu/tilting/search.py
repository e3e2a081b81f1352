"""Where the film holds a pad in balance, as a search that asks for one evaluation of the film after another.

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

As the journal goes away from a pad, the two roots of its moment meet, and behind this fold the film pushes it
open at every tilt: it flutters (Adams and Payandeh 1983).  At rest the force would jump there.  Instead a pad
is left where it is nearest to balance, and its force is taken in part, from all at the fold to none where the
force passes the pivot by an angle of `FLUTTERS`; so a load at which the pad neither carries nor not has a
position.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.outputs import OUT_C, OUT_K
from bearing_fmu.scales import Scales
from bearing_fmu.status import NOT_CONVERGED, NOT_FINITE, OK
from bearing_fmu.tilting.pad import ACROSS, COMPLIANCE, TOWARDS, Pivot, bounds, least_recess

Floats = NDArray[np.float64]

ROUNDS = 200
#: Force across the pivot that is left, over the force of the pad; the tangent takes it away in the end.
BALANCED = 1e-8
#: Angle between force and pivot, rad.
FLUTTERS = 0.02
_NARROW = 1e-14
_SHARES = (0.1, 0.15, 0.22, 0.33, 0.5, 0.75)  # of the way between the bounds
_GOLDEN, _SECTIONS = 0.5 * (math.sqrt(5.0) - 1.0), 24

#: What a search knows: place, share of the force that counts and its change with the angle;
D, W, SHARE, SLOPE = 0, 1, 2, 3
#: bounds of d and of w; what it does, and how often it did;
LOW, HIGH, LEAST, MOST, PHASE, COUNT, RECESSED = 4, 5, 6, 7, 8, 9, 10
#: the last place where it looked about at rest; the section with the summit, a place in it, the value there.
LAST, EDGE, OTHER, INNER, VALUE, SEARCH = 11, 12, 13, 14, 15, 16
_SCAN, _ROOT, _SUMMIT, _LEFT = 0.0, 1.0, 2.0, 3.0
#: Beside the codes of `FilmStatus`.
GO_ON = -1


class Seat(NamedTuple):
    """What a search goes by: the pad, the journal over it, and how both move."""

    pivot: Pivot
    scales: Scales
    q: Floats  #: (4,) position of the journal in the bore, m and rad
    rate: float  #: 2/dt, or 0 at rest
    sense: float  #: of the rotation
    nothing: float  #: force that counts as none, N


@inner_kernel
def begin(search: Floats, seat: Seat) -> int:
    """Begin at the place D, W; `GO_ON`, or a code of `FilmStatus`."""
    pivot, scales, q = seat.pivot, seat.scales, seat.q
    search[RECESSED] = 0.0
    if pivot[COMPLIANCE] == 0.0:
        search[W] = 0.0
    else:
        search[LEAST], search[MOST] = least_recess(pivot, scales, q), np.inf
        if not search[W] > search[LEAST]:
            search[W] = search[LEAST] + 0.1 * scales.clearance
    return _open(search, seat)


@inner_kernel
def _open(search: Floats, seat: Seat) -> int:
    """Begin to look for d at a w; as `begin`."""
    low, high = bounds(seat.pivot, seat.scales, seat.q, search[W], seat.scales.deepest)
    if not low < high:
        return seat.scales.closes
    search[LOW], search[HIGH], search[COUNT] = low, high, 0.0
    search[SHARE], search[SLOPE] = 1.0, 0.0
    if seat.rate > 0.0:
        search[PHASE] = _ROOT
        if not low < search[D] < high:
            search[D] = 0.5 * (low + high)
    else:
        search[PHASE] = _SCAN
        search[LAST] = high if seat.sense > 0.0 else low
        # between where the surfaces meet: how far asperities are pressed, and the bounds with them, goes with
        # their height, and where films are found does not
        near, far = bounds(seat.pivot, seat.scales, seat.q, search[W], max(0.0, seat.scales.deepest))
        if near < far:
            low, high = near, far
        search[EDGE], search[OTHER] = (high, low) if seat.sense > 0.0 else (low, high)
        search[D] = search[EDGE] + _SHARES[0] * (search[OTHER] - search[EDGE])
    return GO_ON


@inner_kernel
def proceed(search: Floats, status: int, out: Floats, seat: Seat) -> int:
    """Go on from what the film has written at the place.

    Parameters
    ----------
    search : ndarray, shape (SEARCH,)
        Holds the next place where it goes on.
    status : int
        Of the film.
    out : ndarray, shape (58,)
        Of the film, in the order of the port.
    seat : Seat
        As of `begin`.

    Returns
    -------
    int
        `GO_ON`, or a code of `FilmStatus`.
    """
    if status == NOT_FINITE:
        return status
    phase, pivot = search[PHASE], seat.pivot
    moment = pivot[ACROSS] * out[0] + pivot[ACROSS + 1] * out[1] if status == OK else 0.0
    size = np.hypot(out[0], out[1]) if status == OK else 0.0
    if phase == _SCAN:
        _scan(search, status, seat.sense * moment, size, seat)
        return GO_ON
    if phase == _SUMMIT:
        _climb(search, status, seat.sense * moment, size, seat.nothing)
        return GO_ON
    if phase == _ROOT:
        went = _root(search, status, moment, size, out, seat)
        if went != OK:
            return went
    return OK if pivot[COMPLIANCE] == 0.0 else _recede(search, out, seat)


@inner_kernel
def _scan(search: Floats, status: int, moment: float, size: float, seat: Seat) -> None:
    """From the trailing edge on, until the moment has passed zero."""
    d, count = search[D], int(search[COUNT])
    if status == OK and not moment < 0.0:
        if size > seat.nothing:
            _bracket(search, d, search[LAST])
            return
        search[PHASE], search[COUNT] = _SUMMIT, 0.0  # here is nothing, and whether before it is to be seen
        search[LAST] = search[OTHER] = d
        search[D] = d + _GOLDEN * (search[EDGE] - d)
    elif count + 1 == len(_SHARES):
        _bracket(search, search[LOW] if seat.sense > 0.0 else search[HIGH], d)
    else:
        search[LAST], search[COUNT] = d, search[COUNT] + 1.0
        search[D] = search[EDGE] + _SHARES[count + 1] * (search[OTHER] - search[EDGE])


@inner_kernel
def _climb(search: Floats, status: int, moment: float, size: float, nothing: float) -> None:
    """Look for where the moment is the least against the pad, by golden sections."""
    d, inner = search[D], search[INNER]
    value = moment / size if status == OK and size > nothing else -1.0
    if value >= 0.0:
        _bracket(search, d, search[EDGE])
        return
    search[COUNT] += 1.0
    if search[COUNT] == 1.0:
        search[INNER], search[VALUE] = d, value
    else:
        higher = value > search[VALUE]
        between = (d - search[EDGE]) * (inner - d) > 0.0  # on the side of the edge
        if higher == between:
            search[OTHER] = inner if higher else d
        else:
            search[EDGE] = inner if higher else d
        if higher:
            search[INNER], search[VALUE] = d, value
    if search[COUNT] < _SECTIONS:
        search[D] = search[EDGE] + search[OTHER] - search[INNER]
        return
    part = 1.0 + search[VALUE] / FLUTTERS
    if part > 0.0:
        search[SHARE], search[SLOPE] = part * part * (3.0 - 2.0 * part), -6.0 * part * (1.0 - part) / FLUTTERS
        search[PHASE], search[D] = _LEFT, search[INNER]
    else:
        _bracket(search, search[LAST], search[INNER])


@inner_kernel
def _bracket(search: Floats, here: float, there: float) -> None:
    """Go on with Newton's method between two places."""
    search[PHASE], search[COUNT] = _ROOT, 0.0
    search[LOW], search[HIGH] = min(here, there), max(here, there)
    search[D] = 0.5 * (here + there)


@inner_kernel
def _root(search: Floats, status: int, moment: float, size: float, out: Floats, seat: Seat) -> int:
    """Go on to the root of the moment; `GO_ON`, or a code of `FilmStatus`."""
    d, step, rate, sense = search[D], np.inf, seat.rate, seat.sense
    if status != OK:  # at a bound, but for rounding
        forth = d < 0.5 * (search[LOW] + search[HIGH])
    else:
        carries = size > seat.nothing
        if carries and abs(moment) <= BALANCED * size:
            return OK
        if not carries and (rate > 0.0 or sense * moment < 0.0):
            return OK
        forth = moment > 0.0 if carries else sense > 0.0
        slope = _slope(out, seat.pivot, ACROSS, ACROSS, rate) if carries else 0.0
        if slope > 0.0:
            step = moment / slope
    if forth:
        search[LOW] = d
    else:
        search[HIGH] = d
    if search[HIGH] - search[LOW] < _NARROW * seat.scales.clearance and status == OK:
        return OK
    search[COUNT] += 1.0
    if search[COUNT] >= ROUNDS:
        return NOT_CONVERGED
    inside = search[LOW] < d + step < search[HIGH]
    search[D] = d + step if inside else 0.5 * (search[LOW] + search[HIGH])
    return GO_ON


@inner_kernel
def _recede(search: Floats, out: Floats, seat: Seat) -> int:
    """Go on to the w at which force and spring are in balance, a balance of the moment at hand."""
    pivot, scales, rate = seat.pivot, seat.scales, seat.rate
    w, spring = search[W], 1.0 / pivot[COMPLIANCE]
    low, high = search[LEAST], search[MOST]
    force = pivot[TOWARDS] * out[0] + pivot[TOWARDS + 1] * out[1]
    missing = search[SHARE] * force - spring * w
    if high - low < _NARROW * scales.clearance or abs(missing) <= BALANCED * abs(spring * w) + seat.nothing:
        return OK
    search[RECESSED] += 1.0
    if search[RECESSED] >= ROUNDS:
        return NOT_CONVERGED
    if missing > 0.0:
        low = max(low, w)
    else:
        high = min(high, w)
    held, turned = _slope(out, pivot, ACROSS, ACROSS, rate), 0.0
    if held > 0.0 and search[SHARE] == 1.0:
        turned = _slope(out, pivot, TOWARDS, ACROSS, rate) * _slope(out, pivot, ACROSS, TOWARDS, rate) / held
    new = w + missing / (_slope(out, pivot, TOWARDS, TOWARDS, rate) - turned + spring)
    if not low < new < high:
        new = 0.5 * (low + high) if high < np.inf else w + 0.5 * scales.clearance
    search[W], search[LEAST], search[MOST] = new, low, high
    return _open(search, seat)


@inner_kernel
def _slope(out: Floats, pivot: Pivot, axis: int, moved: int, rate: float) -> float:
    """Decrease of the force along an axis in the step with the place along another."""
    x, y = pivot[moved], pivot[moved + 1]
    fx = (out[OUT_K] + rate * out[OUT_C]) * x + (out[OUT_K + 1] + rate * out[OUT_C + 1]) * y
    fy = (out[OUT_K + 4] + rate * out[OUT_C + 4]) * x + (out[OUT_K + 5] + rate * out[OUT_C + 5]) * y
    return pivot[axis] * fx + pivot[axis + 1] * fy
