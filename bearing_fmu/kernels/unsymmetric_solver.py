"""Direct solution on a ring of columns whose blocks are not symmetric; otherwise as `cyclic_solver`.

Column i + 1 is coupled to column i by ``-lower[i]``, and i to i + 1 by ``-upper[i]``, row by row; the
last one and the first likewise. All blocks are stored transposed, since the vector operations combine
rows.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel, kernel
from bearing_fmu.kernels.vector import LANES, add_rows, set_rows, subtract_rows

Floats = NDArray[np.float64]


@inner_kernel
def _invert(s: Floats, at: int, n: int, width: int, factor: Floats) -> bool:
    """Invert the block at `at` in place, by Gauss and Jordan's method with row pivots; False if singular."""
    order = factor[width : 2 * width]
    for pivot in range(n):
        best, size = pivot, abs(s[at + pivot * width + pivot])
        for j in range(pivot + 1, n):
            if abs(s[at + j * width + pivot]) > size:
                best, size = j, abs(s[at + j * width + pivot])
        if not size > 0.0:
            return False
        order[pivot] = best
        row = at + pivot * width
        if best != pivot:
            for k in range(n):
                s[row + k], s[at + best * width + k] = s[at + best * width + k], s[row + k]
        for j in range(n):
            factor[j] = s[at + j * width + pivot]
            s[at + j * width + pivot] = 0.0
        factor[pivot] = 1.0 / factor[pivot]
        s[row + pivot] = 1.0
        for k in range(0, width, LANES):
            set_rows(s, row + k, factor, pivot, 0, s, row + k, 0, 1)
            for j in range(n):
                if j != pivot:
                    subtract_rows(s, at + j * width + k, factor, j, 0, s, row + k, 0, 1)
    for pivot in range(n - 1, -1, -1):
        best = int(order[pivot])
        if best != pivot:
            for j in range(n):
                here = at + j * width
                s[here + pivot], s[here + best] = s[here + best], s[here + pivot]
    return True


@inner_kernel
def _multiply(target: Floats, to: int, a: Floats, at: int, b: Floats, start: int, n: int, width: int) -> None:
    """Set one block to the product of two."""
    for j in range(n):
        for k in range(0, width, LANES):
            set_rows(target, to + j * width + k, a, at + j * width, 1, b, start + k, width, n)


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
    work : ndarray, shape (2 * (n + 1) * width,) or longer
        Work space.

    Returns
    -------
    bool
        False where a Schur complement is singular.
    """
    block = n * width
    last = (count - 1) * block
    v, u, row = work[:block], work[block : 2 * block], work[2 * block :]
    v[:] = 0.0
    u[:] = 0.0
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
        if not _invert(b, at, n, width, row):
            return False
        _multiply(w, at, v, 0, b, at, n, width)
        _multiply(y, at, b, at, u, 0, n, width)
        for j in range(n):
            for k in range(0, width, LANES):
                subtract_rows(b, last + j * width + k, w, at + j * width, 1, u, k, width, n)
        if i < count - 2:
            ahead = at + block
            for j in range(n):
                scale = upper[i * width + j]
                for k in range(n):
                    here = j * width + k
                    low = lower[i * width + k]
                    b[ahead + here] -= scale * b[at + here] * low
                    v[here] = w[at + here] * low
                    u[here] = scale * y[at + here]
    return _invert(b, last, n, width, row)


@inner_kernel
def transpose_ring(b: Floats, w: Floats, y: Floats, count: int, n: int, width: int) -> None:
    """Turn a factor into that of the transposed system: `lower` and `upper`, `w` and `y` change places."""
    for i in range(count):
        at = i * n * width
        for j in range(n):
            for k in range(j + 1, n):
                here, there = at + j * width + k, at + k * width + j
                b[here], b[there] = b[there], b[here]
                w[here], w[there] = w[there], w[here]
                y[here], y[there] = y[there], y[here]


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
    row : ndarray, shape (sides * width,)
        Work space.
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
