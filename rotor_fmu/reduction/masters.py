"""Degrees of freedom of one plane that a reduction keeps where none are given."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.shaft.matrices import ShaftModel


def default_interface(model: ShaftModel) -> NDArray[np.intp]:
    """Deflection and slope at the bearings, in one plane."""
    nodes = model.bearing_dofs[:, 0] // 4
    return np.unique(np.concatenate([2 * nodes, 2 * nodes + 1]))


def default_masters(model: ShaftModel, count: int) -> NDArray[np.intp]:
    """Deflection and slope at the bearings, deflections at the ends, then where the gaps are largest.

    The largest gaps are filled at wheels first, then at any node.

    Parameters
    ----------
    model : ShaftModel
        The unreduced shaft.
    count : int
        Degrees of freedom wanted in one plane; more are returned if bearings and ends are more.

    Returns
    -------
    ndarray of int
        Ascending degrees of freedom of one plane.
    """
    chosen = {int(d) for d in default_interface(model)} | {0, 2 * model.nodes - 2}
    wheels = np.unique(model.wheel_dofs[:, 0] // 4)
    for candidates in (wheels, np.arange(model.nodes)):
        while len(chosen) < count:
            occupied = np.array(sorted({d // 2 for d in chosen}))
            distance = np.abs(model.z[candidates, None] - model.z[occupied]).min(axis=1, initial=np.inf)
            if distance.max(initial=0.0) == 0.0:
                break
            chosen.add(2 * int(candidates[distance.argmax()]))
    slopes = (2 * k + 1 for k in range(model.nodes) if 2 * k + 1 not in chosen)
    chosen |= {slope for slope, _ in zip(slopes, range(count - len(chosen)), strict=False)}
    return np.array(sorted(chosen), dtype=np.intp)
