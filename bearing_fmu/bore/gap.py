"""The gap between journal and bore, and what of it carries the oil flow."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel, kernel

Floats = NDArray[np.float64]

#: Part of the roughness that stays open to the oil however deep the asperities are pressed.
RESIDUAL = 0.1
#: From this gap on, in roughnesses, the oil flows through the geometric gap.
ROUGH_LIMIT = 3.0 + RESIDUAL


@kernel
def flow_gap(h: float, sigma: float) -> tuple[float, float, float]:
    """Gap that carries the oil, over the gap between the mean lines, with two derivatives.

    Patir and Cheng's average gap (1978, Eq. 4), the expectation of the open part of a rough gap,
    with asperity heights s distributed after Christensen (1970), f(s) = 35/96 (1 - s^2/9)^3 in
    standard deviations, which has bounded support; the valleys keep a residual gap r = 0.1 ::

        T / sigma = r + E[max(h / sigma - r + s, 0)]

    T is twice continuously differentiable, positive, and exactly h for h >= 3.1 sigma.
    """
    if h >= ROUGH_LIMIT * sigma:
        return h, 1.0, 0.0
    x = (h / sigma - RESIDUAL) / 3.0
    if x <= -1.0:
        return RESIDUAL * sigma, 0.0, 0.0
    x2 = x * x
    below = 0.5 + 35.0 / 32.0 * x * (1.0 - x2 * (1.0 - x2 * (0.6 - x2 / 7.0)))
    even = x2 * (0.5 - x2 * (0.25 - x2 * (0.1 - x2 / 56.0)))
    open_part = 0.5 * (x + 1.0) + 35.0 / 32.0 * even - 93.0 / 256.0
    return sigma * (RESIDUAL + 3.0 * open_part), below, 35.0 / 96.0 * (1.0 - x2) ** 3 / sigma


@inner_kernel
def flow_gaps(h: Floats, sigma: float, rough: bool, t: Floats, t1: Floats, t2: Floats) -> None:
    """`flow_gap` of an array; with `rough` False no point is below the limit."""
    if rough:
        for i in range(h.shape[0]):
            t[i], t1[i], t2[i] = flow_gap(h[i], sigma)
    else:
        for i in range(h.shape[0]):
            t[i] = h[i]
            t1[i] = 1.0
            t2[i] = 0.0
