"""Cubic splines over a disc: periodic around it, and smooth through its middle.

A line through the middle is one spline, since what lies at -r lies at r on the other side.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel

Floats = NDArray[np.float64]


def coefficients(values: Floats, flat: bool) -> Floats:
    """Coefficients of the uniform cubic B-splines through values on a disc.

    Parameters
    ----------
    values : ndarray, shape (n, m, parts)
        At n radii from 0 on and m angles from 0 on, m even.
    flat : bool
        Whether the slope vanishes at the last radius, so that a constant goes on smoothly; else the last two
        intervals have one cubic.

    Returns
    -------
    ndarray, shape (n + 2, m + 3, parts)
        One radius and one angle more before the first, and what follows the last.
    """
    n, m, parts = values.shape
    waves = np.fft.fftfreq(m)
    spectrum = np.fft.fft(values, axis=1) * (3.0 / (2.0 + np.cos(2.0 * np.pi * waves)))[:, None]
    found = np.empty((n + 2, m, parts), dtype=complex)
    for parity, of in ((1.0, np.arange(0, m, 2)), (-1.0, np.arange(1, m, 2))):
        matrix = np.zeros((n + 1, n + 1))
        rows = np.arange(n)
        matrix[rows, rows], matrix[rows, rows + 1] = 4.0 / 6.0, 1.0 / 6.0
        matrix[rows[1:], rows[1:] - 1] = 1.0 / 6.0
        matrix[0, 1] += parity / 6.0
        if flat:
            matrix[n, n], matrix[n, n - 2] = 1.0, -1.0
        else:
            matrix[n, n - 4 :] = 1.0, -4.0, 6.0, -4.0, 1.0
        right = np.concatenate((spectrum[:, of], np.zeros((1, of.size, parts))))
        solved = np.linalg.solve(matrix, right.reshape(n + 1, -1)).reshape(right.shape)
        found[1:, of], found[0, of] = solved, parity * solved[1]
    around = np.fft.ifft(found, axis=1).real
    return np.ascontiguousarray(np.concatenate((around[:, -1:], around, around[:, :2]), axis=1))


@inner_kernel
def blend(t: float, weight: Floats, slope: Floats) -> None:
    """Values and slopes of the four B-splines of an interval at its share t."""
    s = 1.0 - t
    weight[0] = s * s * s / 6.0
    weight[1] = (4.0 + t * t * (3.0 * t - 6.0)) / 6.0
    weight[2] = (4.0 + s * s * (3.0 * s - 6.0)) / 6.0
    weight[3] = t * t * t / 6.0
    slope[0] = -0.5 * s * s
    slope[1] = t * (1.5 * t - 2.0)
    slope[2] = s * (2.0 - 1.5 * s)
    slope[3] = 0.5 * t * t
