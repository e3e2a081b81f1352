"""Arrays that stand one after another in a store, each from a whole vector on."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.vector import LANES, padded

Floats = NDArray[np.float64]


def put_away(arrays: Iterable[Floats]) -> Floats:
    """The store of these arrays."""
    return np.concatenate([np.append(array, np.zeros(padded(array.size) - array.size)) for array in arrays])


def views(store: Floats, at: int, like: Iterable[Floats]) -> list[Floats]:
    """The arrays in a store from `at` on, which have the shapes of others."""
    found = []
    for array in like:
        found.append(store[at : at + array.size].reshape(array.shape))
        at += padded(array.size)
    return found


@inner_kernel
def _room(size: int) -> int:
    return LANES * -(-size // LANES)


@stage
def line(store: Floats, at: int, size: int) -> Any:
    """One of them with one index, and where the next one stands."""
    return store[at : at + size], at + _room(size)


@stage
def plane(store: Floats, at: int, rows: int, size: int) -> Any:
    """One with two."""
    return store[at : at + rows * size].reshape((rows, size)), at + _room(rows * size)


@stage
def block(store: Floats, at: int, planes: int, rows: int, size: int) -> Any:
    """One with three."""
    whole = planes * rows * size
    return store[at : at + whole].reshape((planes, rows, size)), at + _room(whole)
