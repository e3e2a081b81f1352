"""Products of complex matrices with numbers in pairs, compiled: numpy takes most of its time to begin one.

A matrix (s, j) is kept as real and imaginary part of its transpose, (2, j, s), so that sums run along memory.
Numbers are real and imaginary part next to each other.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import fused, inlined

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
def add_product(matrix: Array, pairs: Array, target: Array) -> None:
    """Add to pairs (2 s,) what the first columns of a matrix make of pairs (2 i,)."""
    total = np.zeros((2, matrix.shape[2]))
    _sum(matrix, pairs, total)
    for r in range(total.shape[1]):
        target[2 * r] += total[0, r]
        target[2 * r + 1] += total[1, r]


@fused
def coast(
    block: Array, growth: Array, matrix: Array, wrench: Array, rotation: Array, before: Array, after: Array
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
    """
    slow = block.shape[1]
    total = np.zeros((2, matrix.shape[2]))
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


def compile_now() -> None:
    """Compile, or fetch what is kept, so that no step has to wait for it."""
    matrix, pair = np.zeros((2, 1, 1)), np.zeros(2)
    add_product(matrix, pair, np.zeros(2))
    coast(matrix, np.zeros(0), np.zeros((2, 2, 1)), pair, np.zeros(1), pair, np.zeros(2))
