"""The discrete equations of V1 on a soft layer: residual and Jacobian.

Film and asperities press the wall back, and the gap follows from both: at each node the rigid gap plus c
times the film's pressure is the gap s without asperities, from which `bearing_fmu.contact.layer` gives
the gap; there the oil flows by Patir and Cheng's flow factor, and the wedge is the average gap of
`bore.gap`. Around the circumference the equations are those of `reynolds`, now not linear in the
pressure; along the axis they balance cells, see `kernels.cells`, since the pressure is not smooth where
surfaces overlap at an end, and polynomials swing. Where a film presses the wall back it advects its own
deflection, which is taken more from the upstream column, the steeper it is. How far the wall had
given way before a step, see `deformation`, makes its rate, which counts in the squeezed volume as that of
the journal does, by implicit Euler.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.gap import flow_gap
from bearing_fmu.contact.asperities import REACH
from bearing_fmu.contact.edge import edge_flow
from bearing_fmu.contact.layer import deflection, rough_flow
from bearing_fmu.films.tilted.layered import RATE, LayeredFilm
from bearing_fmu.kernels.cells import NEAR
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import COS, METRIC, SIN
from bearing_fmu.result import CONDUCTANCE, GAP, OPEN, OPEN_1, OPEN_2, POWER, SQUEEZE

Floats = NDArray[np.float64]

#: What the upstream column counts for above 1/2 in the deflection that is advected, over the square of how
#: steep that is: nothing is smeared where it is smooth, and no swing stays that goes from column to column.
STEEP = 0.3
_FLAT = 1e-12
#: Change of the logarithm of an axial conductance by the gap; of the ends' by that in the middle of the last
#: cell, by that at the end, and by how far the film presses back.
BY_GAP, BY_END, BY_PRESS = POWER, OPEN_1, OPEN_2


@inner_kernel
def _gap(layered: LayeredFilm, s: float) -> tuple[float, float, float]:
    """Gap and its two derivatives by s, all over the clearance."""
    first, sigma = layered.constants[0], layered.constants[1]
    back, slope, bend = deflection(s / sigma, first, layered.table)
    return s + sigma * back, 1.0 + slope, bend / sigma


@inner_kernel
def _set_columns(layered: LayeredFilm, ambient: float) -> None:
    """Open gap at the columns."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    sigma, soft = layered.constants[1], layered.constants[2]
    near = REACH * sigma
    for j in range(n):
        field, pressure = film.column[:, j], film.pressures[0, j]
        for i in range(m):
            h = field[GAP, i] + soft * max(pressure[i] + ambient, 0.0)
            t, t1, t2 = h, 1.0, 0.0
            if h < near:
                h, h1, h2 = _gap(layered, h)
                t, t1, t2 = flow_gap(h, sigma)
                t1, t2 = t1 * h1, t2 * h1 * h1 + t1 * h2
            field[OPEN, i], field[OPEN_1, i], field[OPEN_2, i] = t, t1, t2


@inner_kernel
def _set_across(layered: LayeredFilm, ambient: float) -> None:
    """Conductance along the axis at the axial faces, with its change by the gap."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    sigma, soft = layered.constants[1], layered.constants[2]
    metric, near = film.rings[0, METRIC], REACH * sigma
    scale = 2.0 * np.pi / m * sigma**3 * layered.constants[4]
    for k in range(1, n):
        row = int(layered.faces[k, 1])
        gap, along, by_gap = (
            layered.across[GAP, k],
            layered.across[CONDUCTANCE, k],
            layered.across[BY_GAP, k],
        )
        for i in range(m):
            along[i] = gap[i]
        for near_by in range(NEAR):
            part = soft * layered.faces[k, 2 + near_by]
            if part != 0.0:
                pressure = film.pressures[0, row + near_by]
                for i in range(m):
                    along[i] += part * max(pressure[i] + ambient, 0.0)
        for i in range(m):
            h, h1 = along[i], 1.0
            if h < near:
                h, h1, _ = _gap(layered, h)
            flow, flow1 = rough_flow(h / sigma)
            along[i], by_gap[i] = scale * metric[i] * flow, flow1 / (flow * sigma) * h1
    press = soft * max(ambient, 0.0)
    for k in (0, n):
        row = 0 if k == 0 else n - 1
        gap, pressure, field = film.column[GAP, row], film.pressures[0, row], layered.across[:, k]
        for i in range(m):
            pressed = soft * max(pressure[i] + ambient, 0.0)
            flow, by_inside, by_end, by_press = edge_flow(
                (gap[i] + pressed) / sigma,
                (field[GAP, i] + press) / sigma,
                max(pressed - press, 0.0) / sigma,
                layered.edge,
            )
            field[CONDUCTANCE, i] = scale * metric[i] * flow
            field[BY_GAP, i], field[BY_END, i] = by_inside / sigma, by_end / sigma
            field[BY_PRESS, i] = by_inside / sigma + (by_press / sigma if pressed > press else 0.0)


@inner_kernel
def _advected(here: float, there: float, steep: float) -> tuple[float, float, float]:
    """Deflection advected over a face, with its changes by those at the columns before and behind."""
    drop, both = here - there, here + there
    ratio = drop / both if both > 0.0 else 0.0
    more = steep * ratio * ratio
    by_drop, by_both = 3.0 * more, -2.0 * more * ratio
    return 0.5 * both + more * drop, 0.5 + by_drop + by_both, 0.5 - by_drop + by_both


@inner_kernel
def _set_faces(layered: LayeredFilm, speed: float, ambient: float) -> None:
    """Wedge and conductance around at the faces, with their changes by the deflection."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    cell, sigma, soft = 2.0 * np.pi / m, layered.constants[1], layered.constants[2]
    metric, steep = film.rings[1, METRIC], STEEP if speed >= 0.0 else -STEEP
    for j in range(n):
        field, scale, pressure = film.face[:, j], film.weights[j] / cell * sigma**3, film.pressures[0, j]
        for i in range(m):
            fore = i + 1 if i + 1 < m else 0
            here = soft * max(pressure[i] + ambient, 0.0)
            there = soft * max(pressure[fore] + ambient, 0.0)
            h, h1 = field[GAP, i] + 0.5 * (here + there), 1.0
            gone, by_here, by_there = _advected(here, there, steep)
            t, t1 = field[GAP, i] + gone, 1.0
            if h < REACH * sigma:
                h, h1, _ = _gap(layered, h)
            if t < REACH * sigma:
                t, own, _ = _gap(layered, t)
                t, t1, _ = flow_gap(t, sigma)
                t1 *= own
            flow, flow1 = rough_flow(h / sigma)
            slope = flow1 / (flow * sigma) * h1
            field[OPEN, i], field[OPEN_1, i] = t, t1
            field[CONDUCTANCE, i] = scale / metric[i] * flow
            field[POWER, i] = slope * t / max(t1, _FLAT)
            wedge = film.weights[j] * speed * t1
            layered.advected[0, j, i], layered.advected[1, j, i] = by_here * wedge, by_there * wedge
            layered.advected[2, j, i] = slope * field[CONDUCTANCE, i] * (pressure[fore] - pressure[i])


@inner_kernel
def shape_across(layered: LayeredFilm, q: Floats) -> None:
    """Rigid gap at the axial faces."""
    film = layered.film
    m = film.circle.shape[2]
    cos, sin = film.rings[0, COS], film.rings[0, SIN]
    for k in range(layered.faces.shape[0]):
        z = layered.faces[k, 0]
        ex, ey, gap = q[0] + q[3] * z, q[1] - q[2] * z, layered.across[GAP, k]
        for i in range(m):
            gap[i] = 1.0 - ex * cos[i] - ey * sin[i]


@inner_kernel
def _add_axial(layered: LayeredFilm, ambient: float) -> None:
    """What flows along the axis, in the Jacobian."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    block, soft, b = n * width, layered.constants[2], layered.blocks[0]
    for q in range(n + 1):
        flux, by_gap, along = (
            layered.across[CONDUCTANCE, q],
            layered.across[BY_PRESS if q == 0 or q == n else BY_GAP, q],
            film.pressures[0, 2 * n + q],
        )
        end = q == 0 or q == n
        start = int(layered.faces[q, 1])
        for j in range(n):
            slope, share = film.slopes[q * n + j], 0.0
            if end:
                share = soft if j == (0 if q == 0 else n - 1) else 0.0
            elif start <= j < start + NEAR:
                share = soft * layered.faces[q, 2 + j - start]
            if slope != 0.0 or share != 0.0:
                pressure = film.pressures[0, j]
                for i in range(m):
                    presses = share if pressure[i] + ambient > 0.0 else 0.0
                    part = flux[i] * (slope + presses * by_gap[i] * along[i])
                    # into the cell before the face, out of the one after it
                    at = i * block + j * width + q
                    if q > 0:
                        b[at - 1] -= part
                    if q < n:
                        b[at] += part


@inner_kernel
def linearise(layered: LayeredFilm, v: Floats, speed: float, ambient: float, whole: bool) -> float:
    """Residual, and where the `whole` is wanted the Jacobian, transposed as the solver wants it.

    Returns
    -------
    float
        Norm of the residual.
    """
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    block, soft, square = n * width, layered.constants[2], 0.0
    rate, cell = layered.time[RATE], 2.0 * np.pi / m
    cos, sin, metric = film.rings[1, COS], film.rings[1, SIN], film.rings[0, METRIC]
    b, sides, pressures = layered.blocks[0], film.sides, film.pressures[0]
    _set_columns(layered, ambient)
    _set_faces(layered, speed, ambient)
    _set_across(layered, ambient)
    if whole:
        b[:] = 0.0
        _add_axial(layered, ambient)
    for j in range(n):
        t, along, squeeze = film.face[OPEN, j], film.face[CONDUCTANCE, j], film.column[SQUEEZE, j]
        t1, t2 = film.column[OPEN_1, j], film.column[OPEN_2, j]
        wedge, wedge_behind, bent = layered.advected[0, j], layered.advected[1, j], layered.advected[2, j]
        weight = film.weights[j]
        low, high = layered.across[CONDUCTANCE, j], layered.across[CONDUCTANCE, j + 1]
        ux, uy = v[0] + v[3] * film.nodes[j], v[1] - v[2] * film.nodes[j]
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            fore = i + 1 if i + 1 < m else 0
            squeeze[i] = uy * (cos[i] - cos[back]) - ux * (sin[i] - sin[back])
            gives = cell * metric[i] * rate
            squeeze[i] += gives * (soft * max(pressures[j, i] + ambient, 0.0) - layered.was[0, j, i])
            at = i * width + j
            if whole:
                here = soft if pressures[j, i] + ambient > 0.0 else 0.0
                there = soft if pressures[j, fore] + ambient > 0.0 else 0.0
                # flow at the face after column i: by the pressure of column i, and less that of the next
                own = along[i] + here * (wedge[i] - 0.5 * bent[i])
                next_ = along[i] - there * (wedge_behind[i] - 0.5 * bent[i])
                layered.lower[at], layered.upper[at] = own, next_
                b[i * block + j * width + j] += own
                b[i * block + j * width + j] += 2.0 * weight * here * (t2[i] * squeeze[i] + t1[i] * gives)
                b[fore * block + j * width + j] += next_
            flow = -along[i] * pressures[n + j, i] + weight * speed * t[i]
            before = -film.face[CONDUCTANCE, j, back] * pressures[n + j, back] + weight * speed * t[back]
            side = before - flow - 2.0 * weight * t1[i] * squeeze[i]
            side += high[i] * pressures[2 * n + j + 1, i] - low[i] * pressures[2 * n + j, i]
            sides[at] = side
            square += side * side
    return np.sqrt(square)
