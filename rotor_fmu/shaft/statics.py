"""Statics of the shaft: target loads of the bearings and the shape under gravity."""

from __future__ import annotations

import math

import numpy as np
import scipy.linalg as sl
from numpy.typing import NDArray

from rotor_fmu.shaft.heights import loads_at_heights
from rotor_fmu.train.train import Train

Array = NDArray[np.float64]


def target_loads(train: Train, gravity: float | None = None) -> Array:
    """Static bearing loads of a train, aligned to its catenary or with its bearings at given heights.

    For the heights see `loads_at_heights`.  On the catenary each rotor between couplings is in balance under
    its weight, its bearings and the shear in its couplings, with no moment in the couplings: their faces are
    parallel before they are bolted.  Where that leaves a choice, the shears are the least in the sense of
    least squares.  A `load` given for a bearing is kept; if balance then asks for moments in couplings, they
    too are the least.

    Parameters
    ----------
    train : Train
        The train.
    gravity : float, optional
        g [m/s2]; default that of the train.

    Returns
    -------
    ndarray, (n_b,)
        Forces of the bearings on the shaft against gravity [N]; with weight they balance in force and moment.
        Negative where the shaft would lift off: it is held down.

    Raises
    ------
    ValueError
        If the loads given leave no balance.
    """
    gravity = train.weight if gravity is None else gravity
    if len(train.bearings) > 1 and any(seat.height is not None for seat in train.bearings):
        return loads_at_heights(train, gravity)
    z = np.array(train.z)
    seats, joints = train.bearings, train.couplings
    free = [i for i, b in enumerate(seats) if b.load is None]
    weight, given = _section_weights(train, gravity), np.zeros(2 * len(train.sections))
    supports = np.zeros((len(given), len(free)))
    shears, moments = (np.zeros((len(given), len(joints))) for _ in range(2))
    span = train.length
    for r, (first, _) in enumerate(train.sections):
        force, moment = 2 * r, 2 * r + 1
        origin = z[first]
        for i, seat in enumerate(seats):
            if train.section_of(seat.node) == r:
                arm = (z[seat.node] - origin) / span
                if i in free:
                    supports[[force, moment], free.index(i)] = 1.0, arm
                else:
                    given[[force, moment]] += np.array([1.0, arm]) * (seat.load or 0.0)
        for j, joint in enumerate(joints):
            if r in (j, j + 1):
                sign = 1.0 if r == j else -1.0
                shears[[force, moment], j] = sign, sign * (z[joint.node] - origin) / span
                moments[moment, j] = sign
    solution = _least_by_rank([moments, shears, supports], weight - given)
    residual = moments @ solution[0] + shears @ solution[1] + supports @ solution[2] + given - weight
    if np.abs(residual).max() > 1e-9 * max(np.abs(weight).max(), np.abs(given).max()):
        fixed = ", ".join(f"{b.name} {b.load:g} N" for b in seats if b.load is not None) or "none"
        raise ValueError(
            f"train {train.name}: no static balance with {len(free)} free bearing loads (given: {fixed}); "
            "leave the load of at least two bearings free"
        )
    loads = np.array([math.nan if b.load is None else b.load for b in seats])
    loads[free] = solution[2]
    return loads


def _section_weights(train: Train, gravity: float) -> Array:
    """Weight and its moment about the front end over the train's length, section by section."""
    z = np.array(train.z)
    result = []
    for r, (first, last) in enumerate(train.sections):
        parts = [
            (s.mass, (z[k] + z[k + 1]) / 2.0 if s.plain else z[k] + s.centroid)
            for k, s in enumerate(train.shoulders)
            if first <= k < last
        ] + [(body.mass, z[body.node]) for body in train.bodies if train.section_of(body.node) == r]
        mass, position = np.array(parts).T
        result += [gravity * mass.sum(), gravity * (mass @ (position - z[first])) / train.length]
    return np.array(result)


def _least_by_rank(blocks: list[Array], target: Array) -> list[Array]:
    """Solve sum(A_i x_i) = target with least |x_0|, then least |x_1| and so on."""
    solution: list[Array] = []
    for rank, block in enumerate(blocks):
        behind = np.hstack([np.zeros((len(target), 1)), *blocks[rank + 1 :]])
        shadow = sl.null_space(behind.T, rcond=1e-12).T
        x = np.zeros(block.shape[1])
        if len(shadow):
            x = np.linalg.lstsq(shadow @ block, shadow @ target, rcond=1e-12)[0]
        solution.append(x)
        target = target - block @ x
    return solution
