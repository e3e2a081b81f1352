"""The discrete equations of V1 on a soft layer: what flows, and the residual; `layered_jacobian`: its slope.

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
from bearing_fmu.contact.layer import deflection, rough_flow, set_rough_flow
from bearing_fmu.films.tilted.layered import RATE, LayeredFilm
from bearing_fmu.films.tilted.layered_jacobian import BY_END, BY_GAP, BY_PRESS, set_jacobian
from bearing_fmu.kernels.cells import NEAR
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import COS, METRIC, SIN
from bearing_fmu.result import CONDUCTANCE, GAP, OPEN, OPEN_1, OPEN_2, POWER, SQUEEZE

Floats = NDArray[np.float64]

#: What the upstream column counts for above 1/2 in the deflection that is advected, over the square of how
#: steep that is: nothing is smeared where it is smooth, and no swing stays that goes from column to column.
STEEP = 0.3
_FLAT = 1e-12
_NONE = 1e-300  #: of a deflection over the clearance


@inner_kernel
def _gap(layered: LayeredFilm, s: float) -> tuple[float, float, float]:
    """Gap and its two derivatives by s, all over the clearance."""
    first, sigma = layered.constants[0], layered.constants[1]
    back, slope, bend = deflection(s / sigma, first, layered.table)
    return s + sigma * back, 1.0 + slope, bend / sigma


@inner_kernel
def _press_back(layered: LayeredFilm, ambient: float) -> None:
    """How far the film presses the wall back at the columns, and behind the last one at the first."""
    film, soft = layered.film, layered.constants[2]
    n, m = film.face.shape[1], film.circle.shape[2]
    for j in range(n):
        pressed, pressure = layered.pressed[j], film.pressures[0, j]
        for i in range(m):
            pressed[i] = soft * max(pressure[i] + ambient, 0.0)
        pressed[m] = pressed[0]


@inner_kernel
def _set_columns(layered: LayeredFilm) -> None:
    """Open gap at the columns."""
    film, sigma = layered.film, layered.constants[1]
    n, m = film.face.shape[1], film.circle.shape[2]
    near = REACH * sigma
    for j in range(n):
        gap, pressed = film.column[GAP, j], layered.pressed[j]
        open_, open_1, open_2 = film.column[OPEN, j], film.column[OPEN_1, j], film.column[OPEN_2, j]
        for i in range(m):
            open_[i] = gap[i] + pressed[i]
            open_1[i] = 1.0
            open_2[i] = 0.0
        for i in range(m):
            if open_[i] < near:
                h, h1, h2 = _gap(layered, open_[i])
                t, t1, t2 = flow_gap(h, sigma)
                open_[i], open_1[i], open_2[i] = t, t1 * h1, t2 * h1 * h1 + t1 * h2


@inner_kernel
def _set_flow(layered: LayeredFilm, gap: Floats, flow: Floats, slope: Floats) -> None:
    """Flow of gaps without asperities, and the changes of its logarithm by them."""
    m, sigma = layered.film.circle.shape[2], layered.constants[1]
    near, cube = REACH * sigma, sigma**3
    set_rough_flow(m, sigma, gap, flow, slope)
    for i in range(m):
        if gap[i] < near:
            h, h1, _ = _gap(layered, gap[i])
            rough, rough_1 = rough_flow(h / sigma)
            flow[i], slope[i] = cube * rough, rough_1 / (rough * sigma) * h1


@inner_kernel
def _set_across(layered: LayeredFilm, ambient: float) -> None:
    """Conductance along the axis at the axial faces, with its change by the gap."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    sigma, soft, s = layered.constants[1], layered.constants[2], layered.rows[0]
    metric, scale = film.rings[0, METRIC], 2.0 * np.pi / m * layered.constants[4]
    for k in range(1, n):
        row = int(layered.faces[k, 1])
        gap, along = layered.across[GAP, k], layered.across[CONDUCTANCE, k]
        for i in range(m):
            s[i] = gap[i]
        for near_by in range(NEAR):
            part, pressed = layered.faces[k, 2 + near_by], layered.pressed[row + near_by]
            for i in range(m):
                s[i] += part * pressed[i]
        _set_flow(layered, s, along, layered.across[BY_GAP, k])
        for i in range(m):
            along[i] *= scale * metric[i]
    press = soft * max(ambient, 0.0)
    for k in (0, n):
        row = 0 if k == 0 else n - 1
        gap, pressed, field = film.column[GAP, row], layered.pressed[row], layered.across[:, k]
        for i in range(m):
            flow, by_inside, by_end, by_press = edge_flow(
                (gap[i] + pressed[i]) / sigma,
                (field[GAP, i] + press) / sigma,
                max(pressed[i] - press, 0.0) / sigma,
                layered.edge,
            )
            field[CONDUCTANCE, i] = scale * sigma**3 * metric[i] * flow
            field[BY_GAP, i], field[BY_END, i] = by_inside / sigma, by_end / sigma
            field[BY_PRESS, i] = by_inside / sigma + (by_press / sigma if pressed[i] > press else 0.0)


@inner_kernel
def _set_faces(layered: LayeredFilm, speed: float) -> None:
    """Wedge and conductance around at the faces, with their changes by the deflection."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    cell, sigma, s = 2.0 * np.pi / m, layered.constants[1], layered.rows[0]
    metric, steep, near = film.rings[1, METRIC], STEEP if speed >= 0.0 else -STEEP, REACH * sigma
    for j in range(n):
        weight, gap, pressed = film.weights[j], film.face[GAP, j], layered.pressed[j]
        open_, open_1 = film.face[OPEN, j], film.face[OPEN_1, j]
        before, behind = layered.advected[0, j], layered.advected[1, j]
        for i in range(m):
            # the deflection that is advected, with its changes by those at the columns before and behind
            drop, both = pressed[i] - pressed[i + 1], pressed[i] + pressed[i + 1]
            ratio = drop / max(both, _NONE)
            more = steep * ratio * ratio
            by_drop, by_both = 3.0 * more, 0.5 - 2.0 * more * ratio
            s[i] = gap[i] + 0.5 * both
            open_[i] = gap[i] + 0.5 * both + more * drop
            before[i], behind[i] = by_both + by_drop, by_both - by_drop
        flow, slope = film.face[CONDUCTANCE, j], film.face[POWER, j]
        _set_flow(layered, s, flow, slope)
        for i in range(m):
            open_1[i] = 1.0
        for i in range(m):
            if open_[i] < near:
                h, h1, _ = _gap(layered, open_[i])
                t, t1, _ = flow_gap(h, sigma)
                open_[i], open_1[i] = t, t1 * h1
        bent, difference, scale = layered.advected[2, j], film.pressures[0, n + j], weight / cell
        for i in range(m):
            before[i] *= weight * speed * open_1[i]
            behind[i] *= weight * speed * open_1[i]
            flow[i] *= scale / metric[i]
            bent[i] = slope[i] * flow[i] * difference[i]
            slope[i] *= open_[i] / max(open_1[i], _FLAT)


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
    square, gives = 0.0, 2.0 * np.pi / m * layered.time[RATE]
    cos, sin, metric = film.rings[1, COS], film.rings[1, SIN], film.rings[0, METRIC]
    flow, side, dcos, dsin = layered.rows[0], layered.rows[1], layered.rows[2], layered.rows[3]
    pressures = film.pressures[0]
    _press_back(layered, ambient)
    _set_columns(layered)
    _set_faces(layered, speed)
    _set_across(layered, ambient)
    dcos[0], dsin[0] = cos[0] - cos[m - 1], sin[0] - sin[m - 1]
    for i in range(1, m):
        dcos[i], dsin[i] = cos[i] - cos[i - 1], sin[i] - sin[i - 1]
    for j in range(n):
        t, along, difference = film.face[OPEN, j], film.face[CONDUCTANCE, j], pressures[n + j]
        squeeze, t1 = film.column[SQUEEZE, j], film.column[OPEN_1, j]
        pressed, was = layered.pressed[j], layered.was[0, j]
        low, high = layered.across[CONDUCTANCE, j], layered.across[CONDUCTANCE, j + 1]
        below, above = pressures[2 * n + j], pressures[2 * n + j + 1]
        weight = film.weights[j]
        ux, uy = v[0] + v[3] * film.nodes[j], v[1] - v[2] * film.nodes[j]
        for i in range(m):
            squeeze[i] = uy * dcos[i] - ux * dsin[i] + gives * metric[i] * (pressed[i] - was[i])
        for i in range(m):
            flow[1 + i] = weight * speed * t[i] - along[i] * difference[i]
        flow[0] = flow[m]
        for i in range(m):
            side[i] = flow[i] - flow[1 + i] - 2.0 * weight * t1[i] * squeeze[i]
        for i in range(m):
            side[i] += high[i] * above[i] - low[i] * below[i]
        for i in range(m):
            square += side[i] * side[i]
            film.sides[i * width + j] = side[i]
    if whole:
        set_jacobian(layered, gives)
    return np.sqrt(square)
