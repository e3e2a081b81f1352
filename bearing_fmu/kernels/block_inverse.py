"""Inverse of a dense block that is not symmetric, by pairs of pivots where these serve."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.copied import copy
from bearing_fmu.kernels.cyclic_solver import eliminate
from bearing_fmu.kernels.vector import (
    LANES,
    TILE,
    add_rows,
    set_product,
    set_rows,
    subtract_rows,
    subtract_tile,
)

Floats = NDArray[np.float64]

_LEAST = 1e-3
"""Of a pair's determinant over what it is the difference of, below which other pivots are searched for."""


@inner_kernel
def ones_at(width: int) -> int:
    """Return where in the work space ones stand, at least eight, behind `set_windows`."""
    return 4 * width + 4


@inner_kernel
def _invert_by_pairs(s: Floats, at: int, n: int, width: int, work: Floats, kept: Floats) -> bool:
    """Invert the block at `at` in place, by pairs of pivots on the diagonal; it is `kept`, too.

    Rows are read and written by whole vectors only, since a vector that was written in parts cannot be read
    before all of it has reached the cache; so windows, see `set_windows`, blank and set what belongs to the
    pair.

    Returns
    -------
    bool
        False where too little is left of a pair.
    """
    pair, inverse = 2 * width, 4 * width
    blank, unit = ones_at(width), ones_at(width) + 2 * width
    tiled, one = n // TILE * TILE, blank
    for pivot in range(0, n, 2):
        row = at + pivot * width
        for j in range(n):
            place = at + j * width + pivot
            work[j], work[width + j] = s[place], s[place + 1]
        a, b, c, d = work[pivot], work[width + pivot], work[pivot + 1], work[width + pivot + 1]
        first = pivot * (width + 1)
        scale, before = a * d - b * c, kept[first] * kept[first + width + 1]
        if not abs(scale) > _LEAST * max(abs(a * d) + abs(b * c), abs(before)):
            return False
        scale = 1.0 / scale
        a, b, c, d = d * scale, -b * scale, -c * scale, a * scale
        work[inverse], work[inverse + 1], work[inverse + 2], work[inverse + 3] = a, b, c, d
        work[pivot], work[pivot + 1], work[width + pivot], work[width + pivot + 1] = 0.0, 0.0, 0.0, 0.0
        for k in range(0, width, LANES):
            here = blank + width - pivot + k
            for j in range(2):
                set_product(s, row + j * width + k, s, row + j * width + k, work, here)
            for j in range(2):
                to = pair + j * width + k
                set_rows(work, to, work, inverse + 2 * j, 1, s, row + k, width, 2)
                add_rows(work, to, work, inverse + 2 * j, 1, work, unit + width - pivot + k, -1, 2)
            for j in range(0, tiled, TILE):
                subtract_tile(
                    s, at + j * width + k, width, work, here, work, j, width, 1, work, pair + k, width, 2
                )
            for j in range(tiled, n):
                set_product(s, at + j * width + k, s, at + j * width + k, work, here)
                subtract_rows(s, at + j * width + k, work, j, width, work, pair + k, width, 2)
            for j in range(2):
                set_rows(s, row + j * width + k, work, one, 0, work, pair + j * width + k, 0, 1)
    return True


@inner_kernel
def set_windows(n: int, width: int, work: Floats) -> None:
    """Prepare what blanks the columns of a pair, and what is one in one of them."""
    blank = ones_at(width)
    for k in range(4 * width):
        work[blank + k] = 1.0 if k < 2 * width else 0.0
    work[blank + width], work[blank + width + 1] = 0.0, 0.0
    work[blank + 3 * width] = 1.0


@inner_kernel
def invert(s: Floats, at: int, n: int, width: int, factor: Floats, kept: Floats) -> bool:
    """Invert the block at `at` in place, by Gauss and Jordan's method with row pivots; False if singular."""
    if n % 2 == 0:
        block = n * width
        copy(s[at : at + block], kept[:block])
        if _invert_by_pairs(s, at, n, width, factor, kept):
            return True
        copy(kept[:block], s[at : at + block])
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
        eliminate(s, at, n, width, pivot, factor)
    for pivot in range(n - 1, -1, -1):
        best = int(order[pivot])
        if best != pivot:
            for j in range(n):
                here = at + j * width
                s[here + pivot], s[here + best] = s[here + best], s[here + pivot]
    return True
