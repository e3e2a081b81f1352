"""Statics of the shaft: target loads of the bearings and the shape under gravity."""

from __future__ import annotations

import math

import numpy as np
import scipy.linalg as sl
from numpy.typing import NDArray

from rotor_fmu.train.train import Train

Array = NDArray[np.float64]


def target_loads(train: Train, gravity: float = 9.80665) -> Array:
    """Static bearing loads of a train aligned to its catenary.

    Each rotor between couplings is in balance under its weight, its bearings and the shear in its
    couplings, with no moment in the couplings: their faces are parallel before they are bolted.
    Where that leaves a choice, the shears are the least in the sense of least squares.  A `load` given
    for a bearing is kept; if balance then asks for moments in couplings, they too are the least.

    Parameters
    ----------
    train : Train
        The train.
    gravity : float
        g [m/s2].

    Returns
    -------
    ndarray, (n_b,)
        Forces of the bearings on the shaft in +y [N]; with weight they balance in force and moment.

    Raises
    ------
    ValueError
        If the loads given leave no balance.
    """
    z = np.array(train.z)
    seats, joints = train.bearings, train.couplings
    free = [i for i, b in enumerate(seats) if b.load is None]
    weight, given = _section_weights(train, gravity), np.zeros(2 * len(train.sections))
    supports = np.zeros((len(given), len(free)))
    shears, moments = (np.zeros((len(given), len(joints))) for _ in range(2))
    span = train.length
    for r, (first, last) in enumerate(train.sections):
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
            if joint.node in (first, last):
                sign = 1.0 if joint.node == last else -1.0
                shears[[force, moment], j] = sign, sign * (z[joint.node] - origin) / span
                moments[moment, j] = sign
    solution = _least_by_rank([moments, shears, supports], weight - given)
    residual = moments @ solution[0] + shears @ solution[1] + supports @ solution[2] + given - weight
    if np.abs(residual).max() > 1e-9 * np.abs(weight).max():
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
            (s.mass, (z[k] + z[k + 1]) / 2.0) for k, s in enumerate(train.shoulders) if first <= k < last
        ] + [(w.mass, z[w.node]) for w in train.wheels if train.section_of(w.node) == r]
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
