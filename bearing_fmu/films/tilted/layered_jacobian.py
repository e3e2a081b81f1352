"""The Jacobian of the equations of V1 on a soft layer, by blocks of columns; see `layered_equations`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.tilted.layered import LayeredFilm
from bearing_fmu.kernels.cells import NEAR
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import METRIC
from bearing_fmu.result import CONDUCTANCE, OPEN_1, OPEN_2, POWER, SQUEEZE

Floats = NDArray[np.float64]

#: Change of the logarithm of an axial conductance by the gap; of the ends' by that in the middle of the last
#: cell, by that at the end, and by how far the film presses back.
BY_GAP, BY_END, BY_PRESS = POWER, OPEN_1, OPEN_2


@inner_kernel
def _add_axial(layered: LayeredFilm) -> None:
    """What flows along the axis: into the cell before each face, out of the one after it."""
    film, soft = layered.film, layered.constants[2]
    n, m = film.face.shape[1], film.circle.shape[2]
    for q in range(n + 1):
        flux, along = layered.across[CONDUCTANCE, q], film.pressures[0, 2 * n + q]
        end, start = q == 0 or q == n, int(layered.faces[q, 1])
        by_gap = layered.across[BY_PRESS if end else BY_GAP, q]
        for near_by in range(NEAR):
            row = start + near_by
            slope, share = film.slopes[q * n + row], soft * layered.faces[q, 2 + near_by]
            if end:
                share = soft if row == (0 if q == 0 else n - 1) else 0.0
                if share == 0.0:
                    continue
            pressed = layered.pressed[row]
            part = layered.rows[0]
            for i in range(m):
                part[i] = flux[i] * (slope + (share if pressed[i] > 0.0 else 0.0) * by_gap[i] * along[i])
            if q > 0:
                into = layered.near[q - 1, row - int(layered.faces[q - 1, 1])]
                for i in range(m):
                    into[i] -= part[i]
            if q < n:
                out = layered.near[q, near_by]
                for i in range(m):
                    out[i] += part[i]


@inner_kernel
def _add_around(layered: LayeredFilm, gives: float) -> None:
    """What flows around and is squeezed out; the couplings to the next columns."""
    film, soft = layered.film, layered.constants[2]
    n, m = film.face.shape[1], film.circle.shape[2]
    width, metric = film.coupling.shape[0] // m, film.rings[0, METRIC]
    own, next_, given = layered.rows[0], layered.rows[1], layered.rows[2]
    for j in range(n):
        along, squeeze, pressed = film.face[CONDUCTANCE, j], film.column[SQUEEZE, j], layered.pressed[j]
        t1, t2, twice = film.column[OPEN_1, j], film.column[OPEN_2, j], 2.0 * film.weights[j]
        before, behind, bent = layered.advected[0, j], layered.advected[1, j], layered.advected[2, j]
        diagonal = layered.near[j, j - int(layered.faces[j, 1])]
        for i in range(m + 1):
            given[i] = soft if pressed[i] > 0.0 else 0.0
        # flow at the face after column i: by the pressure of column i, and less that of the next
        for i in range(m):
            own[i] = along[i] + given[i] * (before[i] - 0.5 * bent[i])
        for i in range(m):
            next_[1 + i] = along[i] - given[i + 1] * (behind[i] - 0.5 * bent[i])
        next_[0] = next_[m]
        for i in range(m):
            diagonal[i] += own[i] + next_[i]
        for i in range(m):
            diagonal[i] += twice * given[i] * (t2[i] * squeeze[i] + t1[i] * gives * metric[i])
        for i in range(m):
            layered.lower[i * width + j], layered.upper[i * width + j] = own[i], next_[1 + i]


@inner_kernel
def set_jacobian(layered: LayeredFilm, gives: float) -> None:
    """Set the Jacobian, transposed as the solver wants it, from fields that stand.

    Parameters
    ----------
    gives : float
        Squeezed volume of a cell by how far its wall gives way, over its metric.
    """
    film, near, b = layered.film, layered.near, layered.blocks[0]
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    near[:] = 0.0
    _add_axial(layered)
    _add_around(layered, gives)
    b[:] = 0.0
    for i in range(m):
        for j in range(n):
            at = (i * n + int(layered.faces[j, 1])) * width + j
            for row in range(NEAR + 1 if layered.faces[j + 1, 1] > layered.faces[j, 1] else NEAR):
                b[at + row * width] = near[j, row, i]
