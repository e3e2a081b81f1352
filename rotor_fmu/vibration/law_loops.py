"""The arithmetic of a step under affine laws, compiled; what it is for: `rotor_fmu.vibration.affine_step`.

Laws are rows [K C] of each of n bearings, (n, 4, 8); wrenches are (4 n,); journals' q and v are (n, 8).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import fused, inlined

Array = NDArray[np.float64]
Pivots = NDArray[np.intp]

_TINY = float(np.finfo(np.float64).tiny)


@inlined
def _react(law: Array, offset: Array, journals: Array, wrench: Array) -> None:
    for b in range(len(law)):
        for i in range(4):
            taken = 0.0
            for j in range(8):
                taken += law[b, i, j] * journals[b, j]
            wrench[4 * b + i] = offset[4 * b + i] - taken


@inlined
def _few_and_soft(law: Array, own: Array) -> bool:
    """Whether a crude bound, g_ij^2 <= tr(K_i S_ii) tr(K_j S_jj), shows that no number is above 1."""
    most = total = 0.0
    for b in range(len(law)):
        trace = 0.0
        for i in range(4):
            for j in range(4):
                trace += law[b, i, j] * own[b, i, j]
        alone = math.sqrt(abs(trace))
        most, total = max(most, alone), total + alone
    return not most * total > 1.0


@fused
def stiffness_numbers(law: Array, own: Array, mixed: Array, product: Array, sizes: Array) -> bool:
    """Overwrite the last of n + 1 rows of sizes with those of `coordinates.Compliance.stiffness_numbers`.

    The other rows, and product, (4 n, 4 n), are memory.  False, and no numbers are there, if a cruder bound
    shows that none is above 1.
    """
    count = len(law)
    if _few_and_soft(law, own):
        return False
    for row in range(4 * count):
        for c in range(4 * count):
            product[row, c] = 0.0
        for j in range(4):
            stiffness = law[row // 4, row % 4, j]
            for c in range(4 * count):
                product[row, c] += stiffness * mixed[4 * (row // 4) + j, c]
    for one in range(count):
        for other in range(count):
            square = 0.0
            for i in range(4 * one, 4 * one + 4):
                for j in range(4 * other, 4 * other + 4):
                    square += product[i, j] * product[j, i]
            sizes[one, other] = math.sqrt(abs(square))
    for one in range(count):
        size, total = max(sizes[one, one], _TINY), 0.0
        for other in range(count):
            total += sizes[one, other] / math.sqrt(size * max(sizes[other, other], _TINY))
        sizes[count, one] = size * total
    return True


@fused
def half_shares(law: Array, own: Array, mixed: Array, product: Array, sizes: Array, nearer: Array) -> bool:
    """Overwrite half of the shares of the mean, (4 n,), that stiffness asks for; False if all are 0."""
    count, mixes = len(law), False
    if not stiffness_numbers(law, own, mixed, product, sizes):
        return False
    for b in range(count):
        number = sizes[count, b]
        mixes |= number > 1.0
        for i in range(4 * b, 4 * b + 4):
            nearer[i] = 0.5 - 0.5 / max(number, 1.0)
    return mixes


@fused
def begin(
    law: Array,
    offset: Array,
    journals: Array,
    own: Array,
    mixed: Array,
    product: Array,
    sizes: Array,
    wrench: Array,
    nearer: Array,
) -> bool:
    """Overwrite wrenches as `react`, and the shares of the mean as `half_shares`; return what that does."""
    _react(law, offset, journals, wrench)
    return half_shares(law, own, mixed, product, sizes, nearer)


@fused
def react(law: Array, offset: Array, journals: Array, wrench: Array) -> None:
    """Overwrite wrenches with an offset less what laws make of the journals' motion."""
    _react(law, offset, journals, wrench)


@fused
def mix(of_start: Array, of_end: Array, nearer: Array, moves: Array) -> None:
    """Overwrite what wrenches move the journals by where a share of each counts at the start instead."""
    for b in range(len(moves)):
        for j in range(8):
            for c in range(len(nearer)):
                end = of_end[b, j, c]
                moves[b, j, c] = end + nearer[c] * (of_start[b, j, c] - end)


@fused
def factorise(law: Array, moves: Array, matrix: Array, pivots: Pivots) -> bool:
    """Overwrite a matrix with the factors of 1 + L S, which all steps of one length under a law share.

    Parameters
    ----------
    law
        As above.
    moves : ndarray, (n, 8, 4 n)
        S, what wrenches at the end move the journals by.
    matrix, pivots : ndarray, (4 n, 4 n), ndarray of int, (4 n,)
        Overwritten with factors, the lower one less its diagonal of 1, and with the row that each was
        exchanged with.

    Returns
    -------
    bool
        False if there are none.
    """
    size = len(matrix)
    for b in range(len(law)):
        move = moves[b]
        for i in range(4):
            f, row = law[b, i], matrix[4 * b + i]
            for c in range(size):
                row[c] = (f[0] * move[0, c] + f[1] * move[1, c] + f[2] * move[2, c] + f[3] * move[3, c]) + (
                    f[4] * move[4, c] + f[5] * move[5, c] + f[6] * move[6, c] + f[7] * move[7, c]
                )
            row[4 * b + i] += 1.0
    for k in range(size):
        pivot = k
        for row in range(k + 1, size):
            if abs(matrix[row, k]) > abs(matrix[pivot, k]):
                pivot = row
        pivots[k] = pivot
        if matrix[pivot, k] == 0.0:
            return False
        if pivot != k:
            for c in range(size):
                matrix[k, c], matrix[pivot, c] = matrix[pivot, c], matrix[k, c]
        last = matrix[k, k + 1 :]
        for row in range(k + 1, size):
            factor = matrix[row, k] / matrix[k, k]
            matrix[row, k] = factor
            rest = matrix[row, k + 1 :]
            for c in range(len(rest)):
                rest[c] -= factor * last[c]
    return True


@fused
def end_wrenches(
    law: Array, offset: Array, moves: Array, matrix: Array, pivots: Pivots, journals: Array, wrench: Array
) -> None:
    """Overwrite wrenches with those that a law has with what they do themselves.

    Parameters
    ----------
    law, offset
        As above.
    moves, matrix, pivots
        As of `factorise`.
    journals : ndarray
        At the end of the step without those wrenches; overwritten with them.
    wrench : ndarray
        Overwritten.
    """
    size = len(offset)
    _react(law, offset, journals, wrench)
    for k in range(size):
        wrench[k], wrench[pivots[k]] = wrench[pivots[k]], wrench[k]
    for k in range(1, size):
        total = 0.0
        for c in range(k):
            total += matrix[k, c] * wrench[c]
        wrench[k] -= total
    for k in range(size - 1, -1, -1):
        total = 0.0
        for c in range(k + 1, size):
            total += matrix[k, c] * wrench[c]
        wrench[k] = (wrench[k] - total) / matrix[k, k]
    for b in range(len(law)):
        for j in range(8):
            for c in range(size):
                journals[b, j] += moves[b, j, c] * wrench[c]


def compile_now() -> None:
    """Compile, or fetch what is kept, so that no step has to wait for it."""
    law, square, wrench, journals = np.zeros((1, 4, 8)), np.zeros((4, 4)), np.zeros(4), np.zeros((1, 8))
    moves = np.zeros((1, 8, 4))
    react(law, wrench, journals, np.zeros(4))
    begin(
        law, wrench, journals, np.zeros((1, 4, 4)), square, square, np.zeros((2, 1)), np.zeros(4), np.zeros(4)
    )
    pivots = np.zeros(4, dtype=np.intp)
    factorise(law, moves, square, pivots)
    end_wrenches(law, wrench, moves, square, pivots, journals, np.zeros(4))
