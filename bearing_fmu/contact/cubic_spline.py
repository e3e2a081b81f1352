"""Cubic splines that end not-a-knot: what the contact needs of `scipy.interpolate`, and the same numbers.

The FMUs go without that module.  It brings in `scipy._lib._uarray`, which crashes Python 3.11 where a native
host ends the interpreter after its last unit.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_banded

Floats = NDArray[np.float64]


def spline_coefficients(x: Floats, y: Floats, first_slope: float | None = None) -> Floats:
    """Interpolate by a cubic spline of two continuous derivatives.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Ascending, n >= 4.
    y : ndarray, shape (n, ...)
        Values there.
    first_slope : float, optional
        dy/dx at the first point; without it, as always at the other end, the outermost two intervals
        share one polynomial (not-a-knot).

    Returns
    -------
    ndarray, shape (4, n - 1, ...)
        Ascending powers of the distance from the left end of each interval.

    Notes
    -----
    The tridiagonal system of the slopes is that of de Boor, A Practical Guide to Splines, 2001, chapter IV.
    """
    dx = np.diff(x)
    dxr = dx.reshape(-1, *[1] * (y.ndim - 1))
    secant = np.diff(y, axis=0) / dxr
    bands, right = np.zeros((3, x.size)), np.empty_like(y)
    bands[1, 1:-1] = 2.0 * (dx[:-1] + dx[1:])
    bands[0, 2:], bands[2, :-2] = dx[:-1], dx[1:]
    right[1:-1] = 3.0 * (dxr[1:] * secant[:-1] + dxr[:-1] * secant[1:])
    if first_slope is None:
        span = x[2] - x[0]
        bands[1, 0], bands[0, 1] = dx[1], span
        right[0] = ((dxr[0] + 2.0 * span) * dxr[1] * secant[0] + dxr[0] ** 2 * secant[1]) / span
    else:
        bands[1, 0], bands[0, 1] = 1.0, 0.0
        right[0] = first_slope
    span = x[-1] - x[-3]
    bands[1, -1], bands[2, -2] = dx[-2], span
    right[-1] = (dxr[-1] ** 2 * secant[-2] + (2.0 * span + dxr[-1]) * dxr[-2] * secant[-1]) / span
    slope = solve_banded((1, 1), bands, right.reshape(x.size, -1)).reshape(y.shape)
    bend = (slope[:-1] + slope[1:] - 2.0 * secant) / dxr
    return np.stack((y[:-1], slope[:-1], (secant - slope[:-1]) / dxr - bend, bend / dxr))


def interpolate(x: Floats, y: Floats, at: Floats) -> Floats:
    """Values of the not-a-knot spline through (x, y), both of shape (n,), in the shape of `at`."""
    place = np.clip(np.searchsorted(x, at, side="right") - 1, 0, x.size - 2)
    c = spline_coefficients(x, y)
    s = at - x[place]
    return c[0, place] + c[1, place] * s + c[2, place] * (s * s) + c[3, place] * (s * s * s)
