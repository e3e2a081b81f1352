"""Fields over the nodes in one pass through the matrices, which are larger than the nearest memory."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import fused, inlined

Array = NDArray[np.float64]


@inlined
def _products(matrix: Array, k: int, vector: Array) -> tuple[float, float, float]:
    """Products of rows k of each third of a matrix with a vector, which is then read once."""
    nodes = len(matrix) // 3
    deflection, before, behind = matrix[k], matrix[nodes + k], matrix[2 * nodes + k]
    moved = left = right = 0.0
    for c in range(len(vector)):
        moved += deflection[c] * vector[c]
        left += before[c] * vector[c]
        right += behind[c] * vector[c]
    return moved, left, right


@inlined
def _square(x: float, y: float, flexibility: float) -> float:
    return (x * x + y * y) * flexibility * flexibility


@inlined
def _beyond(value: float, largest: float) -> bool:
    """Whether it is larger; what is not a number is beyond all, as numpy has it."""
    return value > largest or (math.isnan(value) and not math.isnan(largest))


@fused
def fields_at(
    of_x: Array,
    of_y: Array,
    in_x: Array,
    in_y: Array,
    static: Array,
    moments: Array,
    flexibility: Array,
    fields: Array,
) -> tuple[int, int]:
    """Overwrite the fields of N nodes, and return where amplitude and stress are largest.

    Parameters
    ----------
    of_x, of_y : ndarray, (3 N, i), (3 N, j)
        Deflection, and bending moments at both sides of the nodes, from the modal displacements of a plane.
    in_x, in_y : ndarray, (i,), (j,)
        Those.
    static : ndarray, (2, N)
        Static deflection in both planes.
    moments : ndarray, (2, 2 N)
        Static bending moments.
    flexibility : ndarray, (2 N,)
        Stress from moments.
    fields : ndarray, (4, N)
        Displacements in x and y, vibration amplitude, largest stress of both sides.
    """
    nodes = fields.shape[1]
    for k in range(nodes):
        x, left_x, right_x = _products(of_x, k, in_x)
        y, left_y, right_y = _products(of_y, k, in_y)
        fields[0, k], fields[1, k] = static[0, k] + x, static[1, k] + y
        fields[2, k] = x * x + y * y
        at = nodes + k
        left = _square(moments[0, k] + left_x, moments[1, k] + left_y, flexibility[k])
        right = _square(moments[0, at] + right_x, moments[1, at] + right_y, flexibility[at])
        fields[3, k] = right if right > left or math.isnan(right) else left
    moved = bent = 0
    for k in range(nodes):
        moved = k if _beyond(fields[2, k], fields[2, moved]) else moved
        bent = k if _beyond(fields[3, k], fields[3, bent]) else bent
    for k in range(nodes):
        fields[2, k], fields[3, k] = math.sqrt(fields[2, k]), math.sqrt(fields[3, k])
    return moved, bent


def compile_now() -> None:
    """Compile, or fetch what is kept, so that no record has to wait for it."""
    matrix, moved = np.zeros((3, 1)), np.zeros(1)
    fields_at(matrix, matrix, moved, moved, np.zeros((2, 1)), np.zeros((2, 2)), np.zeros(2), np.zeros((4, 1)))
