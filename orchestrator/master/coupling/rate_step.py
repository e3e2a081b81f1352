"""What `orchestrator.master.coupling.multirate` works out at each step, in two compiled loops."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import compiled, copy, inlined
from orchestrator.master.coupling.rates import FELT, STANDS, due_at, intervals_after, measure, relative
from orchestrator.master.interface import defects

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Numbers = NDArray[np.intp]


@inlined
def _bent(law: Array, tangent: Array, where: Array, motion: Array, bent: Array) -> None:
    for i in range(4):
        total = 0.0
        for part in range(2):
            for j in range(4):
                k, at = 16 * part + 4 * i + j, 4 * part + j
                total += (law[4 + k] - tangent[k]) * (motion[at] - where[at])
        bent[i] = total


@compiled
def find_due(
    time: float,
    step: float,
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
    laws: Array,
    moved: Array,
    due: Mask,
    before: Array,
    bent: Array,
    numbers: Numbers,
    spans: Array,
) -> int:
    """Find which bearings are due at the end of a step, as `rates.due_at`, and how many.

    Parameters
    ----------
    time, step : float
        Start and length of the step in s.
    laws : ndarray (n, 36)
        That moved the rotor.
    before : ndarray (n, 32)
        Overwritten with the tangents, which evaluations then change.
    bent : ndarray (n, 4)
        Overwritten with what tangents make of the motion since then beyond what the laws do.
    numbers, spans : ndarray of int (n,), ndarray (2, n)
        The first overwritten with numbers of those that are due, where they stand, and how far they go.
    others
        As `rates.due_at` takes them.
    """
    end = time + step
    due_at(
        end,
        tolerance,
        all_of_them,
        rates,
        wrenches,
        tangents,
        where,
        motion,
        loads,
        levers,
        again,
        moved,
        due,
    )
    for b in range(len(due)):
        copy(tangents[b], before[b])
        _bent(laws[b], tangents[b], where[b], motion[b], bent[b])
    count = 0
    for b in range(len(due)):
        if due[b]:
            stands = rates[b, STANDS]
            numbers[count], spans[0, count] = b, stands
            spans[1, count] = step if stands == time else end - stands  # an even step to the bit
            count += 1
    return count


@compiled
def settle(
    start: float,
    end: float,
    tolerance: float,
    own: float,
    faded: float,
    laws: Array,
    motion: Array,
    forces: Array,
    loads: Array,
    levers: Array,
    before: Array,
    rates: Array,
    again: Mask,
    moved: Array,
    due: Mask,
    bent: Array,
    defect: Array,
    felt: Array,
    size: Array,
    sizes: Array,
    rough: Mask,
    after: Array,
) -> tuple[float, float]:
    """Overwrite defects (n, 4), 0 where a bearing is not due, and all that follows from them.

    Parameters
    ----------
    start, end : float
        Of the step in s.
    tolerance, own : float
        Largest relative defect of a step, and of an interval.
    bent : ndarray (n, 4)
        From `find_due`.
    felt : ndarray (n, 4)
        Overwritten with the sizes of defects, or `FELT` of those of the tangents where these are larger.
    others
        As above, and as `interface.defects`, `rates.relative` and `rates.intervals_after` take them.

    Returns
    -------
    tuple of float
        As from `rates.relative`.
    """
    defects(laws, motion, forces, defect)
    for b in range(len(due)):
        if not due[b]:
            defect[b] = felt[b] = 0.0
            continue
        for i in range(4):
            felt[b, i] = max(abs(defect[b, i]), FELT * abs(defect[b, i] - bent[b, i]))
    measure(forces, loads, faded, rates, size)
    found = relative(start, tolerance, felt, levers, size, rates, again, sizes, rough)
    intervals_after(end, own, rates, before, due, moved, sizes, size, after)
    return found
