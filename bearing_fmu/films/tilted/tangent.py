"""Exact tangent of the wrench of the tilted film by adjoint solutions.

With the discrete equations A(q) p = r(q, v) and the wrench F(p, q)::

    dF_m = lambda_m' (dr - dA p) + dF_m|p,   A lambda_m = dF_m/dp

`dr - dA p` is kept in the form in which it arises, a value at each node, a flow at each face and an
axial flow at each node, to be contracted with the values, differences and slopes of lambda_m.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore, fill_gap_change
from bearing_fmu.films.tilted.lines import SHARE, add_line_sides
from bearing_fmu.films.tilted.reynolds import unfold
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.cyclic_solver import substitute
from bearing_fmu.kernels.grid import COS, METRIC, MOTION, SIN, STRETCHING
from bearing_fmu.result import CONDUCTANCE, DAMPING, OPEN, OPEN_1, OPEN_2, POWER, SQUEEZE, STIFFNESS

Floats = NDArray[np.float64]

# What the tangent of the residual is made of: its change with the gap, with the metric, and (at the
# nodes, in the rows of the metric's part) with the squeezed volume.
TANGENT, BY_GAP, BY_METRIC = 0, 1, 2


@inner_kernel
def _rest(film: TiltedFilm, bore: Bore) -> None:
    """No adjoint pressure where the pressure is given."""
    if bore is not None:
        size = film.sides.shape[0] // film.circle.shape[2]
        for i in bore.held:
            film.sides[i * size : (i + 1) * size] = 0.0


@inner_kernel
def adjoint_sides(film: TiltedFilm) -> None:
    """Derivatives of the four components of the film's wrench by the pressure, as right-hand sides."""
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    cell = 2.0 * np.pi / m
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    sides = film.sides
    sides[:] = 0.0
    if film.mixed[SHARE] > 0.0:
        add_line_sides(film)
        return
    for j in range(n):
        own, ahead, behind = film.nodal[1, j], film.nodal[2, j], film.nodal[3, j]
        z, weight = film.nodes[j], -film.weights[j] * cell
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            fore = i + 1 if i + 1 < m else 0
            w0 = weight * own[i] * metric[i]
            w1 = weight * ahead[back] * metric[back]
            w2 = weight * behind[i] * metric[fore]
            along = w0 * cos[i] + w1 * cos[back] + w2 * cos[fore]
            across = w0 * sin[i] + w1 * sin[back] + w2 * sin[fore]
            at = i * 4 * width + j
            sides[at] = along
            sides[at + width] = across
            sides[at + 2 * width] = -z * across
            sides[at + 3 * width] = z * along


@stage
def _solve_adjoints(film: TiltedFilm, bore: Bore) -> None:
    """Adjoint pressures 1-4, for the four components of the wrench."""
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    adjoint_sides(film)
    _rest(film, bore)
    b, w, wt = film.blocks[0], film.blocks[1], film.blocks[2]
    substitute(b, film.coupling, w, wt, film.sides, film.row, m, n, width, 4)
    for k in range(4):
        unfold(film, k + 1, k, 4)


@inner_kernel
def prepare_rows(film: TiltedFilm, speed: float) -> None:
    """Derivatives by gap, metric and squeezed volume of what rows hold and what flows around."""
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


@inner_kernel
def prepare(film: TiltedFilm, speed: float) -> None:
    """Derivatives of the residual by gap, metric and squeezed volume, in the stack's rows."""
    prepare_rows(film, speed)
    n, m = film.face.shape[1], film.circle.shape[2]
    pressure = film.pressures[0]
    by_gap, by_metric = film.forcing[BY_GAP], film.forcing[BY_METRIC]
    for j in range(n + 2):
        t, t1, conductance = film.column[OPEN, j], film.column[OPEN_1, j], film.column[CONDUCTANCE, j]
        slope, power = pressure[2 * n + j], film.column[POWER, j]
        gap, metric = by_gap[2 * n + j], by_metric[2 * n + j]
        for i in range(m):
            flow = conductance[i] * slope[i]
            gap[i] = -power[i] * t1[i] * flow / t[i]
            metric[i] = -flow


@inner_kernel
def gap_change(film: TiltedFilm, bore: Bore, q: Floats, k: int, side: int, z: float, change: Floats) -> None:
    """dH/dq_k at one z, with the motion of the grid."""
    ex = q[0] + q[3] * z
    ey = q[1] - q[2] * z
    # -dH/dq_k at a fixed angle is cos, sin, -z sin, z cos.
    fc = -1.0 if k == 0 else (-z if k == 3 else 0.0)
    fs = -1.0 if k == 1 else (z if k == 2 else 0.0)
    fill_gap_change(bore, side, ex, ey, fc, fs, k, film.rings[side], change)


@inner_kernel
def turn_faces(film: TiltedFilm, k: int) -> None:
    """How the differences of cosine and sine over a column change along q_k, as the grid moves."""
    m, dcos, dsin = film.circle.shape[2], film.forcing[3, 1], film.forcing[3, 2]
    ring = film.rings[1]
    cos, sin, motion = ring[COS], ring[SIN], ring[MOTION + k]
    for i in range(m):
        back = i - 1 if i > 0 else m - 1
        dcos[i] = -sin[i] * motion[i] + sin[back] * motion[back]
        dsin[i] = cos[i] * motion[i] - cos[back] * motion[back]


@inner_kernel
def row_tangent(film: TiltedFilm, bore: Bore, q: Floats, v: Floats, k: int, j: int) -> None:
    """Tangent along q_k of what row j holds and of what flows around in it; its dH/dq_k is known."""
    n, m = film.face.shape[1], film.circle.shape[2]
    tangent, by_gap, by_metric = film.forcing[TANGENT], film.forcing[BY_GAP], film.forcing[BY_METRIC]
    change, dcos, dsin = film.forcing[3, 0, :m], film.forcing[3, 1], film.forcing[3, 2]
    around = film.rings[1, STRETCHING + k]
    ux = v[0] + v[3] * film.nodes[j]
    uy = v[1] - v[2] * film.nodes[j]
    gap, metric, out = by_gap[j], by_metric[j], tangent[j]
    for i in range(m):
        out[i] = gap[i] * change[i] + metric[i] * (uy * dcos[i] - ux * dsin[i])
    gap_change(film, bore, q, k, 1, film.nodes[j], change)
    gap, metric, out = by_gap[n + j], by_metric[n + j], tangent[n + j]
    for i in range(m):
        out[i] = gap[i] * change[i] + metric[i] * around[i]


@inner_kernel
def residual_tangent(film: TiltedFilm, bore: Bore, q: Floats, v: Floats, k: int) -> None:
    """Tangent of the residual along q_k."""
    n, m = film.face.shape[1], film.circle.shape[2]
    tangent, by_gap, by_metric = film.forcing[TANGENT], film.forcing[BY_GAP], film.forcing[BY_METRIC]
    change, along = film.forcing[3, 0, :m], film.rings[0, STRETCHING + k]
    turn_faces(film, k)
    for j in range(n + 2):
        gap_change(film, bore, q, k, 0, film.nodes[j], change)
        gap, metric, out = by_gap[2 * n + j], by_metric[2 * n + j], tangent[2 * n + j]
        for i in range(m):
            out[i] = gap[i] * change[i] + metric[i] * along[i]
        if j < n:
            row_tangent(film, bore, q, v, k, j)


@inner_kernel
def contract(film: TiltedFilm, k: int, result: Floats) -> None:
    """dF/dq_k through the pressure."""
    tangent = film.forcing[TANGENT].reshape(-1)
    a0, a1 = film.pressures[1].reshape(-1), film.pressures[2].reshape(-1)
    a2, a3 = film.pressures[3].reshape(-1), film.pressures[4].reshape(-1)
    s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
    for r in range(tangent.shape[0]):
        s0 += a0[r] * tangent[r]
        s1 += a1[r] * tangent[r]
        s2 += a2[r] * tangent[r]
        s3 += a3[r] * tangent[r]
    result[STIFFNESS + k] = s0
    result[STIFFNESS + 4 + k] = s1
    result[STIFFNESS + 8 + k] = s2
    result[STIFFNESS + 12 + k] = s3


@inner_kernel
def add_grid_motion(film: TiltedFilm, result: Floats) -> None:
    """dF/dq at fixed nodal pressures: the quadrature moves with the grid."""
    n, m = film.face.shape[1], film.circle.shape[2]
    cell = 2.0 * np.pi / m
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    force, lever = film.forcing[3, 0], film.forcing[3, 1]
    force[:] = 0.0
    lever[:] = 0.0
    for j in range(n):
        part = film.nodal[0, j]
        weight = film.weights[j] * cell
        for i in range(m):
            force[i] += weight * part[i] * metric[i]
            lever[i] += weight * film.nodes[j] * part[i] * metric[i]
    for k in range(4):
        motion, stretching = film.rings[0, MOTION + k], film.rings[0, STRETCHING + k]
        s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
        for i in range(m):
            dcos = cos[i] * stretching[i] - sin[i] * motion[i]
            dsin = sin[i] * stretching[i] + cos[i] * motion[i]
            s0 -= force[i] * dcos
            s1 -= force[i] * dsin
            s2 += lever[i] * dsin
            s3 -= lever[i] * dcos
        result[STIFFNESS + k] += s0
        result[STIFFNESS + 4 + k] += s1
        result[STIFFNESS + 8 + k] += s2
        result[STIFFNESS + 12 + k] += s3


@inner_kernel
def damping(film: TiltedFilm, result: Floats) -> None:
    """dF/dv: the velocity enters through the squeezed volume alone."""
    n, m = film.face.shape[1], film.circle.shape[2]
    cos, sin = film.rings[1, COS], film.rings[1, SIN]
    dcos, dsin = film.forcing[3, 0], film.forcing[3, 1]
    for i in range(m):
        back = i - 1 if i > 0 else m - 1
        dcos[i] = cos[i] - cos[back]
        dsin[i] = sin[i] - sin[back]
    result[DAMPING : DAMPING + 16] = 0.0
    for j in range(n):
        volume = film.forcing[BY_METRIC, j]
        z = film.nodes[j]
        for k in range(4):
            adjoint = film.pressures[k + 1, j]
            by_cos, by_sin = 0.0, 0.0
            for i in range(m):
                by_cos += adjoint[i] * volume[i] * dcos[i]
                by_sin += adjoint[i] * volume[i] * dsin[i]
            row = DAMPING + 4 * k
            result[row] -= by_sin
            result[row + 1] += by_cos
            result[row + 2] -= z * by_cos
            result[row + 3] -= z * by_sin


@stage
def add_tangent(film: TiltedFilm, bore: Bore, q: Floats, v: Floats, speed: float, result: Floats) -> None:
    """Complete `result` of `solve_pressure` by dF/dq and dF/dv, each (4, 4) row by row."""
    _solve_adjoints(film, bore)
    prepare(film, speed)
    for k in range(4):
        residual_tangent(film, bore, q, v, k)
        contract(film, k, result)
    add_grid_motion(film, result)
    damping(film, result)
