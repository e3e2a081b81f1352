"""Places for names along an axis that do not overlap."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def spread(wanted: Sequence[float], gap: float) -> list[float]:
    """Shift ascending positions as little as possible until neighbours are `gap` apart.

    Parameters
    ----------
    wanted : sequence of float
        Where the names would like to be, ascending.
    gap : float
        Least distance between neighbours, in the same unit.

    Returns
    -------
    list of float
        The positions with the least sum of squared shifts: the isotonic regression of
        ``wanted[i] - i gap`` by pooling adjacent violators (Barlow et al., 1972), moved back.
    """
    pools: list[tuple[float, int]] = []
    for index, position in enumerate(wanted):
        mean, count = position - index * gap, 1
        while pools and pools[-1][0] > mean:
            other, size = pools.pop()
            mean, count = (mean * count + other * size) / (count + size), count + size
        pools.append((mean, count))
    flat = np.concatenate([np.full(count, mean) for mean, count in pools]) if pools else np.empty(0)
    return [float(mean + index * gap) for index, mean in enumerate(flat)]
