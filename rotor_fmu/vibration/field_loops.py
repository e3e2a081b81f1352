"""Fields over the nodes in one pass through the matrices, which are larger than the nearest memory."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import fused, inlined

Array = NDArray[np.float64]


@inlined
def _product(row: Array, vector: Array) -> float:
    total = 0.0
    for c in range(len(vector)):
        total += row[c] * vector[c]
    return total


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
        x, y = _product(of_x[k], in_x), _product(of_y[k], in_y)
        fields[0, k], fields[1, k] = static[0, k] + x, static[1, k] + y
        fields[2, k], fields[3, k] = x * x + y * y, 0.0
    for side in range(2):
        for k in range(nodes):
            at = side * nodes + k
            x = moments[0, at] + _product(of_x[nodes + at], in_x)
            y = moments[1, at] + _product(of_y[nodes + at], in_y)
            square = (x * x + y * y) * flexibility[at] * flexibility[at]
            if square > fields[3, k] or math.isnan(square):
                fields[3, k] = square
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
