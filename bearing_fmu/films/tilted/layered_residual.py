"""How the residual of the layered film changes with the journal's place, at a given pressure.

As `tangent.prepare` and `tangent.residual_tangent`, with the fluxes of cells along the axis.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.tilted import layered_equations as equations
from bearing_fmu.films.tilted.layered import LayeredFilm
from bearing_fmu.films.tilted.tangent import (
    BY_METRIC,
    TANGENT,
    gap_change,
    prepare_rows,
    row_tangent,
    turn_faces,
)
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import STRETCHING
from bearing_fmu.result import CONDUCTANCE

Floats = NDArray[np.float64]

_NEAR, _END = equations.BY_GAP, equations.BY_END


@inner_kernel
def prepare(layered: LayeredFilm, speed: float) -> None:
    """Derivatives of the residual by gap, metric and squeezed volume, in the stack's rows."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    pressure, by_metric = film.pressures[0], film.forcing[BY_METRIC]
    prepare_rows(film, speed)
    for k in range(n + 1):
        field, slope, metric = layered.across[:, k], pressure[2 * n + k], by_metric[2 * n + k]
        for i in range(m):
            metric[i] = -field[CONDUCTANCE, i] * slope[i]


@inner_kernel
def residual_tangent(layered: LayeredFilm, q: Floats, v: Floats, k: int) -> None:
    """Tangent of the residual along q_k."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    tangent, by_metric = film.forcing[TANGENT], film.forcing[BY_METRIC]
    change, along = film.forcing[3, 0, :m], film.rings[0, STRETCHING + k]
    turn_faces(film, k)
    tangent[3 * n + 1] = 0.0
    for face in range(n + 1):
        flow, out, end = by_metric[2 * n + face], tangent[2 * n + face], face == 0 or face == n
        z = layered.faces[face, 0] if not end else film.nodes[0 if face == 0 else n - 1]
        gap_change(film, None, q, k, 0, z, change)
        by_near, by_end = layered.across[_NEAR, face], layered.across[_END, face]
        for i in range(m):
            out[i] = flow[i] * (along[i] + by_near[i] * change[i])
        if end:
            gap_change(film, None, q, k, 0, layered.faces[face, 0], change)
            for i in range(m):
                out[i] += flow[i] * by_end[i] * change[i]
    for j in range(n):
        gap_change(film, None, q, k, 0, film.nodes[j], change)
        row_tangent(film, None, q, v, k, j)
