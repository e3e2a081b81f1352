"""The largest value of a function known at nodes, between them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel

Floats = NDArray[np.float64]

_PLACES = 8  # between two nodes, at which the polynomial is looked at


@inner_kernel
def largest(p: Floats, count: int) -> int:
    """Index of the largest of the first `count` values."""
    at = 0
    for i in range(count):
        if p[i] > p[at]:
            at = i
    return at


@inner_kernel
def summit(left: float, middle: float, right: float) -> float:
    """Summit of the parabola through three equidistant values, the middle one of which is the largest."""
    bend = 2.0 * middle - left - right
    rise = (right - left) ** 2 / (8.0 * bend) if bend > 0.0 else 0.0
    return middle + rise


@inner_kernel
def crest(p: Floats) -> float:
    """Largest value of the polynomial through five equidistant values, between the second and the fourth.

    A parabola through the nodes next to the largest one is up to three per cent off where few nodes stand for
    a peak, as in the wide gap.  Stirling's formula (Abramowitz and Stegun 1964, 25.2.28).
    """
    first, third = 0.5 * (p[3] - p[1]), 0.5 * (p[4] - 2.0 * (p[3] - p[1]) - p[0])
    second, fourth = p[3] - 2.0 * p[2] + p[1], p[4] + p[0] - 4.0 * (p[3] + p[1]) + 6.0 * p[2]
    top = p[2]
    for k in range(-_PLACES, _PLACES + 1):
        s = k / _PLACES
        bent = (s * s - 1.0) / 6.0
        top = max(top, p[2] + s * (first + bent * third) + 0.5 * s * s * (second + 0.5 * bent * fourth))
    return top


@inner_kernel
def summit_of_ring(p: Floats, count: int) -> float:
    """Largest pressure on a ring of `count` nodes: the summit of the parabola at the largest value."""
    at = largest(p, count)
    left, right = p[at - 1 if at > 0 else count - 1], p[at + 1 if at + 1 < count else 0]
    return max(summit(left, p[at], right), 0.0)
