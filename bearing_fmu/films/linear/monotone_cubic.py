"""Cubics through points that do not overshoot: what the linear depth needs of `scipy.interpolate`.

That package itself brings in what crashes the end of Python 3.11 in hosts without one, see `fmus/README.md`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


class MonotoneCubic:
    """Cubics with the slopes of Fritsch and Butland (1984), as scipy's `PchipInterpolator`.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Ascending, two at least.
    y : ndarray, shape (n, ...)
        Values.
    """

    def __init__(self, x: Floats, y: Floats) -> None:
        self._x, self._y = x, y
        width = np.diff(x).reshape(-1, *[1] * (y.ndim - 1))
        chord = np.diff(y, axis=0) / width
        slope = _slopes(width, chord)
        bend = (slope[:-1] + slope[1:] - 2.0 * chord) / width
        self._coefficients = y[:-1], slope[:-1], (chord - slope[:-1]) / width - bend, bend / width

    def __call__(self, at: float) -> Floats:
        """Values at a place between the first and the last point."""
        i = int(np.clip(np.searchsorted(self._x, at, side="right") - 1, 0, self._x.size - 2))
        s = at - self._x[i]
        a, b, c, d = (one[i] for one in self._coefficients)
        return np.asarray(a + s * (b + s * (c + s * d)))


def _slopes(width: Floats, chord: Floats) -> Floats:
    """Slopes at all points from widths and slopes of the intervals."""
    if len(chord) == 1:
        return np.concatenate([chord, chord])
    one, two = 2.0 * width[1:] + width[:-1], width[1:] + 2.0 * width[:-1]
    turns = chord[1:] * chord[:-1] <= 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = (one + two) / (one / chord[:-1] + two / chord[1:])
    inner = np.where(turns, 0.0, mean)
    first = _at_end(width[0], width[1], chord[0], chord[1])
    last = _at_end(width[-1], width[-2], chord[-1], chord[-2])
    return np.concatenate([first[None], inner, last[None]])


def _at_end(near: Floats, far: Floats, chord: Floats, other: Floats) -> Floats:
    """Slope at an end by three points, bounded so that the end does not overshoot."""
    slope = ((2.0 * near + far) * chord - near * other) / (near + far)
    slope = np.where(np.sign(slope) != np.sign(chord), 0.0, slope)
    steep = (np.sign(chord) != np.sign(other)) & (np.abs(slope) > 3.0 * np.abs(chord))
    return np.where(steep, 3.0 * chord, slope)
