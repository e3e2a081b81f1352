"""Guembel's condition, integrated inside the grid cells.

Negative pressure is zeroed.  Between two neighbouring nodes on the circumference the pressure is
taken as linear, so that it is cut exactly where it crosses zero; nodal zeroing would make the
stiffness jump each time a node crosses.  The cut integral is written so that it joins the
trapezoidal rule, which on a ring converges faster than the integral of linear interpolants, with
continuous first derivatives.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import kernel

Floats = NDArray[np.float64]


@kernel
def bearing_part(p: Floats, count: int, nodal: Floats, own: Floats, ahead: Floats, behind: Floats) -> None:
    """Nodal values that integrate the positive part of p around the ring.

    With s = p_0 / (p_0 - p_1) the part of a cell before the zero, the integral of the positive part of p
    times a weight w over a cell is half its length times ::

        p_0 w_0 + p_1 w_1                              (both positive)
        p_0 s [w_0 + s (1 - s)(w_0 - w_1)]             (p_0 > 0 > p_1)

    Collected by nodes the integral is the sum of nodal_i w_i times the cell length.  In an empty film, of a
    centred journal say, every node is at the corner of the positive part; there the derivative is the mean of
    those on both sides.

    Parameters
    ----------
    p : ndarray, shape (m,)
        Pressure at the nodes; the first `count` are used.
    count : int
        Nodes of the ring.
    nodal : ndarray, shape (m,)
        Result; p itself away from zeros.
    own, ahead, behind : ndarray, shape (m,)
        Result: dnodal_i/dp_i, dnodal_i/dp_{i+1}, dnodal_{i+1}/dp_i.
    """
    nodal[:] = 0.0
    own[:] = 0.0
    ahead[:] = 0.0
    behind[:] = 0.0
    for i in range(count):
        k = i + 1 if i + 1 < count else 0
        p0 = p[i]
        p1 = p[k]
        if p0 >= 0.0 and p1 >= 0.0:
            nodal[i] += 0.5 * p0
            nodal[k] += 0.5 * p1
            share = 0.5 if p0 > 0.0 or p1 > 0.0 else 0.25
            own[i] += share
            own[k] += share
        elif p0 > 0.0:
            s = p0 / (p0 - p1)
            bend = s * s * (1.0 - s)
            slope = s * (2.0 - 3.0 * s)
            nodal[i] += 0.5 * p0 * (s + bend)
            nodal[k] -= 0.5 * p0 * bend
            own[i] += 0.5 * (s + bend + s * (1.0 - s) * (1.0 + slope))
            ahead[i] += 0.5 * s * s * (1.0 + slope)
            behind[i] -= 0.5 * (bend + s * (1.0 - s) * slope)
            own[k] -= 0.5 * s * s * slope
        elif p1 > 0.0:
            s = p1 / (p1 - p0)
            bend = s * s * (1.0 - s)
            slope = s * (2.0 - 3.0 * s)
            nodal[k] += 0.5 * p1 * (s + bend)
            nodal[i] -= 0.5 * p1 * bend
            own[k] += 0.5 * (s + bend + s * (1.0 - s) * (1.0 + slope))
            behind[i] += 0.5 * s * s * (1.0 + slope)
            ahead[i] -= 0.5 * (bend + s * (1.0 - s) * slope)
            own[i] -= 0.5 * s * s * slope
