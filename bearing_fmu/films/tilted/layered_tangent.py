"""The exact tangent of the layered film and its asperities together.

As `tangent`, with the Jacobian of `layered` in place of the symmetric system: the asperities' force depends
on the pressure, too, through the gap, and so joins the right-hand sides of the adjoint (`layered_contact`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.tilted.deformation import add_drift
from bearing_fmu.films.tilted.layered import LayeredFilm
from bearing_fmu.films.tilted.layered_contact import touch
from bearing_fmu.films.tilted.layered_residual import add_residual_tangent
from bearing_fmu.films.tilted.tangent import add_grid_motion, adjoint_sides
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.unsymmetric_solver import solve_transposed
from bearing_fmu.kernels.vector import LANES

Floats = NDArray[np.float64]


@inner_kernel
def _solve_adjoints(layered: LayeredFilm) -> None:
    """Solve for the right-hand sides, a row of each column a side; solutions are a number of each unknown."""
    film, x = layered.film, layered.adjoint
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    for i in range(m):
        for side in range(4):
            for j in range(n):
                x[(i * n + j) * LANES + side] = film.sides[(i * 4 + side) * width + j]
    b, w, y = layered.blocks[0], layered.blocks[1], layered.blocks[2]
    solve_transposed(b, layered.lower, layered.upper, w, y, x, layered.work, m, n, width)


@inner_kernel
def _unfold(layered: LayeredFilm, side: int) -> None:
    """Copy an adjoint solution, with its differences to the next columns and over the axial faces."""
    film, x = layered.film, layered.adjoint
    n, m = film.face.shape[1], film.circle.shape[2]
    stack = film.pressures[side + 1]
    for j in range(n):
        row, ahead = stack[j], stack[n + j]
        for i in range(m):
            row[i] = x[(i * n + j) * LANES + side]
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
    adjoint_sides(layered.sums)
    touch(layered, q, ambient, grip, force, half, result, contact)
    _solve_adjoints(layered)
    for k in range(4):
        _unfold(layered, k)
    add_residual_tangent(layered, q, v, speed, ambient, result)
    add_grid_motion(layered.sums, result)
    add_drift(layered, v, result)
