"""Products of complex matrices with numbers in pairs, and the step of a whirl of them, compiled.

numpy takes most of its time to begin a product; among films, whose work fills the processor's nearest memory,
each call of Python costs twice what it does alone.

A matrix (s, j) is kept as real and imaginary part of its transpose, (2, j, s), so that sums run along memory.
Numbers are real and imaginary part next to each other.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import copy, fused, inlined
from rotor_fmu.vibration.law_loops import Pivots, end_wrenches, factorise, half_shares, mix, react

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def parts(matrix: Complex) -> Array:
    """A matrix as the loops take it."""
    return np.ascontiguousarray(np.stack([matrix.T.real, matrix.T.imag]))


@inlined
def _sum(matrix: Array, pairs: Array, total: Array) -> None:
    """Add to real and imaginary parts (2, s) what the first columns make of pairs (2 i,)."""
    for j in range(len(pairs) // 2):
        a, b = pairs[2 * j], pairs[2 * j + 1]
        real, imaginary = matrix[0, j], matrix[1, j]
        for r in range(total.shape[1]):
            total[0, r] += real[r] * a - imaginary[r] * b
            total[1, r] += real[r] * b + imaginary[r] * a


@fused
def add_product(matrix: Array, pairs: Array, total: Array, target: Array) -> None:
    """Add to pairs (2 s,) what the first columns of a matrix make of pairs (2 i,).

    Total, (2, s), is memory.
    """
    for r in range(total.shape[1]):
        total[0, r] = total[1, r] = 0.0
    _sum(matrix, pairs, total)
    for r in range(total.shape[1]):
        target[2 * r] += total[0, r]
        target[2 * r + 1] += total[1, r]


@fused
def coast(
    block: Array,
    growth: Array,
    matrix: Array,
    wrench: Array,
    rotation: Array,
    before: Array,
    total: Array,
    after: Array,
) -> None:
    """Overwrite a motion after a step, pairs (2 s,).

    Parameters
    ----------
    block : ndarray, (2, b, b)
        Of the first motions, which stay together.
    growth : ndarray, (2 s - 2 b,)
        Factors of the others.
    matrix : ndarray, (2, i + j, s)
        What is added, of wrench and rotation.
    wrench, before : ndarray, (2 i,), (2 s,)
        Pairs.
    rotation : ndarray, (j,)
        Real numbers.
    total : ndarray, (2, s)
        Memory.
    """
    slow = block.shape[1]
    for r in range(total.shape[1]):
        total[0, r] = total[1, r] = 0.0
    _sum(matrix, wrench, total)
    for j in range(len(rotation)):
        column, factor = len(wrench) // 2 + j, rotation[j]
        for r in range(total.shape[1]):
            total[0, r] += matrix[0, column, r] * factor
            total[1, r] += matrix[1, column, r] * factor
    for c in range(slow):
        for r in range(slow):
            a, b = before[2 * c], before[2 * c + 1]
            total[0, r] += block[0, c, r] * a - block[1, c, r] * b
            total[1, r] += block[0, c, r] * b + block[1, c, r] * a
    for r in range(total.shape[1]):
        after[2 * r], after[2 * r + 1] = total[0, r], total[1, r]
    for r in range(slow, total.shape[1]):
        g, h = growth[2 * (r - slow)], growth[2 * (r - slow) + 1]
        after[2 * r] += g * before[2 * r] - h * before[2 * r + 1]
        after[2 * r + 1] += g * before[2 * r + 1] + h * before[2 * r]


UNSOLVED, LINEAR, MIXED = range(3)
"""What `step` returns: no finite result, or whether all wrenches ran linearly."""


@fused
def step(
    block: Array,
    growth: Array,
    of_start: Array,
    of_end: Array,
    shown: Array,
    move_start: Array,
    move_end: Array,
    own: Array,
    mixed: Array,
    total: Array,
    seen: Array,
    held: Array,
    law: Array,
    matrix: Array,
    pivots: Pivots,
    sizes: Array,
    first: Array,
    last: Array,
    nearer: Array,
    moves: Array,
    offset: Array,
    rest: Array,
    rotations: Array,
    kick: Array,
    before: Array,
    where: Array,
    after: Array,
    journals: Array,
) -> int:
    """Take steps of one length under one law as `rotor_fmu.vibration.affine_step.AffineStep` does, in one go.

    Parameters
    ----------
    block, growth, of_start, of_end, shown
        As in `whirl_coordinates.WhirlMaps`: block, growth, start, end, journals.
    move_start, move_end, own, mixed
        As in `coordinates.Compliance`: start, end, own, mixed.
    total, seen, held : ndarray, (2, s), (2, 4 n), (2 s,)
        Memory.
    law, offset : ndarray, (n, 4, 8), (4 n,)
        Of the bearings.
    matrix, pivots, sizes : ndarray, (4 n, 4 n), ndarray of int, (4 n,), ndarray, (n + 1, n)
        Memory.
    first, last : ndarray, (4 n,)
        Memory.
    nearer : ndarray, (4 n,)
        Overwritten, see `law_loops.half_shares`.
    moves : ndarray, (n, 8, 4 n)
        Memory.
    rest : ndarray, (n, 8)
        The journals in the static equilibrium.
    rotations : ndarray, (steps, j)
        Of each as in `coast`.
    kick : ndarray, (2 s,)
        Added to the motion at the end.
    before, where : ndarray, (2 s,), (n, 8)
        Motion and journals at the start.
    after, journals
        Those at the end; overwritten.
    """
    mixes = half_shares(law, own, mixed, matrix, sizes, nearer)
    if mixes:
        mix(move_start, move_end, nearer, moves)
    if not factorise(law, moves if mixes else move_end, matrix, pivots):
        return UNSOLVED
    copy(before, held)
    for k in range(len(rotations)):
        react(law, offset, where if k == 0 else journals, first)
        if mixes:
            for i in range(len(first)):
                last[i] = nearer[i] * first[i]
                first[i] -= last[i]
        coast(block, growth, of_start, first, rotations[k], held, total, after)
        if mixes:
            add_product(of_end, last, total, after)
        if k == len(rotations) - 1:
            for r in range(len(after)):
                after[r] += kick[r]
        for b in range(len(law)):
            copy(rest[b], journals[b])
        add_product(shown, after, seen, journals.reshape(journals.size))
        end_wrenches(law, offset, moves if mixes else move_end, matrix, pivots, journals, last)
        if mixes:
            for i in range(len(first)):
                first[i] = nearer[i] * last[i]
                last[i] -= first[i]
            add_product(of_start, first, total, after)
        add_product(of_end, last, total, after)
        copy(after, held)
    square = 0.0
    for r in range(len(after)):
        square += after[r] * after[r]
    if not math.isfinite(square):
        return UNSOLVED
    return MIXED if mixes else LINEAR


def compile_now() -> None:
    """Compile, or fetch what is kept, so that no step has to wait for it."""
    matrix, pair, total = np.zeros((2, 1, 1)), np.zeros(2), np.zeros((2, 1))
    add_product(matrix, pair, total, np.zeros(2))
    coast(matrix, np.zeros(0), np.zeros((2, 2, 1)), pair, np.zeros(1), pair, total, np.zeros(2))
    maps = matrix, np.zeros(0), np.zeros((2, 3, 1)), np.zeros((2, 2, 1)), np.zeros((2, 1, 4))
    move, four, square, where = np.zeros((1, 8, 4)), np.zeros(4), np.zeros((4, 4)), np.zeros((1, 8))
    memory = total, np.zeros((2, 4)), np.zeros(2)
    pivots, sizes = np.zeros(4, dtype=np.intp), np.zeros((2, 1))
    about = four, where, np.zeros((1, 1)), pair, pair, where
    law = np.zeros((1, 4, 8)), square, pivots, sizes, four, four, four, move
    end = np.zeros(2), where
    given: tuple[Any, ...] = *maps, move, move, np.zeros((1, 4, 4)), square, *memory, *law, *about, *end
    step(*given)
