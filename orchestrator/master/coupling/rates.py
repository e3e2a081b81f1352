"""How long each bearing may go on with its law: the arithmetic of `orchestrator.master.coupling.multirate`.

Arrays have a row a bearing.  What is known of a bearing is a row of `KNOWN` and K and C behind it; wrenches
are (4), tangents K and C by rows (32), motions q and v (8), laws F0, K, C (36).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import compiled, copy, inlined

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

LIGHT = 0.3
"""Share of the mean static load that is the least size."""

KNOWN = ("stands", "interval", "bend", "size", "span")
"""Columns of what is known of bearings.

stands : where they were evaluated last, in s;
interval : after which they are due, in s;
bend : relative defect of the last interval over the square of what moved the wrench in it, see `due_at`; at
    least `FADES` of that before;
size : largest force of late, in N;
span : how long the last interval was, in s; 0 before there was one. K and C at its start follow.
"""

STANDS, INTERVAL, BEND, SIZE, SPAN = range(len(KNOWN))
BEFORE = len(KNOWN)
WIDTH = BEFORE + 32

OWN = 0.3
"""Share of the tolerance that the defect over several steps may reach: of equal defects that of the longer
interval does more harm."""

CALM = 0.2
"""Share of that within which the defect, of second order, allows twice the interval."""

STIFFENS = 0.5
"""Bend that is expected at least, that of a force as the inverse of a gap, of what bends at all."""

LINEAR = 1e-3
"""Bend of what does not bend."""

FADES = 0.5
"""Share of the bend of the interval before that is expected still: a calm interval tells little of it."""

SHARE = 0.5
"""Share of the change with which a law meets a smooth wrench at the end; a third has its mean, but what is
stiff or strongly damped rests on the end."""

FELT = 0.3
"""Share of what a tangent misses that a bent law is taken to miss at least: not all of it was foreseen."""

MOST = 0.5
"""Change of a component of K or C over an interval, against itself, that is followed at most."""

SLACK = 0.12
"""Share of the largest force of late below which a film bears nothing."""

_SAME = 1e-6
"""Share by which intervals, forces, and of a step instants, differ that are the same but for rounding."""

_NOTHING = 1e-12
"""Relative change of a wrench that is none."""


@inlined
def _larger(size: float, largest: float) -> float:
    """The larger one; not a number where the first is none."""
    return size if size > largest or math.isnan(size) else largest


@inlined
def _magnitude(fx: float, fy: float, mx: float, my: float, lever: float) -> float:
    """Largest component of a wrench, moments over the lever; not a number where one is none."""
    largest = 0.0
    for size in (abs(fx), abs(fy), abs(mx) / lever, abs(my) / lever):
        largest = _larger(size, largest)
    return largest


@compiled
def bend_on(
    time: float,
    step: float,
    bends: bool,
    common: bool,
    rates: Array,
    again: Mask,
    wrenches: Array,
    tangents: Array,
    where: Array,
    laws: Array,
    changed: Mask,
    numbers: NDArray[np.intp],
) -> int:
    """Give bearings that stand at `time` laws for the intervals that begin there.

    A tangent misses what the wrench bends by within the interval h.  While the motion is smooth, K and C
    go on changing as they did over the interval before, by D a second.  Where the motion runs straight, a
    tangent ``K + D h / 2`` then meets the wrench at the end to third order, at no evaluation.  It
    stays a stiffness and a damping, which the rotor takes implicitly; the last defect, added as a force, was
    tried and does harm in contact.  Of the change of each component `MOST` of itself is followed at most.

    Parameters
    ----------
    time, step : float
        Start and length of the rotor's step in s.
    bends : bool
        Whether laws bend on.
    rates : ndarray (n, WIDTH)
        What is known; instants that are `time` but for rounding become `time`.
    common, again : bool, ndarray of bool (n,)
        Whether all are evaluated at the end of the step, and those that are in any case.
    wrenches, tangents, where : ndarray (n, 4), (n, 32), (n, 8)
        What bearings returned last, and the motion of journals in their housings where they did.
    laws : ndarray (n, 36)
        Of the rotor; those that change are overwritten.
    changed, numbers : ndarray (n,) of bool and of int
        Overwritten with which, and the first with their numbers; as many as are returned.
    """
    count = 0
    for b in range(len(rates)):
        changed[b] = False
        if not abs(rates[b, STANDS] - time) <= _SAME * step:
            continue
        rates[b, STANDS] = time
        span, ratio = rates[b, SPAN], 0.0
        if bends and span > 0.0:
            ratio = (step if common or again[b] else max(rates[b, INTERVAL], step)) / span
        for i in range(4):
            wrench = wrenches[b, i]
            for part in range(2):
                for j in range(4):
                    k = 16 * part + 4 * i + j
                    tangent = tangents[b, k]
                    change, most = (tangent - rates[b, BEFORE + k]) * ratio, MOST * abs(tangent)
                    bent = tangent + SHARE * min(max(change, -most), most)
                    wrench += bent * where[b, 4 * part + j]
                    changed[b] |= laws[b, 4 + k] != bent
                    laws[b, 4 + k] = bent
            changed[b] |= laws[b, i] != wrench
            laws[b, i] = wrench
        numbers[count] = b
        count += changed[b]
    return count


@compiled
def due_at(
    end: float,
    tolerance: float,
    all_of_them: bool,
    rates: Array,
    wrenches: Array,
    tangents: Array,
    where: Array,
    motion: Array,
    loads: Array,
    levers: Array,
    again: Mask,
    moved: Array,
    due: Mask,
) -> None:
    """Find which bearings are to be evaluated at the end of a step.

    That is at the end of their intervals, where motion and velocity have changed the wrench so much that
    a defect above the tolerance is to be expected, and always where a film bears less than `SLACK` of what it
    did of late, and is to go on so: what may come its tangent does not tell.

    Parameters
    ----------
    end, tolerance, all_of_them : float, float, bool
        In s; largest relative defect of an interval; whether the end is a common instant.
    rates, wrenches, tangents, where
        As above.
    motion, loads, levers : ndarray (n, 8), (n,), (n,)
        The same as `where`, now; and see `System.set_scale`.
    again : ndarray of bool (n,)
        Those that are due for another reason.
    moved : ndarray (n,)
        Overwritten with the changes of wrenches since bearings stood last over their sizes: those by motion
        and by velocity added, for they may cancel, and what bends does not; and `due`, of bool, with who is.
    """
    for b in range(len(rates)):
        largest = 0.0
        for i in range(4):
            change = 0.0
            for part in range(2):
                total = 0.0
                for j in range(4):
                    at = 4 * part + j
                    total += tangents[b, 16 * part + 4 * i + j] * (motion[b, at] - where[b, at])
                change += abs(total)
            largest = _larger(change if i < 2 else change / levers[b], largest)
        moved[b] = largest / rates[b, SIZE]
        force = math.hypot(wrenches[b, 0], wrenches[b, 1]) / rates[b, SIZE]
        bend = rates[b, BEND] if rates[b, BEND] <= LINEAR else max(rates[b, BEND], STIFFENS)
        due[b] = (
            all_of_them
            or again[b]
            or (rates[b, SIZE] > (1.0 + _SAME) * LIGHT * loads[b] and max(force, moved[b]) < SLACK)
            or end - rates[b, STANDS] >= (1.0 - _SAME) * rates[b, INTERVAL]
            or bend * moved[b] ** 2 > tolerance
        )


@compiled
def relative(
    start: float,
    tolerance: float,
    defect: Array,
    levers: Array,
    size: Array,
    rates: Array,
    again: Mask,
    sizes: Array,
    rough: Mask,
) -> tuple[float, float]:
    """Measure defects: the largest of all, and of those for which the length of the step answers.

    A shorter step helps those that stand at its start, and others once: they are due in its repetition.

    Parameters
    ----------
    start, tolerance : float
        Of the step in s; largest relative defect.
    defect, levers, size, rates, again
        As above.
    sizes : ndarray (n,)
        Overwritten with relative defects.
    rough : ndarray of bool (n,)
        Overwritten with whose is above the tolerance.
    """
    largest = answered = 0.0
    for b in range(len(size)):
        found = _magnitude(defect[b, 0], defect[b, 1], defect[b, 2], defect[b, 3], levers[b]) / size[b]
        sizes[b], rough[b] = found, not found <= tolerance
        largest = _larger(found, largest)
        answers = rates[b, STANDS] == start or not (found <= tolerance or again[b]) or math.isnan(found)
        answered = _larger(found, answered) if answers else answered
    return largest, answered


@compiled
def intervals_after(
    end: float,
    tolerance: float,
    rates: Array,
    tangents: Array,
    due: Mask,
    moved: Array,
    sizes: Array,
    size: Array,
    after: Array,
) -> None:
    """Overwrite `after` with what is known behind defects of these relative sizes at `end`.

    Intervals double where they were calm and halve where they were not.

    Parameters
    ----------
    tangents : ndarray (n, 32)
        K and C at the start of the step.
    size : ndarray (n,)
        Forces that defects are measured by.
    others
        As above; `rates` is what was known.
    """
    for b in range(len(rates)):
        copy(rates[b], after[b])
        after[b, SIZE] = size[b]
        if not due[b]:
            continue
        span, interval = end - rates[b, STANDS], rates[b, INTERVAL]
        if span >= (1.0 - _SAME) * interval and sizes[b] <= CALM * tolerance:
            interval = 2.0 * span
        if sizes[b] > tolerance:
            interval = min(interval, 0.5 * span)
        after[b, STANDS], after[b, SPAN], after[b, INTERVAL] = end, span, interval
        after[b, BEND] = max(sizes[b] / max(moved[b], _NOTHING) ** 2, FADES * rates[b, BEND])
        copy(tangents[b], after[b, BEFORE:])


@compiled
def measure(forces: Array, loads: Array, faded: float, rates: Array, size: Array) -> None:
    """Overwrite sizes with the largest forces of late in N.

    Those are a force now (n, 4), the share of the last size that is left, and one of the load.
    """
    for b in range(len(size)):
        force = math.hypot(forces[b, 0], forces[b, 1])
        size[b] = max(force, faded * rates[b, SIZE], LIGHT * loads[b])
