"""Wrench of the asperities of the layered film, and the exact tangent of film and asperities together.

As `tangent`, with the Jacobian of `layered` in place of the symmetric system: the asperities' force depends
on the pressure, too, through the gap, and so joins the right-hand sides of the adjoint.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.layer import YIELDING
from bearing_fmu.contact.slice import AREA, FORCE, LOAD, PRESSURE, WIPED
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
from bearing_fmu.kernels.grid import COS, METRIC, MOTION, SIN, STRETCHING
from bearing_fmu.kernels.unsymmetric_solver import factorise_ring, solve_ring
from bearing_fmu.result import STIFFNESS

Floats = NDArray[np.float64]


@inner_kernel
def _pushes(layered: LayeredFilm, j: int, i: int, grip: float, part: Floats) -> float:
    """Direction of the asperities' force on the journal at a node; returns the area in the film's units."""
    film = layered.film
    c, s, z = film.rings[0, COS, i], film.rings[0, SIN, i], film.nodes[j]
    part[0], part[1] = -(c - grip * s), -(s + grip * c)
    part[2], part[3] = -z * part[1], z * part[0]
    return film.weights[j] * 2.0 * np.pi / film.circle.shape[2] * film.rings[0, METRIC, i]


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
    width = film.coupling.shape[0] // m
    soft, part, change = layered.constants[2], film.row[:4], film.forcing[3, 0, :m]
    result[STIFFNESS : STIFFNESS + 16] = 0.0
    for j in range(n + 2):
        for i in range(m):
            if layered.asperities[0, j, i] > 0.0:
                share = _pushes(layered, j, i, grip, part)
                load = share * layered.asperities[0, j, i] * force
                contact[LOAD] += load
                pressed = layered.asperities[0, j, i] / layered.constants[3]
                contact[PRESSURE] = max(contact[PRESSURE], pressed)
                contact[AREA] += share * pressed
                contact[WIPED] += share if pressed >= YIELDING else 0.0
                for k in range(4):
                    contact[FORCE + k] += load * part[k] * (1.0 if k < 2 else half)
                    if j < n and film.pressures[0, j, i] + ambient > 0.0:
                        at = (i * 4 + k) * width + j
                        film.sides[at] += share * layered.asperities[1, j, i] * soft * part[k]
        for k in range(4):
            gap_change(film, None, q, k, 0, film.nodes[j], change)
            motion, stretching = film.rings[0, MOTION + k], film.rings[0, STRETCHING + k]
            for i in range(m):
                pressure = layered.asperities[0, j, i]
                if pressure > 0.0:
                    share = _pushes(layered, j, i, grip, part)
                    grown = share * (layered.asperities[1, j, i] * change[i] + pressure * stretching[i])
                    turned = share * pressure * motion[i]
                    z = film.nodes[j]
                    result[STIFFNESS + k] += grown * part[0] - turned * part[1]
                    result[STIFFNESS + 4 + k] += grown * part[1] + turned * part[0]
                    result[STIFFNESS + 8 + k] += grown * part[2] - z * turned * part[0]
                    result[STIFFNESS + 12 + k] += grown * part[3] - z * turned * part[1]


@stage
def add_layered_tangent(
    layered: LayeredFilm, q: Floats, v: Floats, speed: float, ambient: float, grip: float, force: float,
    half: float, result: Floats, contact: Floats,
) -> bool:  # fmt: skip
    """Complete `result` of `solve_layered`, and `contact`; False where the adjoint system has no solution."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    b, w, y = layered.blocks[0], layered.blocks[1], layered.blocks[2]
    adjoint_sides(film)
    _touch(layered, q, ambient, grip, force, half, result, contact)
    if not factorise_ring(b, layered.lower, layered.upper, w, y, layered.work, m, n, width):
        return False
    solve_ring(b, layered.lower, layered.upper, w, y, film.sides, layered.work, m, n, width, 4)
    for k in range(4):
        unfold(film, k + 1, k, 4)
    explicit = layered.asperities[2].reshape(-1)
    for k in range(16):
        explicit[k] = result[STIFFNESS + k]
    prepare(film, speed)
    for k in range(4):
        residual_tangent(film, None, q, v, k)
        contract(film, k, result)
    for k in range(16):
        result[STIFFNESS + k] += explicit[k]
    add_grid_motion(film, result)
    damping(film, result)
    return True
