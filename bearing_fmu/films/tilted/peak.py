"""The largest pressure over a tilted film, between its nodes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.summit import crest, summit

Floats = NDArray[np.float64]


@inner_kernel
def largest_pressure(film: TiltedFilm, bore: Bore, ambient: float) -> float:
    """Largest pressure over the film.

    The axial polynomial is sampled between its nodes in the column of the largest nodal value; around the
    circumference the polynomial through five columns is taken on the best line and its neighbours.  In a bore
    with edges, at which the pressure bends, that swings, and a parabola serves.
    """
    n, m = film.face.shape[1], film.circle.shape[2]
    top, column = 0.0, 0
    for j in range(n):
        pressure = film.pressures[0, j]
        for i in range(m):
            if pressure[i] > top:
                top, column = pressure[i], i
    line, best = 0, 0.0
    for k in range(film.fine.shape[0]):
        value = 0.0
        for j in range(n):
            value += film.fine[k, j] * film.pressures[0, j, column]
        if value > best:
            line, best = k, value
    five = film.row[:5]
    for k in range(max(line - 1, 0), min(line + 2, film.fine.shape[0])):
        five[:] = 0.0
        for i in range(5):
            at = column + i - 2
            at += m if at < 0 else (-m if at >= m else 0)
            for j in range(n):
                five[i] += film.fine[k, j] * film.pressures[0, j, at]
        top = max(top, crest(five) if bore is None else summit(five[1], five[2], five[3]))
    return max(top + ambient, 0.0)
