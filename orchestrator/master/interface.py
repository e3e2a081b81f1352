"""The interface of rotor and bearings in numbers, asked for at every step."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import compiled, dot

Array = NDArray[np.float64]


@compiled
def largest_relative(defect: Array, forces: Array, loads: Array, levers: Array) -> float:
    """Return the largest component of wrenches (n, 4) against a scale; not a number where one is none.

    The scale is the load (n,), or the force in the first two columns of `forces` where that is larger, and of
    moments times the lever (n,).
    """
    largest = -math.inf
    for b in range(len(loads)):
        scale = max(loads[b], math.hypot(forces[b, 0], forces[b, 1]))
        for i in range(4):
            size = abs(defect[b, i]) if i < 2 else abs(defect[b, i]) / levers[b]
            size /= scale
            if size > largest or math.isnan(size):
                largest = size
    return largest


@compiled
def defects(laws: Array, motion: Array, forces: Array, defect: Array) -> None:
    """Overwrite defects, (n, 4), with F(q, v) - (F0 - K q - C v) of laws (n, 36) at motions (n, 8)."""
    for b in range(len(defect)):
        for i in range(4):
            found = forces[b, i] - laws[b, i]
            found += dot(laws[b, 4 + 4 * i : 8 + 4 * i], motion[b, :4])
            defect[b, i] = found + dot(laws[b, 20 + 4 * i : 24 + 4 * i], motion[b, 4:])


@compiled
def within(values: Array, bound: float) -> bool:
    """Whether all values, (n, m), are nearer to 0 than a bound; False of what is not a number."""
    for row in range(len(values)):
        for k in range(values.shape[1]):
            if not abs(values[row, k]) < bound:
                return False
    return True
