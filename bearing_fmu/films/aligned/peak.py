"""The largest pressure over an aligned film, between its nodes, as `films.tilted.peak` finds it.

On most films it lies in the middle.  Beside a gap that opens fast it does not: there the middle is drawn down
more than the rest.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.films.aligned.workspace import AlignedFilm
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.summit import crest, largest, summit

Floats = NDArray[np.float64]


@inner_kernel
def largest_pressure(film: AlignedFilm, bore: Bore, middle: Floats, ambient: float) -> float:
    """Largest pressure over the film, of which the pressure in the middle and the bearing part are known."""
    m, modes = film.circle.shape[2], film.values.shape[0]
    column, line = largest(middle, m), 0
    if bore is None:  # over grooves, which reach to the ends, the axial functions swing
        best, top = middle[column], -np.inf
        for j in range(1, film.weights.shape[0], 2):  # which column, shows on any row
            at = largest(film.nodal[j, 0], m)
            if film.nodal[j, 0, at] > best:
                column, best = at, film.nodal[j, 0, at]
        for k in range(film.fine.shape[0]):
            value = 0.0
            for r in range(modes):
                value += film.fine[k, r] * film.modal[0, column, r]
            if value > top:
                line, top = k, value
    five = film.forcing[1]
    for i in range(5):
        at = column + i - 2
        at += m if at < 0 else (-m if at >= m else 0)
        five[i] = 0.0
        for r in range(modes):
            five[i] += film.fine[line, r] * film.modal[0, at, r]
    top = crest(five) if bore is None else summit(five[1], five[2], five[3])
    return max(top + ambient, 0.0)
