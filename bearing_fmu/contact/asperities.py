"""Greenwood and Tripp's integral over the heights of asperities."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

#: Gap from which on the contact pressure is taken as zero: F_5/2(7) is 1e-13 of F_5/2(0).
REACH = 7.0


def asperity_integral(order: float, gap: Floats | float) -> Floats:
    """F_n(H) for n = 1/2, 1, 3/2, ... to about 1e-13 relative.

    With s = H + x^2 the integrand 2 x^(2n + 1) exp(-(H + x^2)^2 / 2) is even over the real line for
    odd 2n, where the trapezoidal rule converges exponentially; for integer n it is of high order at 0.

    Parameters
    ----------
    order : float
        n.
    gap : array_like
        H, gap over roughness; negative where the mean lines overlap.

    Returns
    -------
    ndarray
        Shape of `gap`.
    """
    h = np.asarray(gap, dtype=np.float64)
    widest = np.sqrt(max(0.0, -float(h.min(initial=0.0))) + 9.0)
    step = 0.01
    x = step * np.arange(1, int(widest / step) + 2)
    weight = 2.0 * step / np.sqrt(2.0 * np.pi) * x ** (2.0 * order + 1.0)
    return np.exp(-0.5 * (h[..., None] + x**2) ** 2) @ weight
