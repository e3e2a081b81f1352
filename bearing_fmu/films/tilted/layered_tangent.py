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
from bearing_fmu.contact.layer import YIELDING, deflection
from bearing_fmu.contact.slice import AREA, FORCE, LOAD, PRESSURE, WIPED
from bearing_fmu.films.tilted.deformation import add_deformation, add_drift
from bearing_fmu.films.tilted.layered import LayeredFilm
from bearing_fmu.films.tilted.reynolds import unfold
from bearing_fmu.films.tilted.tangent import (
    add_grid_motion,
    adjoint_sides,
    contract,
    damping,
    gap_change,
    prepare,
    residual_tangent,
)
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.copied import copy
from bearing_fmu.kernels.grid import COS, METRIC, MOTION, SIN, STRETCHING
from bearing_fmu.kernels.unsymmetric_solver import solve_ring
from bearing_fmu.result import STIFFNESS

Floats = NDArray[np.float64]


@inner_kernel
def _press(
    layered: LayeredFilm, line: int, q: Floats, ambient: float, grip: float, scale: Floats, pressed: Floats,
    contact: Floats,
) -> bool:  # fmt: skip
    """Add the asperities' wrench on a line; their pressure times area, its slope by the gap and direction.

    Returns
    -------
    bool
        Whether they touch.
    """
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    sigma, soft, hardness = layered.constants[1], layered.constants[2], layered.constants[3]
    z, weight = layered.places[0, line], layered.places[1, line] * 2.0 * np.pi / m
    ex, ey, near = q[0] + q[3] * z, q[1] - q[2] * z, REACH * sigma
    if 1.0 - np.hypot(ex, ey) >= near:
        return False
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    part = film.row[:4]
    touches = False
    for i in range(m):
        pressed[0, i], pressed[1, i] = 0.0, 0.0
        s = 1.0 - ex * cos[i] - ey * sin[i]
        if s >= near:
            continue
        pressure = ambient
        for j in range(n):
            pressure += layered.lines[line, j] * film.pressures[0, j, i]
        s += soft * max(pressure, 0.0)
        if s >= near:
            continue
        touches = True
        back, slope, _ = deflection(s / sigma, layered.constants[0], layered.table)
        area = weight * metric[i]
        pressed[0, i], pressed[1, i] = area * sigma * back / soft, area * slope / soft
        part[0], part[1] = -(cos[i] - grip * sin[i]), -(sin[i] + grip * cos[i])
        part[2], part[3] = -z * part[1], z * part[0]
        share = sigma * back / (soft * hardness)
        contact[LOAD] += pressed[0, i] * scale[0]
        contact[PRESSURE] = max(contact[PRESSURE], share)
        contact[AREA] += area * share
        contact[WIPED] += area if share >= YIELDING else 0.0
        for k in range(4):
            contact[FORCE + k] += pressed[0, i] * part[k] * scale[0] * (1.0 if k < 2 else scale[1])
            if pressure > 0.0:
                at, push = (i * 4 + k) * width, pressed[1, i] * soft * part[k]
                for j in range(n):
                    film.sides[at + j] += push * layered.lines[line, j]
    return touches


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
    m = film.circle.shape[2]
    change, pressed, scale = film.forcing[3, 0, :m], film.forcing[3, 1:3], film.row[4:6]
    scale[0], scale[1] = force, half
    cos, sin = film.rings[0, COS], film.rings[0, SIN]
    result[STIFFNESS : STIFFNESS + 16] = 0.0
    for line in range(layered.places.shape[1]):
        if not _press(layered, line, q, ambient, grip, scale, pressed, contact):
            continue
        z = layered.places[0, line]
        for k in range(4):
            gap_change(film, None, q, k, 0, z, change)
            motion, stretching = film.rings[0, MOTION + k], film.rings[0, STRETCHING + k]
            along, across = 0.0, 0.0
            for i in range(m):
                if pressed[0, i] > 0.0:
                    dx, dy = -(cos[i] - grip * sin[i]), -(sin[i] + grip * cos[i])
                    grown = pressed[1, i] * change[i] + pressed[0, i] * stretching[i]
                    turned = pressed[0, i] * motion[i]
                    along += grown * dx - turned * dy
                    across += grown * dy + turned * dx
            result[STIFFNESS + k] += along
            result[STIFFNESS + 4 + k] += across
            result[STIFFNESS + 8 + k] -= z * across
            result[STIFFNESS + 12 + k] += z * along


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
    adjoint_sides(film)
    _touch(layered, q, ambient, grip, force, half, result, contact)
    solve_ring(b, layered.upper, layered.lower, y, w, film.sides, layered.work, m, n, width, 4)
    for k in range(4):
        unfold(film, k + 1, k, 4)
    explicit = layered.explicit
    copy(result[STIFFNESS : STIFFNESS + 16], explicit)
    prepare(film, speed)
    damping(film, result)
    for k in range(4):
        residual_tangent(film, None, q, v, k)
        add_deformation(layered, k, ambient, result)
        contract(film, k, result)
    for k in range(16):
        result[STIFFNESS + k] += explicit[k]
    add_grid_motion(film, result)
    add_drift(layered, v, ambient, result)
