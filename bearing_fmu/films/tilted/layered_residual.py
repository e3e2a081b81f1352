"""How the residual of the layered film changes with the journal's place, at a given pressure.

As `tangent.prepare` and `tangent.residual_tangent`, with the fluxes of cells along the axis.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.tilted import layered_equations as equations
from bearing_fmu.films.tilted.layered import LayeredFilm
from bearing_fmu.films.tilted.tangent import BY_GAP, BY_METRIC, TANGENT, gap_change
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import COS, MOTION, SIN, STRETCHING
from bearing_fmu.result import CONDUCTANCE, OPEN, OPEN_1, OPEN_2, POWER, SQUEEZE

Floats = NDArray[np.float64]

_NEAR, _END = equations.BY_GAP, equations.BY_END


@inner_kernel
def prepare(layered: LayeredFilm, speed: float) -> None:
    """Derivatives of the residual by gap, metric and squeezed volume, in the stack's rows."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    pressure = film.pressures[0]
    by_gap, by_metric = film.forcing[BY_GAP], film.forcing[BY_METRIC]
    for j in range(n):
        weight = film.weights[j]
        t1, t2, squeeze = film.column[OPEN_1, j], film.column[OPEN_2, j], film.column[SQUEEZE, j]
        at_node, volume = by_gap[j], by_metric[j]
        for i in range(m):
            at_node[i] = -2.0 * weight * t2[i] * squeeze[i]
            volume[i] = -2.0 * weight * t1[i]
        t, t1, conductance = film.face[OPEN, j], film.face[OPEN_1, j], film.face[CONDUCTANCE, j]
        difference, power = pressure[n + j], film.face[POWER, j]
        gap, metric = by_gap[n + j], by_metric[n + j]
        for i in range(m):
            flow = conductance[i] * difference[i]
            gap[i] = t1[i] * (weight * speed - power[i] * flow / t[i])
            metric[i] = flow
    for k in range(n + 1):
        field, slope, metric = layered.across[:, k], pressure[2 * n + k], by_metric[2 * n + k]
        for i in range(m):
            metric[i] = -field[CONDUCTANCE, i] * slope[i]


@inner_kernel
def residual_tangent(layered: LayeredFilm, q: Floats, v: Floats, k: int) -> None:
    """Tangent of the residual along q_k."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    tangent, by_gap, by_metric = film.forcing[TANGENT], film.forcing[BY_GAP], film.forcing[BY_METRIC]
    change, dcos, dsin = film.forcing[3, 0, :m], film.forcing[3, 1], film.forcing[3, 2]
    ring = film.rings[1]
    cos, sin, motion = ring[COS], ring[SIN], ring[MOTION + k]
    for i in range(m):
        back = i - 1 if i > 0 else m - 1
        dcos[i] = -sin[i] * motion[i] + sin[back] * motion[back]
        dsin[i] = cos[i] * motion[i] - cos[back] * motion[back]
    along, around = film.rings[0, STRETCHING + k], film.rings[1, STRETCHING + k]
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
        ux = v[0] + v[3] * film.nodes[j]
        uy = v[1] - v[2] * film.nodes[j]
        gap, metric, out = by_gap[j], by_metric[j], tangent[j]
        for i in range(m):
            out[i] = gap[i] * change[i] + metric[i] * (uy * dcos[i] - ux * dsin[i])
        gap_change(film, None, q, k, 1, film.nodes[j], change)
        gap, metric, out = by_gap[n + j], by_metric[n + j], tangent[n + j]
        for i in range(m):
            out[i] = gap[i] * change[i] + metric[i] * around[i]
