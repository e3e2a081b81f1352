"""What `orchestrator.master.coupling.multirate` works out at each step, in two compiled loops."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import compiled
from orchestrator.master.coupling.rates import due_at, intervals_after, measure, relative
from orchestrator.master.interface import defects

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@compiled
def find_due(
    end: float,
    tolerance: float,
    all_of_them: bool,
    rates: Array,
    tangents: Array,
    where: Array,
    motion: Array,
    levers: Array,
    again: Mask,
    moved: Array,
    due: Mask,
    before: Array,
) -> None:
    """As `rates.due_at`; overwrite `before` with the tangents, which evaluations then change."""
    due_at(end, tolerance, all_of_them, rates, tangents, where, motion, levers, again, moved, due)
    before[:] = tangents


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
    defect: Array,
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
            defect[b] = 0.0
    measure(forces, loads, faded, rates, size)
    found = relative(start, tolerance, defect, levers, size, rates, again, sizes, rough)
    intervals_after(end, own, rates, before, due, moved, sizes, size, after)
    return found
