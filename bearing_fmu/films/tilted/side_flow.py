"""The oil that leaves at the ends, from the discrete balance of mass.

The flow at an end is what the weak form leaves of the equation for the polynomial that is 1 there (the
consistent flux): it converges as the force does, the slope of the pressure at the end far slower.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore, fill_gap
from bearing_fmu.bore.gap import flow_gap
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import COS, SIN
from bearing_fmu.result import CONDUCTANCE, OPEN_1

Floats = NDArray[np.float64]


@inner_kernel
def side_flow(film: TiltedFilm, bore: Bore, q: Floats, v: Floats, speed: float, sigma: float) -> float:
    """Flow out at both ends of the columns that let oil out, over `scales.flow`; grooves are closed there."""
    n, m = film.face.shape[1], film.circle.shape[2]
    out, gap, total = film.forcing[3, 0], film.forcing[3, 1], 0.0
    ring = film.rings[1]
    cos, sin = ring[COS], ring[SIN]
    for end in range(2):
        z, weight = film.nodes[n + end], film.weights[n + end]
        fill_gap(bore, 1, q[0] + q[3] * z, q[1] - q[2] * z, ring, gap)
        for i in range(m):
            gap[i] = flow_gap(gap[i], sigma)[0]
        ux, uy = v[0] + v[3] * z, v[1] - v[2] * z
        opening = film.column[OPEN_1, n + end]
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            squeeze = uy * (cos[i] - cos[back]) - ux * (sin[i] - sin[back])
            out[i] = -weight * (speed * (gap[i] - gap[back]) + 2.0 * opening[i] * squeeze)
        for k in range(n + 2):
            slope, flux = film.ends[end, k], film.column[CONDUCTANCE, k]
            along = film.pressures[0, 2 * n + k]
            for i in range(m):
                out[i] -= slope * flux[i] * along[i]
        for i in range(m):
            total += max(out[i], 0.0)
        if bore is not None:
            for i in bore.held:
                total -= max(out[i], 0.0)
    return total
