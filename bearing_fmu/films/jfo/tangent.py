"""Exact tangent of the wrench: the balance differentiated at its active set, the motion of the grid included.

With the balance R(u, q, v) = 0 of the cells, u the pressure of full ones and the content of the others ::

    dF = dF/dp du + dF|p,   R_u du = -(R_q dq + R_v dv)

The factor of R_u is that of the last round, the eight right-hand sides are solved at once.

What a cell had goes with the faces, from where they stood to where they stand now: the volume over dt that
this brings is a flow, in proportion to the velocity with which they move.  So its change counts as one with
v, at q - q_then = dt v, and stands in the damping.  As stiffness it would be of the size 1/dt, and a law
that is used in the next step, which begins where this one ended, would count the motion of this one twice.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore, fill_gap_change
from bearing_fmu.films.jfo.network import FREE, SIDES
from bearing_fmu.films.jfo.workspace import OWED, PAID, RATE, VOID, VOLUME, JfoFilm
from bearing_fmu.films.tilted.tangent import add_grid_motion
from bearing_fmu.kernels.compiled import inner_kernel, kernel, stage
from bearing_fmu.kernels.grid import COS, METRIC, MOTION, SIN, STRETCHING
from bearing_fmu.kernels.unsymmetric_solver import solve_ring
from bearing_fmu.result import DAMPING, OPEN, OPEN_1, OPEN_2, POWER, STIFFNESS

Floats = NDArray[np.float64]

_STORED, _AROUND, _AXIAL, _BROUGHT = range(4)


@inner_kernel
def _change(jfo: JfoFilm, bore: Bore, q: Floats, k: int, side: int, z: float, change: Floats) -> None:
    """dH/dq_k at one z, with the motion of the grid."""
    fc = -1.0 if k == 0 else (-z if k == 3 else 0.0)
    fs = -1.0 if k == 1 else (z if k == 2 else 0.0)
    ring = jfo.film.rings[side]
    fill_gap_change(bore, side, q[0] + q[3] * z, q[1] - q[2] * z, fc, fs, k, ring, change)


@stage
def _around_changes(jfo: JfoFilm, bore: Bore, q: Floats, speed: float, k: int) -> None:
    """Change of the flow across the faces with q_k."""
    film, net = jfo.film, jfo.net
    n, m = jfo.volumes.shape
    change, stretching = film.forcing[3, 0, :m], film.rings[1, STRETCHING + k]
    for j in range(n):
        _change(jfo, bore, q, k, 1, film.nodes[j], change)
        t, t1, power = film.face[OPEN, j], film.face[OPEN_1, j], film.face[POWER, j]
        pressure, content, out = net.pressure[j], net.content[j], jfo.changes[_AROUND, j]
        wall = film.weights[j] * speed
        for i in range(m):
            fore = i + 1 if i + 1 < m else 0
            theta = content[i] if speed >= 0.0 else content[fore]
            flow = -net.around[j, i] * (pressure[fore] - pressure[i])
            bend = t1[i] * change[i]
            out[i] = wall * theta * bend + flow * (power[i] * bend / t[i] - stretching[i])


@stage
def _axial_changes(jfo: JfoFilm, bore: Bore, q: Floats, k: int) -> None:
    """Change of the flow across the axial faces with q_k."""
    film, net = jfo.film, jfo.net
    n, m = jfo.volumes.shape
    change, stretching, ends = film.forcing[3, 0, :m], film.rings[0, STRETCHING + k], net.ends[0]
    for j in range(n + 1):
        _change(jfo, bore, q, k, 0, jfo.heights[j], change)
        t, t1, power = jfo.across[OPEN, j], jfo.across[OPEN_1, j], jfo.across[POWER, j]
        out = jfo.changes[_AXIAL, j]
        for i in range(m):
            below = net.pressure[j - 1, i] if j > 0 else ends
            above = net.pressure[j, i] if j < n else ends
            flow = -net.axial[j, i] * (above - below)
            out[i] = flow * (power[i] * t1[i] * change[i] / t[i] + stretching[i])


@stage
def _stored_changes(jfo: JfoFilm, bore: Bore, q: Floats, v: Floats, k: int) -> None:
    """Change of what the cells store with q_k, and of what their faces bring with v_k."""
    film, net = jfo.film, jfo.net
    n, m = jfo.volumes.shape
    cell, rate = 2.0 * np.pi / m, jfo.time[RATE]
    owing = rate * jfo.time[PAID]
    change = film.forcing[3, 0, :m]
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    motion, stretching = film.rings[0, MOTION + k], film.rings[0, STRETCHING + k]
    faces = film.rings[1, MOTION + k]
    for j in range(n):
        _change(jfo, bore, q, k, 0, film.nodes[j], change)
        t1, t2 = film.column[OPEN_1, j], film.column[OPEN_2, j]
        out, brought = jfo.changes[_STORED, j], jfo.changes[_BROUGHT, j]
        ux, uy = v[0] + v[3] * film.nodes[j], v[1] - v[2] * film.nodes[j]
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            area = film.weights[j] * cell * metric[i]
            volume, void = jfo.before[VOLUME, j, i], jfo.before[VOID, j, i]
            had, share = 1.0 - void / volume, jfo.share[j, i]
            # what the cell had, as its faces move
            dvolume = jfo.dense[1, VOLUME, j, i] * faces[i] - jfo.dense[0, VOLUME, j, i] * faces[back]
            dvoid = jfo.dense[1, VOID, j, i] * faces[i] - jfo.dense[0, VOID, j, i] * faces[back]
            dowed = jfo.dense[1, OWED, j, i] * faces[i] - jfo.dense[0, OWED, j, i] * faces[back]
            dhad = -(dvoid - (1.0 - had) * dvolume) / volume
            gone = net.content[j, i] - had
            opens, opening = jfo.rates[j, i], -(ux * cos[i] + uy * sin[i])
            turned = (ux * sin[i] - uy * cos[i]) * motion[i]
            dopens = opens * stretching[i] + area * (t2[i] * change[i] * opening + t1[i] * turned)
            dstored = jfo.volumes[j, i] * stretching[i] + area * t1[i] * change[i]
            closing = 2.0 * max(-opens, 0.0)
            out[i] = rate * dstored * gone + 2.0 * share * dopens - closing * dhad - owing * dowed
            brought[i] = 2.0 * jfo.volumes[j, i] * dhad


@stage
def _sides_by_position(jfo: JfoFilm, k: int) -> None:
    """Right-hand side of q_k, and what moving faces bring in that of v_k."""
    n, m = jfo.volumes.shape
    width = jfo.net.lower.shape[0] // m
    for j in range(n):
        stored, around = jfo.changes[_STORED, j], jfo.changes[_AROUND, j]
        below, above = jfo.changes[_AXIAL, j], jfo.changes[_AXIAL, j + 1]
        brought = jfo.changes[_BROUGHT, j]
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            side = -(stored[i] + around[i] - around[back] + above[i] - below[i])
            free = jfo.net.held[j, i] == FREE
            jfo.net.sides[(i * SIDES + k) * width + j] = side if free else 0.0
            jfo.net.sides[(i * SIDES + 4 + k) * width + j] = brought[i] if free else 0.0


@stage
def _sides_by_velocity(jfo: JfoFilm) -> None:
    """Add to the right-hand sides of the velocities what squeezes."""
    film, net = jfo.film, jfo.net
    n, m = jfo.volumes.shape
    width, cell = net.lower.shape[0] // m, 2.0 * np.pi / m
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    for j in range(n):
        z, t1 = film.nodes[j], film.column[OPEN_1, j]
        for i in range(m):
            at = (i * SIDES + 4) * width + j
            push = 2.0 * film.weights[j] * cell * metric[i] * t1[i] * jfo.share[j, i]
            if net.held[j, i] != FREE:
                push = 0.0
            net.sides[at] += push * cos[i]
            net.sides[at + width] += push * sin[i]
            net.sides[at + 2 * width] -= push * z * sin[i]
            net.sides[at + 3 * width] += push * z * cos[i]


@inner_kernel
def _contract(jfo: JfoFilm, k: int, result: Floats, place: int) -> None:
    """Wrench of the change of pressure on side k."""
    film, net = jfo.film, jfo.net
    n, m = jfo.volumes.shape
    width, cell = net.lower.shape[0] // m, 2.0 * np.pi / m
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
    for j in range(n):
        along, across, full = 0.0, 0.0, net.full[j]
        for i in range(m):
            part = full[i] * metric[i] * net.sides[(i * SIDES + k) * width + j]
            along += part * cos[i]
            across += part * sin[i]
        along *= film.weights[j] * cell
        across *= film.weights[j] * cell
        s0 -= along
        s1 -= across
        s2 += film.nodes[j] * across
        s3 -= film.nodes[j] * along
    result[place] = s0
    result[place + 4] = s1
    result[place + 8] = s2
    result[place + 12] = s3


@kernel
def add_jfo_tangent(jfo: JfoFilm, bore: Bore, q: Floats, v: Floats, speed: float, result: Floats) -> None:
    """Complete `result` of `reynolds.conclude` by dF/dq and dF/dv, each (4, 4) row by row."""
    net = jfo.net
    n, m = jfo.volumes.shape
    width = net.lower.shape[0] // m
    net.sides[:] = 0.0
    for k in range(4):
        _around_changes(jfo, bore, q, speed, k)
        _axial_changes(jfo, bore, q, k)
        _stored_changes(jfo, bore, q, v, k)
        _sides_by_position(jfo, k)
    _sides_by_velocity(jfo)
    b, w, y = net.blocks[0], net.blocks[1], net.blocks[2]
    solve_ring(b, net.lower, net.upper, w, y, net.sides, net.work, m, n, width, SIDES)
    for k in range(4):
        _contract(jfo, k, result, STIFFNESS + k)
        _contract(jfo, 4 + k, result, DAMPING + k)
    add_grid_motion(jfo.film, result)
