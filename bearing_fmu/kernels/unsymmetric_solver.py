"""Direct solution on a ring of columns whose blocks are not symmetric; otherwise as `cyclic_solver`.

Column i + 1 is coupled to column i by ``-lower[i]``, and i to i + 1 by ``-upper[i]``, row by row; the
last one and the first likewise. All blocks are stored transposed, since the vector operations combine
rows.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.block_inverse import invert, ones_at, set_windows
from bearing_fmu.kernels.compiled import inner_kernel, kernel
from bearing_fmu.kernels.copied import copy
from bearing_fmu.kernels.vector import (
    LANES,
    TILE,
    add_rows,
    padded,
    set_product,
    set_rows,
    set_tile,
    subtract_product,
    subtract_rows,
    subtract_tile,
)

Floats = NDArray[np.float64]


@inner_kernel
def _multiply(
    target: Floats, to: int, a: Floats, at: int, b: Floats, start: int, n: int, width: int, wide: int
) -> None:
    """Set a matrix of `wide` columns to the product of a block and such a matrix."""
    tiled = n // TILE * TILE
    for j in range(0, tiled, TILE):
        for k in range(0, wide, LANES):
            set_tile(
                target, to + j * wide + k, wide, b, 0, a, at + j * width, 1, width, b, start + k, wide, n
            )
    for j in range(tiled, n):
        for k in range(0, wide, LANES):
            set_rows(target, to + j * wide + k, a, at + j * width, 1, b, start + k, wide, n)


@inner_kernel
def _subtract_product(
    target: Floats, to: int, a: Floats, at: int, b: Floats, start: int, n: int, width: int, wide: int,
    ones: Floats, place: int,
) -> None:  # fmt: skip
    """Subtract such a product from a matrix; from `place` on eight `ones`."""
    tiled = n // TILE * TILE
    for j in range(0, tiled, TILE):
        for k in range(0, wide, LANES):
            subtract_tile(
                target, to + j * wide + k, wide, ones, place, a, at + j * width, 1, width,
                b, start + k, wide, n,
            )  # fmt: skip
    for j in range(tiled, n):
        for k in range(0, wide, LANES):
            subtract_rows(target, to + j * wide + k, a, at + j * width, 1, b, start + k, wide, n)


def ring_work(n: int) -> Floats:
    """Work space of `factorise_ring`, and of `solve_ring` with up to 3 n sides, for blocks of n rows."""
    width = padded(n)
    return np.zeros(3 * n * width + 8 * width + 4)


@kernel
def factorise_ring(
    b: Floats,
    lower: Floats,
    upper: Floats,
    w: Floats,
    y: Floats,
    work: Floats,
    count: int,
    n: int,
    width: int,
) -> bool:
    """Eliminate the columns.

    Parameters
    ----------
    b : ndarray, shape (count * n * width,)
        Transposed diagonal blocks; on return their Schur complements' inverses, transposed.
    lower, upper : ndarray, shape (count * width,)
        Couplings to the next column.
    w, y : ndarray, shape (count * n * width,)
        On return what couples each column to the last one, and the last one to it.
    work : ndarray
        Of `ring_work`.

    Returns
    -------
    bool
        False where a Schur complement is singular.
    """
    block = n * width
    last = (count - 1) * block
    v, u, kept = work[:block], work[block : 2 * block], work[2 * block : 3 * block]
    row = work[3 * block :]
    v[:] = 0.0
    u[:] = 0.0
    set_windows(n, width, row)
    end = (count - 1) * width
    for j in range(n):
        v[j * width + j] = -lower[end + j]
        u[j * width + j] = -upper[end + j]
    for i in range(count - 1):
        at = i * block
        if i == count - 2:
            for j in range(n):
                v[j * width + j] -= upper[i * width + j]
                u[j * width + j] -= lower[i * width + j]
        if not invert(b, at, n, width, row, kept):
            return False
        _multiply(w, at, v, 0, b, at, n, width, width)
        _multiply(y, at, b, at, u, 0, n, width, width)
        _subtract_product(b, last, w, at, u, 0, n, width, width, row, ones_at(width))
        if i < count - 2:
            ahead = at + block
            for j in range(n):
                for k in range(0, width, LANES):
                    here, low = j * width + k, i * width + k
                    set_product(v, here, w, at + here, lower, low)
                    set_rows(u, here, upper, i * width + j, 0, y, at + here, 0, 1)
                    set_rows(row, k, upper, i * width + j, 0, b, at + here, 0, 1)
                    subtract_product(b, ahead + here, row, k, lower, low)
    return invert(b, last, n, width, row, kept)


@kernel
def solve_ring(
    b: Floats, lower: Floats, upper: Floats, w: Floats, y: Floats, x: Floats, row: Floats,
    count: int, n: int, width: int, sides: int,
) -> None:  # fmt: skip
    """Solve for `sides` right-hand sides with the factor of `factorise_ring`.

    Parameters
    ----------
    b, lower, upper, w, y : ndarray
        As left by `factorise_ring`.
    x : ndarray, shape (count * sides * width,)
        Right-hand sides, for each column one row a side; on return the solution.
    row : ndarray
        Of `ring_work`.
    """
    block = n * width
    rows = sides * width
    last = (count - 1) * rows
    for i in range(count):
        at = i * rows
        for k in range(rows):
            row[k] = x[at + k]
        for m in range(0, rows, width):
            for k in range(0, width, LANES):
                set_rows(x, at + m + k, row, m, 1, b, i * block + k, width, n)
                if i < count - 1:
                    subtract_rows(x, last + m + k, row, m, 1, y, i * block + k, width, n)
            if i < count - 2:
                for k in range(n):
                    x[at + rows + m + k] += lower[i * width + k] * x[at + m + k]
    for i in range(count - 2, -1, -1):
        at = i * rows
        for m in range(0, rows, width):
            for k in range(0, width, LANES):
                subtract_rows(x, at + m + k, x, last + m, 1, w, i * block + k, width, n)
            if i < count - 2:
                for k in range(n):
                    row[k] = upper[i * width + k] * x[at + rows + m + k]
                for k in range(0, width, LANES):
                    add_rows(x, at + m + k, row, 0, 1, b, i * block + k, width, n)


@kernel
def solve_transposed(
    b: Floats, lower: Floats, upper: Floats, w: Floats, y: Floats, x: Floats, work: Floats,
    count: int, n: int, width: int,
) -> None:  # fmt: skip
    """Solve the transposed system for eight right-hand sides with the factor of `factorise_ring`.

    Parameters
    ----------
    b, lower, upper, w, y, work : ndarray
        As left by `factorise_ring`.
    x : ndarray, shape (count * n * 8,)
        Right-hand sides, for each unknown a number a side; on return the solutions.
    """
    block, rows = n * width, n * LANES
    last, row, ones = (count - 1) * rows, work[:rows], 3 * block + ones_at(width)
    for i in range(count):
        at = i * rows
        copy(x[at : at + rows], row)
        _multiply(x, at, b, i * block, row, 0, n, width, LANES)
        if i < count - 1:
            _subtract_product(x, last, w, i * block, row, 0, n, width, LANES, work, ones)
        if i < count - 2:
            for j in range(n):
                for k in range(j * LANES, j * LANES + LANES):
                    x[at + rows + k] += upper[i * width + j] * x[at + k]
    for i in range(count - 2, -1, -1):
        at = i * rows
        _subtract_product(x, at, y, i * block, x, last, n, width, LANES, work, ones)
        if i < count - 2:
            for j in range(n):
                for k in range(j * LANES, j * LANES + LANES):
                    row[k] = -lower[i * width + j] * x[at + rows + k]
            _subtract_product(x, at, b, i * block, row, 0, n, width, LANES, work, ones)
