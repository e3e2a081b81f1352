"""Wrench of the asperities of the layered film, and the exact tangent of film and asperities together.

The asperities' force is summed on lines between the rows, on which the pressure is the axial polynomial:
what they bear changes over a few roughnesses, along the axis within a cell.

As `tangent`, with the Jacobian of `layered` in place of the symmetric system: the asperities' force depends
on the pressure, too, through the gap, and so joins the right-hand sides of the adjoint.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.asperities import REACH
from bearing_fmu.contact.edge import edge_back
from bearing_fmu.contact.layer import YIELDING, deflection
from bearing_fmu.contact.slice import AREA, FORCE, LOAD, PRESSURE, WIPED
from bearing_fmu.films.tilted.deformation import add_deformation, add_drift
from bearing_fmu.films.tilted.layered import LayeredFilm
from bearing_fmu.films.tilted.layered_residual import prepare, residual_tangent
from bearing_fmu.films.tilted.tangent import (
    add_grid_motion,
    adjoint_sides,
    contract,
    damping,
    gap_change,
)
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.cells import NEAR
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.copied import copy
from bearing_fmu.kernels.grid import COS, METRIC, MOTION, SIN, STRETCHING
from bearing_fmu.kernels.unsymmetric_solver import solve_ring
from bearing_fmu.result import GAP, STIFFNESS

Floats = NDArray[np.float64]


@inner_kernel
def _add_pressure(
    layered: LayeredFilm, i: int, z: float, area: float, mean: float, grip: float, scale: Floats,
    part: Floats, contact: Floats,
) -> None:  # fmt: skip
    """Add to the contact what presses on an area of column i; its directions are left in `part`."""
    cos, sin = layered.film.rings[0, COS, i], layered.film.rings[0, SIN, i]
    soft, hardness = layered.constants[2], layered.constants[3]
    force = area * mean / soft
    part[0], part[1] = -(cos - grip * sin), -(sin + grip * cos)
    part[2], part[3] = -z * part[1], z * part[0]
    share = mean / (soft * hardness)
    contact[LOAD] += force * scale[0]
    contact[AREA] += area * share
    contact[WIPED] += area if share >= YIELDING else 0.0
    for k in range(4):
        contact[FORCE + k] += force * part[k] * scale[0] * (1.0 if k < 2 else scale[1])


@inner_kernel
def _press(
    layered: LayeredFilm, line: int, q: Floats, ambient: float, grip: float, scale: Floats, pressed: Floats,
    contact: Floats,
) -> tuple[int, int]:  # fmt: skip
    """Add the asperities' wrench on a line; their pressure times area, its slope by the gap and direction.

    Returns
    -------
    tuple of int
        From which column to which they touch.
    """
    film = layered.film
    m = film.circle.shape[2]
    width = film.coupling.shape[0] // m
    row = int(layered.lines[line, 0])
    sigma, soft, hardness = layered.constants[1], layered.constants[2], layered.constants[3]
    z, weight = layered.places[0, line], layered.places[1, line] * 2.0 * np.pi / m
    ex, ey, near = q[0] + q[3] * z, q[1] - q[2] * z, REACH * sigma
    if 1.0 - np.hypot(ex, ey) >= near:
        return 0, 0
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    part = film.row[:4]
    low, high = m, 0
    for i in range(m):
        pressed[0, i], pressed[1, i] = 0.0, 0.0
        s = 1.0 - ex * cos[i] - ey * sin[i]
        if s >= near:
            continue
        pressure = ambient
        for near_by in range(NEAR):
            pressure += layered.lines[line, 1 + near_by] * film.pressures[0, row + near_by, i]
        s += soft * max(pressure, 0.0)
        if s >= near:
            continue
        low, high = min(low, i), i + 1
        back, slope, _ = deflection(s / sigma, layered.constants[0], layered.table)
        area = weight * metric[i]
        pressed[0, i], pressed[1, i] = area * sigma * back / soft, area * slope / soft
        contact[PRESSURE] = max(contact[PRESSURE], sigma * back / (soft * hardness))
        _add_pressure(layered, i, z, area, sigma * back, grip, scale, part, contact)
        if pressure > 0.0:
            for k in range(4):
                at, push = (i * 4 + k) * width, pressed[1, i] * soft * part[k]
                for near_by in range(NEAR):
                    film.sides[at + row + near_by] += push * layered.lines[line, 1 + near_by]
    return low, high


@inner_kernel
def _press_end(
    layered: LayeredFilm, end: int, q: Floats, ambient: float, grip: float, scale: Floats, pressed: Floats,
    contact: Floats,
) -> tuple[int, int]:  # fmt: skip
    """As `_press`, on the outer half of a last cell, where the pressure falls as `contact.edge` has it.

    The slope is that by the gap in the middle of the cell, and then by the one at its end.
    """
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    sigma, soft, hardness = layered.constants[1], layered.constants[2], layered.constants[3]
    row, face = (0, 0) if end == 0 else (n - 1, n)
    z, weight = 0.5 * (film.nodes[row] + film.nodes[n + end]), np.pi / m * film.weights[row]
    metric, gap, at_end = film.rings[0, METRIC], film.column[GAP, row], layered.across[GAP, face]
    near, press, part = REACH * sigma, soft * max(ambient, 0.0), film.row[:4]
    low, high = m, 0
    for i in range(m):
        pressed[0, i], pressed[1, i], pressed[2, i] = 0.0, 0.0, 0.0
        s_end = at_end[i] + press
        pressure = ambient + film.pressures[0, row, i]
        s = gap[i] + soft * max(pressure, 0.0)
        if s >= near and s_end >= near:
            continue
        low, high = min(low, i), i + 1
        drop = max(s - gap[i] - press, 0.0) / sigma
        back, by_inside, by_end, by_press = edge_back(s / sigma, s_end / sigma, drop, layered.edge)
        area = weight * metric[i]
        pressed[0, i] = area * sigma * back / soft
        pressed[1, i], pressed[2, i] = area * by_inside / soft, area * by_end / soft
        most = deflection(min(s, s_end) / sigma, layered.constants[0], layered.table)[0]
        contact[PRESSURE] = max(contact[PRESSURE], sigma * most / (soft * hardness))
        _add_pressure(layered, i, z, area, sigma * back, grip, scale, part, contact)
        if pressure > 0.0:
            push = area * (by_inside + (by_press if drop > 0.0 else 0.0))
            for k in range(4):
                film.sides[(i * 4 + k) * width + row] += push * part[k]
    return low, high


@stage
def _touch(
    layered: LayeredFilm, q: Floats, ambient: float, grip: float, force: float, half: float, result: Floats,
    contact: Floats,
) -> None:  # fmt: skip
    """Add the asperities' wrench, SI, and complete the adjoint right-hand sides and the tangent by them.

    Parameters
    ----------
    grip : float
        Friction coefficient times sense of sliding.
    force, half : float
        Unit of the film's force, N, and of lengths along the axis, m.
    result, contact
        The film's and the contact's results; the tangent of both goes into that of the film.
    """
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    change, pressed, scale = film.forcing[3, 0, :m], film.forcing[3, 1:4], film.row[4:6]
    scale[0], scale[1] = force, half
    cos, sin = film.rings[0, COS], film.rings[0, SIN]
    result[STIFFNESS : STIFFNESS + 16] = 0.0
    lines = layered.places.shape[1]
    for line in range(lines + 2):
        end = line - lines
        if end < 0:
            low, high = _press(layered, line, q, ambient, grip, scale, pressed, contact)
            z = place = layered.places[0, line]
        else:
            low, high = _press_end(layered, end, q, ambient, grip, scale, pressed, contact)
            place = film.nodes[0 if end == 0 else n - 1]
            z = 0.5 * (place + film.nodes[n + end])
        if low >= high and end < 0:
            continue
        for k in range(4):
            motion, stretching = film.rings[0, MOTION + k], film.rings[0, STRETCHING + k]
            along, across = 0.0, 0.0
            for side in range(1 if end < 0 else 2):
                slope = pressed[1 + side]
                gap_change(film, None, q, k, 0, place if side == 0 else film.nodes[n + end], change)
                for i in range(low, high):
                    if pressed[0, i] > 0.0:
                        dx, dy = -(cos[i] - grip * sin[i]), -(sin[i] + grip * cos[i])
                        grown = slope[i] * change[i]
                        along += grown * dx
                        across += grown * dy
                        if side == 0:
                            grown, turned = pressed[0, i] * stretching[i], pressed[0, i] * motion[i]
                            along += grown * dx - turned * dy
                            across += grown * dy + turned * dx
            for side in range(0 if end < 0 else 2):  # the film's outer halves change with the gap
                row = 0 if end == 0 else n - 1
                gap_change(film, None, q, k, 0, place if side == 0 else film.nodes[n + end], change)
                weight, metric = layered.sums.weights[row] * 2.0 * np.pi / m, film.rings[0, METRIC]
                film_x, film_y, slope = 0.0, 0.0, layered.outer[1 + side, end]
                for i in range(m):
                    grown = -weight * metric[i] * slope[i] * change[i]
                    film_x += grown * cos[i]
                    film_y += grown * sin[i]
                lever = layered.sums.nodes[row]
                result[STIFFNESS + k] += film_x
                result[STIFFNESS + 4 + k] += film_y
                result[STIFFNESS + 8 + k] -= lever * film_y
                result[STIFFNESS + 12 + k] += lever * film_x
            result[STIFFNESS + k] += along
            result[STIFFNESS + 4 + k] += across
            result[STIFFNESS + 8 + k] -= z * across
            result[STIFFNESS + 12 + k] += z * along


@inner_kernel
def _unfold(film: TiltedFilm, side: int) -> None:
    """Copy an adjoint solution, with its differences to the next columns and over the axial faces."""
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    stack = film.pressures[side + 1]
    for j in range(n):
        row, ahead = stack[j], stack[n + j]
        for i in range(m):
            row[i] = film.sides[(i * 4 + side) * width + j]
        for i in range(m - 1):
            ahead[i] = row[i + 1] - row[i]
        ahead[m - 1] = row[0] - row[m - 1]
    for i in range(m):
        stack[2 * n, i] = stack[0, i]
        stack[3 * n, i] = -stack[n - 1, i]
        stack[3 * n + 1, i] = 0.0
    for k in range(1, n):
        before, after, across = stack[k - 1], stack[k], stack[2 * n + k]
        for i in range(m):
            across[i] = after[i] - before[i]


@stage
def add_layered_tangent(
    layered: LayeredFilm, q: Floats, v: Floats, speed: float, ambient: float, grip: float, force: float,
    half: float, result: Floats, contact: Floats,
) -> None:  # fmt: skip
    """Complete `result` of `solve_layered`, and `contact`."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    b, w, y = layered.blocks[0], layered.blocks[1], layered.blocks[2]
    adjoint_sides(layered.sums)
    _touch(layered, q, ambient, grip, force, half, result, contact)
    solve_ring(b, layered.upper, layered.lower, y, w, film.sides, layered.work, m, n, width, 4)
    for k in range(4):
        _unfold(film, k)
    explicit = layered.explicit
    copy(result[STIFFNESS : STIFFNESS + 16], explicit)
    prepare(layered, speed)
    damping(film, result)
    for k in range(4):
        residual_tangent(layered, q, v, k)
        add_deformation(layered, k, ambient, result)
        contract(film, k, result)
    for k in range(16):
        result[STIFFNESS + k] += explicit[k]
    add_grid_motion(layered.sums, result)
    add_drift(layered, v, ambient, result)
