"""Direct solution on a ring of columns: cyclic block tridiagonal, symmetric positive definite.

Unknowns sit in `count` columns around the circumference, `n` rows in each; a column is coupled to
its two neighbours row by row (diagonal blocks `-c`) and within itself by a dense block.  The columns
are eliminated in turn; the last one closes the ring and collects the fill.  For column i::

    S_0 = B_0,            S_{i+1} = B_{i+1} - c_i S_i^-1 c_i
    V_0 = -c_{N-1},       V_{i+1} = c_i S_i^-1 V_i          (coupling to the last column)
    S_{N-1} = B_{N-1} - sum V_i' S_i^-1 V_i

All arrays are flat with rows padded to `width`, a multiple of eight, and zero in the padding.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel, kernel
from bearing_fmu.kernels.vector import LANES, add_product, add_rows, set_rows, subtract_product, subtract_rows

Floats = NDArray[np.float64]


@inner_kernel
def eliminate(s: Floats, at: int, n: int, width: int, pivot: int, factor: Floats) -> None:
    """Take a pivot's step of the inversion of the block at `at` in place, by Gauss and Jordan's method."""
    row = at + pivot * width
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


@inner_kernel
def invert(s: Floats, at: int, n: int, width: int, factor: Floats) -> bool:
    """Invert the symmetric positive definite block at `at` in place; False if it is not definite."""
    for pivot in range(n):
        if not s[at + pivot * (width + 1)] > 0.0:
            return False
        eliminate(s, at, n, width, pivot, factor)
    return True


@kernel
def factorise(
    b: Floats, c: Floats, w: Floats, wt: Floats, v: Floats, row: Floats, count: int, n: int, width: int
) -> bool:
    """Eliminate the columns.

    Parameters
    ----------
    b : ndarray, shape (count * n * width,)
        Diagonal blocks; on return their Schur complements' inverses.
    c : ndarray, shape (count * width,)
        `-c[i]` couples column i and i + 1, the last one with the first.
    w, wt : ndarray, shape (count * n * width,)
        On return S_i^-1 V_i, the coupling of each column to the last one, and its transpose.
    v, row : ndarray, shape (n * width,), (width,) or longer
        Work space.

    Returns
    -------
    bool
        False where the system is not positive definite.
    """
    block = n * width
    last = (count - 1) * block
    v[:block] = 0.0
    for j in range(n):
        v[j * width + j] = -c[(count - 1) * width + j]
    for i in range(count - 1):
        at = i * block
        if i == count - 2:
            for j in range(n):
                v[j * width + j] -= c[i * width + j]
        if not invert(b, at, n, width, row):
            return False
        for j in range(n):
            for k in range(0, width, LANES):
                set_rows(w, at + j * width + k, b, at + j * width, 1, v, k, width, n)
        for j in range(n):
            for k in range(n):
                wt[at + k * width + j] = w[at + j * width + k]
        for j in range(n):
            for k in range(0, width, LANES):
                subtract_rows(b, last + j * width + k, v, j, width, w, at + k, width, n)
        if i < count - 2:
            ahead = at + block
            for j in range(n):
                for k in range(0, width, LANES):
                    here = j * width + k
                    set_rows(v, here, c, i * width + j, 0, w, at + here, 0, 1)
                    set_rows(row, k, c, i * width + j, 0, b, at + here, 0, 1)
                    subtract_product(b, ahead + here, row, k, c, i * width + k)
    return invert(b, last, n, width, row)


@kernel
def substitute(
    b: Floats,
    c: Floats,
    w: Floats,
    wt: Floats,
    x: Floats,
    y: Floats,
    count: int,
    n: int,
    width: int,
    sides: int,
) -> None:
    """Solve for `sides` right-hand sides with the factor of `factorise`.

    Parameters
    ----------
    b, c, w, wt : ndarray
        As left by `factorise`.
    x : ndarray, shape (count * sides * width,)
        Right-hand sides, for each column one row a side; on return the solution.
    y : ndarray, shape (sides * width,)
        Work space.
    """
    block = n * width
    rows = sides * width
    last = (count - 1) * rows
    for i in range(count):
        at = i * rows
        for k in range(rows):
            y[k] = x[at + k]
        for m in range(0, rows, width):
            for k in range(0, width, LANES):
                set_rows(x, at + m + k, y, m, 1, b, i * block + k, width, n)
                if i < count - 1:
                    subtract_rows(x, last + m + k, y, m, 1, w, i * block + k, width, n)
                if i < count - 2:
                    add_product(x, at + rows + m + k, c, i * width + k, x, at + m + k)
    for i in range(count - 2, -1, -1):
        at = i * rows
        for m in range(0, rows, width):
            for k in range(0, width, LANES):
                subtract_rows(x, at + m + k, x, last + m, 1, wt, i * block + k, width, n)
            if i < count - 2:
                for k in range(width):
                    y[k] = c[i * width + k] * x[at + rows + m + k]
                for k in range(0, width, LANES):
                    add_rows(x, at + m + k, y, 0, 1, b, i * block + k, width, n)
