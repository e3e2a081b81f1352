"""The positive part of the pressure on lines between the rows, where it ends along the axis.

Guembel's condition is cut exactly around the circumference, row by row.  Where the positive part ends at a z
(see `corners.turning_round`) the rows are too coarse: there the axial polynomial is cut on twelve times as
many lines, at the points of Gauss' rule, and brought back to the rows by the polynomial through their nodes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import COS, METRIC, SIN
from bearing_fmu.kernels.guembel import bearing_part
from bearing_fmu.kernels.vector import LANES, add_rows

Floats = NDArray[np.float64]

#: Where in `film.mixed` stands whether the lines serve, 0 or 1.
SHARE = 0
_WORK = 4


@inner_kernel
def wrench_of(film: TiltedFilm, part: Floats, wrench: Floats) -> None:
    """Wrench of the bearing part of the pressure at the nodes."""
    m = film.circle.shape[2]
    cell = 2.0 * np.pi / m
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    wrench[:4] = 0.0
    for j in range(part.shape[0]):
        row = part[j]
        along, across = 0.0, 0.0
        for i in range(m):
            along += row[i] * metric[i] * cos[i]
            across += row[i] * metric[i] * sin[i]
        along *= film.weights[j] * cell
        across *= film.weights[j] * cell
        wrench[0] -= along
        wrench[1] -= across
        wrench[2] += film.nodes[j] * across
        wrench[3] -= film.nodes[j] * along


@inner_kernel
def take_lines(film: TiltedFilm, ambient: float, result: Floats) -> None:
    """Bearing part at the nodes, and wrench, from the lines."""
    n, m, length = film.face.shape[1], film.circle.shape[2], film.face.shape[2]
    part, above = film.nodal[0], film.forcing[_WORK, n]
    part[:] = 0.0
    pressures = film.pressures[0].reshape(-1)
    for k in range(film.lines.shape[0]):
        above[:] = ambient
        for i in range(0, length, LANES):
            add_rows(above, i, film.lines[k], 0, 1, pressures, i, length, n)
        cut = film.cuts[k]
        bearing_part(above, m, cut[0], cut[1], cut[2], cut[3])
        for j in range(n):
            back = film.back[k, j]
            for i in range(m):
                part[j, i] += back * cut[0, i]
    wrench_of(film, part, result)


@inner_kernel
def add_line_sides(film: TiltedFilm) -> None:
    """Add the right-hand sides of the adjoint of the wrench from the lines."""
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    sides, cell = film.sides, 2.0 * np.pi / m
    for k in range(film.lines.shape[0]):
        own, ahead, behind = film.cuts[k, 1], film.cuts[k, 2], film.cuts[k, 3]
        weight, moment = 0.0, 0.0
        for j in range(n):
            weight -= film.weights[j] * film.back[k, j] * cell
            moment -= film.weights[j] * film.back[k, j] * cell * film.nodes[j]
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            fore = i + 1 if i + 1 < m else 0
            w0, w1, w2 = own[i] * metric[i], ahead[back] * metric[back], behind[i] * metric[fore]
            along = w0 * cos[i] + w1 * cos[back] + w2 * cos[fore]
            across = w0 * sin[i] + w1 * sin[back] + w2 * sin[fore]
            at = i * 4 * width
            for j in range(n):
                value = film.lines[k, j]
                sides[at + j] += value * weight * along
                sides[at + width + j] += value * weight * across
                sides[at + 2 * width + j] -= value * moment * across
                sides[at + 3 * width + j] += value * moment * along
