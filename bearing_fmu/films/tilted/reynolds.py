"""V1: the Reynolds equation over the tilted gap, solved for pressure and wrench.

In the gap H = 1 - (x + tilt_y z) cos(phi) - (y - tilt_x z) sin(phi), with z over half the width b/2
and everything radial over the clearance C, the pressure over 6 eta R^2 / C^2 obeys ::

    d/dphi(T^3 dp/dphi) + (2R/b)^2 d/dz(T^3 dp/dz) = speed dT/dphi + 2 dT/dt

(the paper's Eq. 12 for constant density and viscosity; T(H) is the gap open to the oil, see `gap`).
p is taken relative to the ambient pressure, so it vanishes at both ends.

Finite volumes around the circumference (columns i at the cell centres, faces between i and i + 1),
bubble functions along the axis (rows j).  The system is symmetric positive definite, cyclic block
tridiagonal with one dense block a column.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore, deepen, fill_gap, land, least_gap, place_rings
from bearing_fmu.bore.gap import ROUGH_LIMIT, flow_gaps
from bearing_fmu.films.tilted.grooves import hold_grooves, pressure_drag
from bearing_fmu.films.tilted.lines import SHARE, take_lines, wrench_of
from bearing_fmu.films.tilted.peak import largest_pressure
from bearing_fmu.films.tilted.rupture import ROUNDS, hold, move_rupture, release
from bearing_fmu.films.tilted.side_flow import side_flow
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.films.turbulence import ALONG, AROUND, LAMINAR_POWER, drag, slow_down
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.cyclic_solver import factorise, substitute
from bearing_fmu.kernels.grid import COS, METRIC, SIN
from bearing_fmu.kernels.guembel import bearing_part
from bearing_fmu.kernels.vector import LANES, add_rows
from bearing_fmu.result import (
    ABSOLUTE,
    CONDUCTANCE,
    DRAG,
    FLOW,
    GAP,
    OPEN,
    OPEN_1,
    OPEN_2,
    PEAK,
    POWER,
    SHEAR,
    SQUEEZE,
)
from bearing_fmu.status import NO_SOLUTION, NOT_CONVERGED, OK

Floats = NDArray[np.float64]


@inner_kernel
def shape_gap(film: TiltedFilm, bore: Bore, q: Floats, sigma: float, part: float) -> None:
    """Grid, gap and conductances at the columns (axial flow) and at the faces (flow around)."""
    m = film.circle.shape[2]
    cell = 2.0 * np.pi / m
    place_rings(bore, film.circle, q, 4, part, film.grading, film.rings)
    rough = least_gap(bore, q)[0] < ROUGH_LIMIT * sigma
    film.column[POWER] = LAMINAR_POWER
    film.face[POWER] = LAMINAR_POWER
    for side in range(2):
        ring = film.rings[side]
        metric = ring[METRIC]
        field = film.column if side == 0 else film.face
        for j in range(field.shape[1]):
            ex = q[0] + q[3] * film.nodes[j]
            ey = q[1] - q[2] * film.nodes[j]
            gap, t, conductance = field[GAP, j], field[OPEN, j], field[CONDUCTANCE, j]
            fill_gap(bore, side, ex, ey, ring, gap)
            deepen(bore, side, film.nodes[j], gap)
            flow_gaps(gap[:m], sigma, rough, t, field[OPEN_1, j], field[OPEN_2, j])
            if side == 0:
                scale = film.stiffness[j] * cell
                for i in range(m):
                    conductance[i] = scale * metric[i] * (t[i] * t[i] * t[i])
            else:
                scale = film.weights[j] / cell
                for i in range(m):
                    conductance[i] = scale / metric[i] * (t[i] * t[i] * t[i])


@inner_kernel
def _make_turbulent(film: TiltedFilm, reynolds: float) -> None:
    """Turbulent conductances in place of the laminar ones; `reynolds` is rho U C / eta."""
    m = film.circle.shape[2]
    for j in range(film.column.shape[1]):
        slow_down(reynolds, m, ALONG, film.column[:, j])
    for j in range(film.face.shape[1]):
        slow_down(reynolds, m, AROUND, film.face[:, j])


@inner_kernel
def _turbulent_shear(film: TiltedFilm, bore: Bore, reynolds: float) -> float:
    """Integral of 1/T times the drag of turbulence."""
    m = film.circle.shape[2]
    metric, shear = land(bore, film.rings[0]), 0.0
    for j in range(film.column.shape[1]):
        t = film.column[OPEN, j]
        total = 0.0
        for i in range(m):
            total += metric[i] / t[i] * drag(reynolds * t[i])
        shear += film.weights[j] * total
    return 2.0 * np.pi / m * shear


@inner_kernel
def _assemble(film: TiltedFilm, v: Floats, speed: float) -> None:
    """System and right-hand side in the layout of the ring solver."""
    n, m, length = film.face.shape[1], film.circle.shape[2], film.face.shape[2]
    width = film.coupling.shape[0] // m
    block = n * width
    cos, sin = film.rings[1, COS], film.rings[1, SIN]
    b, coupling, sides = film.blocks[0], film.coupling, film.sides
    axial = film.column[CONDUCTANCE].reshape(-1)
    b[:] = 0.0
    for i in range(m):
        for k in range(0, block, LANES):
            add_rows(b, i * block + k, axial, i, length, film.products, k, block, n + 2)
    for j in range(n):
        along, t = film.face[CONDUCTANCE, j], film.face[OPEN, j]
        squeeze, t1 = film.column[SQUEEZE, j], film.column[OPEN_1, j]
        ux = v[0] + v[3] * film.nodes[j]
        uy = v[1] - v[2] * film.nodes[j]
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            squeeze[i] = uy * (cos[i] - cos[back]) - ux * (sin[i] - sin[back])
            coupling[i * width + j] = along[i]
            b[i * block + j * width + j] += along[i] + along[back]
            wedge = speed * (t[i] - t[back])
            sides[i * width + j] = -film.weights[j] * (wedge + 2.0 * t1[i] * squeeze[i])


@inner_kernel
def unfold(film: TiltedFilm, index: int, side: int, sides: int) -> None:
    """Copy a solution of the ring solver into pressure `index`, with differences and slopes."""
    n, m, length = film.face.shape[1], film.circle.shape[2], film.face.shape[2]
    width = film.coupling.shape[0] // m
    stack = film.pressures[index].reshape(-1)
    for j in range(n):
        at, ahead = j * length, (n + j) * length
        for i in range(m):
            stack[at + i] = film.sides[(i * sides + side) * width + j]
        for i in range(m - 1):
            stack[ahead + i] = stack[at + i + 1] - stack[at + i]
        stack[ahead + m - 1] = stack[at] - stack[at + m - 1]
    for k in range(n + 2):
        at = (2 * n + k) * length
        stack[at : at + length] = 0.0
        for i in range(0, length, LANES):
            add_rows(stack, at + i, film.slopes, k * n, 1, stack, i, length, n)


@inner_kernel
def integrate(film: TiltedFilm, bore: Bore, ambient: float, result: Floats) -> None:
    """Wrench of the bearing part of the pressure, largest pressure, shear integral."""
    n, m = film.face.shape[1], film.circle.shape[2]
    cell = 2.0 * np.pi / m
    shear = 0.0
    if film.mixed[SHARE] > 0.0:
        take_lines(film, ambient, result)
    else:
        for j in range(n):
            above, pressure = film.column[ABSOLUTE, j], film.pressures[0, j]
            for i in range(m):
                above[i] = pressure[i] + ambient
            part = film.nodal[0, j]
            bearing_part(above, m, part, film.nodal[1, j], film.nodal[2, j], film.nodal[3, j])
        wrench_of(film, film.nodal[0], result)
    metric = land(bore, film.rings[0])
    for j in range(n + 2):
        t = film.column[OPEN, j]
        total = 0.0
        for i in range(m):
            total += metric[i] / t[i]
        shear += film.weights[j] * cell * total
    result[PEAK] = largest_pressure(film, bore, ambient)
    result[SHEAR] = shear
    result[DRAG] = pressure_drag(film, bore)


@stage
def solve_pressure(
    film: TiltedFilm,
    bore: Bore,
    q: Floats,
    v: Floats,
    speed: float,
    ambient: float,
    feed: float,
    sigma: float,
    reynolds: float,
    ruptures: int,
    part: float,
    lines: float,
    result: Floats,
) -> int:
    """Solve for the pressure and integrate it.

    Parameters
    ----------
    film : TiltedFilm
        Work space; on return pressure 0, the factor and all fields.
    bore : Bore
        The bore.
    q, v : ndarray, shape (4,)
        Position and velocity (1/s) over the clearance, tilts times b/2 over the clearance.
    speed : float
        Angular speed, rad/s.
    ambient : float
        Ambient pressure over 6 eta R^2 / C^2, 1/s.
    feed : float
        Pressure in the grooves, as `ambient`.
    sigma : float
        Roughness over clearance.
    reynolds : float
        Of the clearance, rho U C / eta, where the film may be turbulent; 0 for a laminar one.
    ruptures : int
        1 for Reynolds' condition, 0 for Guembel's.
    part : float
        Of the usual grading of the grid, see `bore.bore.place_rings`.
    lines : float
        1 where the positive part is cut on lines, see `lines`; 0 for the rows.
    result : ndarray, shape (RESULTS,)
        Wrench, largest pressure and shear integral are written.

    Returns
    -------
    int
        A code of `FilmStatus`.
    """
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    b, w, wt = film.blocks[0], film.blocks[1], film.blocks[2]
    shape_gap(film, bore, q, sigma, part)
    if reynolds > 0.0:
        _make_turbulent(film, reynolds)
    release(film)
    status = NOT_CONVERGED
    for attempt in range(ROUNDS):
        _assemble(film, v, speed)
        if ruptures != 0:
            hold(film, ambient)
        hold_grooves(film, bore, feed - ambient)
        if not factorise(b, film.coupling, w, wt, film.block, film.row, m, n, width):
            status = NO_SOLUTION
            break
        substitute(b, film.coupling, w, wt, film.sides, film.row, m, n, width, 1)
        unfold(film, 0, 0, 1)
        if ruptures == 0 or not move_rupture(film, ambient, attempt):
            status = OK
            break
    if status == OK:
        film.mixed[SHARE] = lines
        integrate(film, bore, ambient, result)
        result[FLOW] = side_flow(film, bore, q, v, speed, sigma)
        if reynolds > 0.0:
            result[SHEAR] = _turbulent_shear(film, bore, reynolds)
    return status
