"""Grooves in the bore, as in `bearing_fmu.films.tilted.grooves`, for axial modes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.films.aligned.workspace import AlignedFilm
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.copied import copy
from bearing_fmu.result import CONDUCTANCE, GAP, OPEN, OPEN_1, SQUEEZE

Floats = NDArray[np.float64]


@stage
def links(film: AlignedFilm, bore: Bore) -> Floats:
    """What couples neighbouring columns: the conductances, but not next to columns of given pressure."""
    along = film.fields[1, CONDUCTANCE]
    if bore is None:
        return along
    cut, m = film.forcing[7], film.circle.shape[2]
    copy(along, cut)
    for i in bore.held:
        cut[i] = 0.0
        cut[i - 1 if i > 0 else m - 1] = 0.0
    return cut


@inner_kernel
def hold_grooves(film: AlignedFilm, bore: Bore, pressure: float) -> None:
    """Right-hand sides for the feed pressure, over the ambient one, in the columns of grooves."""
    if bore is not None:
        m = film.circle.shape[2]
        along, axial = film.fields[1, CONDUCTANCE], film.fields[0, CONDUCTANCE]
        for i in bore.held:
            back = i - 1 if i > 0 else m - 1
            fore = i + 1 if i + 1 < m else 0
            for r in range(film.values.shape[0]):
                film.modal[0, back, r] += along[back] * pressure * film.drive[r]
                film.modal[0, fore, r] += along[i] * pressure * film.drive[r]
        for i in bore.held:
            back = i - 1 if i > 0 else m - 1
            for r in range(film.values.shape[0]):
                diagonal = film.values[r] * axial[i] + along[i] + along[back]
                film.modal[0, i, r] = diagonal * pressure * film.drive[r]


@inner_kernel
def pressure_drag(film: AlignedFilm, bore: Bore, ambient: float) -> float:
    """Integral of H dp/dphi over the bearing part of the pressure; of a plain bore the force tells it."""
    total = 0.0
    if bore is not None:
        m, gap, above = film.circle.shape[2], film.fields[1, GAP], film.forcing[0]
        for j in range(film.weights.shape[0]):
            for i in range(m):
                above[i] = ambient
                for r in range(film.values.shape[0]):
                    above[i] += film.shapes[j, r] * film.modal[0, i, r]
                above[i] = max(above[i], 0.0)
            for i in range(m):
                fore = i + 1 if i + 1 < m else 0
                total += film.weights[j] * bore.inside[1, i] * gap[i] * (above[fore] - above[i])
    return total


@inner_kernel
def side_flow(film: AlignedFilm, bore: Bore, speed: float) -> float:
    """Flow out at both ends, as in `bearing_fmu.films.tilted.side_flow`."""
    total = 0.0
    for i in range(film.circle.shape[2]):
        total += _outflow(film, i, speed)
    if bore is not None:
        for i in bore.held:
            total -= _outflow(film, i, speed)
    return total


@inner_kernel
def _outflow(film: AlignedFilm, i: int, speed: float) -> float:
    back, modes = i - 1 if i > 0 else film.circle.shape[2] - 1, film.values.shape[0]
    flow, open_ = 0.0, film.fields[1, OPEN]
    for r in range(modes):
        flow += film.outflow[r] * film.modal[0, i, r]
    opens = speed * (open_[i] - open_[back]) + 2.0 * film.fields[0, OPEN_1, i] * film.fields[0, SQUEEZE, i]
    return max(flow * film.fields[0, CONDUCTANCE, i] + film.outflow[modes] * opens, 0.0)
