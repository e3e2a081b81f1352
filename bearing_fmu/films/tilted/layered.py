"""V1 on a soft layer: film and asperities press the wall back, the gap follows from both.

At each node the rigid gap plus c times the film's pressure is the gap s without asperities, from which
`bearing_fmu.contact.layer` gives the gap; there the oil flows by Patir and Cheng's flow factor, and the
wedge is the average gap of `bore.gap`. The discrete equations are those of `reynolds`, now not linear in
the pressure, and are solved by Newton's method. Where a film presses the wall back it advects its own
deflection, which takes the value of the upstream column. The wall's rate of deformation is left out of
the squeezed volume: it would be a memory.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.gap import flow_gap
from bearing_fmu.contact.asperities import REACH
from bearing_fmu.contact.layer import deflection, rough_flow
from bearing_fmu.films.tilted.lines import SHARE
from bearing_fmu.films.tilted.reynolds import integrate, shape_gap, unfold
from bearing_fmu.films.tilted.side_flow import side_flow
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.grid import COS, METRIC, SIN
from bearing_fmu.kernels.unsymmetric_solver import factorise_ring, solve_ring
from bearing_fmu.kernels.vector import LANES, add_rows
from bearing_fmu.result import CONDUCTANCE, FLOW, GAP, OPEN, OPEN_1, OPEN_2, POWER, SQUEEZE
from bearing_fmu.status import NO_SOLUTION, NOT_CONVERGED, OK

Floats = NDArray[np.float64]

ROUNDS = 60
#: Of a step of the pressure: one more would change it by about the square of that.
_PRECISION = 1e-4
#: Roughnesses by which a step presses the wall back at most, of a first and of a second search.
_STEPS = (1.0, 3.0)
_FLAT = 1e-12


class LayeredFilm(NamedTuple):
    """A tilted film on its layer; n rows, m columns, n' and m' padded."""

    film: TiltedFilm
    table: Floats  #: of `contact.layer.layer_table`
    constants: (
        Floats  #: first s of the table; roughness, compliance times pressure unit over clearance; hardness
    )
    asperities: Floats  #: (3, n + 2, m) pressure of the asperities in units of the film's, slope by s; work
    advected: Floats  #: (2, n, m') change of wedge and of flow by the deflection at the faces
    lower: Floats  #: (m n',) couplings of the Jacobian
    upper: Floats  #: (m n',)
    blocks: Floats  #: (3, m n n') its factor
    work: Floats  #: (2 n n' + 4 n',)


def layered_film(
    film: TiltedFilm, first: float, table: Floats, sigma: float, compliance: float, hardness: float
) -> LayeredFilm:
    """Prepare the film with its own work space."""
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    return LayeredFilm(
        film=film,
        table=table,
        constants=np.array([first, sigma, compliance, hardness]),
        asperities=np.zeros((3, n + 2, m)),
        advected=np.zeros((2, n, film.face.shape[2])),
        lower=np.zeros(m * width),
        upper=np.zeros(m * width),
        blocks=np.zeros((3, m * n * width)),
        work=np.zeros(2 * n * width + 4 * width),
    )


@inner_kernel
def _gap(layered: LayeredFilm, s: float) -> tuple[float, float, float]:
    """Gap and its two derivatives by s, all over the clearance."""
    first, sigma = layered.constants[0], layered.constants[1]
    back, slope, bend = deflection(s / sigma, first, layered.table)
    return s + sigma * back, 1.0 + slope, bend / sigma


@inner_kernel
def _set_columns(layered: LayeredFilm, ambient: float) -> None:
    """Open gap, conductance along the axis and asperity pressure at the columns."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    cell, sigma, soft = 2.0 * np.pi / m, layered.constants[1], layered.constants[2]
    metric = film.rings[0, METRIC]
    for j in range(n + 2):
        field, scale = film.column[:, j], film.stiffness[j] * cell * sigma**3
        touches = False
        for i in range(m):
            pressure = ambient + (film.pressures[0, j, i] if j < n else 0.0)
            s = field[GAP, i] + soft * max(pressure, 0.0)
            field[OPEN, i], field[OPEN_1, i], field[OPEN_2, i] = s, 1.0, 0.0
            touches = touches or s < REACH * sigma
        for i in range(m):
            h, h1 = field[OPEN, i], 1.0
            layered.asperities[0, j, i], layered.asperities[1, j, i] = 0.0, 0.0
            if touches and h < REACH * sigma:
                s = h
                h, h1, h2 = _gap(layered, s)
                t, t1, t2 = flow_gap(h, sigma)
                field[OPEN, i], field[OPEN_1, i], field[OPEN_2, i] = t, t1 * h1, t2 * h1 * h1 + t1 * h2
                # of the deflection itself: h - s would be rounding where nothing touches
                back = deflection(s / sigma, layered.constants[0], layered.table)[0]
                layered.asperities[0, j, i] = sigma * back / soft
                layered.asperities[1, j, i] = (h1 - 1.0) / soft
            flow, flow1 = rough_flow(h / sigma)
            field[CONDUCTANCE, i] = scale * metric[i] * flow
            field[POWER, i] = flow1 / (flow * sigma) * field[OPEN, i] / max(field[OPEN_1, i] / h1, _FLAT)


@inner_kernel
def _set_faces(layered: LayeredFilm, speed: float, ambient: float) -> None:
    """Wedge and conductance around at the faces, with their changes by the deflection."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    cell, sigma, soft = 2.0 * np.pi / m, layered.constants[1], layered.constants[2]
    metric = film.rings[1, METRIC]
    for j in range(n):
        field, scale, pressure = film.face[:, j], film.weights[j] / cell * sigma**3, film.pressures[0, j]
        for i in range(m):
            fore = i + 1 if i + 1 < m else 0
            here = soft * max(pressure[i] + ambient, 0.0)
            there = soft * max(pressure[fore] + ambient, 0.0)
            h, h1 = field[GAP, i] + 0.5 * (here + there), 1.0
            t, t1 = field[GAP, i] + (here if speed >= 0.0 else there), 1.0
            if h < REACH * sigma:
                h, h1, _ = _gap(layered, h)
            if t < REACH * sigma:
                t, own, _ = _gap(layered, t)
                t, t1, _ = flow_gap(t, sigma)
                t1 *= own
            flow, flow1 = rough_flow(h / sigma)
            slope = flow1 / (flow * sigma) * h1
            field[OPEN, i], field[OPEN_1, i] = t, t1
            field[CONDUCTANCE, i] = scale / metric[i] * flow
            field[POWER, i] = slope * t / max(t1, _FLAT)
            layered.advected[0, j, i] = film.weights[j] * speed * t1
            layered.advected[1, j, i] = slope * field[CONDUCTANCE, i] * (pressure[fore] - pressure[i])


@inner_kernel
def _linearise(layered: LayeredFilm, v: Floats, speed: float, ambient: float, turned: bool) -> None:
    """Jacobian, transposed as the solver wants it or, `turned`, for the adjoint; and the residual."""
    film = layered.film
    n, m, length = film.face.shape[1], film.circle.shape[2], film.face.shape[2]
    width = film.coupling.shape[0] // m
    block, soft = n * width, layered.constants[2]
    cos, sin = film.rings[1, COS], film.rings[1, SIN]
    b, sides, pressures = layered.blocks[0], film.sides, film.pressures[0]
    _set_columns(layered, ambient)
    _set_faces(layered, speed, ambient)
    axial = film.column[CONDUCTANCE].reshape(-1)
    b[:] = 0.0
    for i in range(m):
        for k in range(0, block, LANES):
            add_rows(b, i * block + k, axial, i, length, film.products, k, block, n + 2)
    for j in range(n):
        t, along, squeeze = film.face[OPEN, j], film.face[CONDUCTANCE, j], film.column[SQUEEZE, j]
        t1, t2 = film.column[OPEN_1, j], film.column[OPEN_2, j]
        wedge, bent = layered.advected[0, j], layered.advected[1, j]
        weight = film.weights[j]
        ux, uy = v[0] + v[3] * film.nodes[j], v[1] - v[2] * film.nodes[j]
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            fore = i + 1 if i + 1 < m else 0
            squeeze[i] = uy * (cos[i] - cos[back]) - ux * (sin[i] - sin[back])
            here = soft if pressures[j, i] + ambient > 0.0 else 0.0
            there = soft if pressures[j, fore] + ambient > 0.0 else 0.0
            # flow at the face after column i: by the pressure of column i, and less that of the next
            own = along[i] + here * ((wedge[i] if speed >= 0.0 else 0.0) - 0.5 * bent[i])
            next_ = along[i] - there * ((0.0 if speed >= 0.0 else wedge[i]) - 0.5 * bent[i])
            at = i * width + j
            layered.lower[at], layered.upper[at] = (next_, own) if turned else (own, next_)
            b[i * block + j * width + j] += own + 2.0 * weight * t2[i] * squeeze[i] * here
            b[fore * block + j * width + j] += next_
            flow = -along[i] * pressures[n + j, i] + weight * speed * t[i]
            before = -film.face[CONDUCTANCE, j, back] * pressures[n + j, back] + weight * speed * t[back]
            sides[at] = before - flow - 2.0 * weight * t1[i] * squeeze[i]
    for i in range(m):
        for q in range(n + 2):
            slope = pressures[2 * n + q, i]
            flow = film.column[CONDUCTANCE, q, i] * slope
            for j in range(n):
                sides[i * width + j] -= film.slopes[q * n + j] * flow
            if q < n and pressures[q, i] + ambient > 0.0:
                gain = (
                    film.column[POWER, q, i]
                    * film.column[OPEN_1, q, i]
                    / film.column[OPEN, q, i]
                    * flow
                    * soft
                )
                for j in range(n):
                    at = i * block + (j * width + q if turned else q * width + j)
                    b[at] += film.slopes[q * n + j] * gain


@inner_kernel
def _advance(layered: LayeredFilm, most: float) -> float:
    """Add the step in `sides` to the pressure; its size over the largest pressure.

    A step raises the pressure by `most` only: from a closed gap the linear film would overshoot.
    """
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    step, largest = 0.0, 0.0
    for j in range(n):
        for i in range(m):
            at = i * width + j
            before = film.pressures[0, j, i]
            film.sides[at] = min(before + film.sides[at], max(before, 0.0) + most)
            step = max(step, abs(film.sides[at] - before))
            largest = max(largest, abs(film.sides[at]))
    unfold(film, 0, 0, 1)
    return step / largest if largest > 0.0 else 0.0


@stage
def solve_layered(
    layered: LayeredFilm, q: Floats, v: Floats, speed: float, ambient: float, sigma: float, result: Floats
) -> int:
    """Solve for the pressure by Newton's method; otherwise as `reynolds.solve_pressure`."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    shape_gap(film, None, q, sigma, 1.0)
    film.mixed[SHARE] = 0.0
    status = NOT_CONVERGED
    for attempt in range(len(_STEPS)):
        for j in range(n):
            for i in range(m):
                # first a wall that gives way to where nothing overlaps, then one at rest
                overlap = max(-film.column[GAP, j, i], 0.0) if attempt == 0 else 0.0
                film.sides[i * width + j] = overlap / layered.constants[2]
        unfold(film, 0, 0, 1)
        most = _STEPS[attempt] * sigma / layered.constants[2]
        status = NOT_CONVERGED
        for _ in range(ROUNDS):
            _linearise(layered, v, speed, ambient, False)
            b, w, y = layered.blocks[0], layered.blocks[1], layered.blocks[2]
            if not factorise_ring(b, layered.lower, layered.upper, w, y, layered.work, m, n, width):
                status = NO_SOLUTION
                break
            solve_ring(b, layered.lower, layered.upper, w, y, film.sides, layered.work, m, n, width, 1)
            if _advance(layered, most) < _PRECISION:
                status = OK
                break
        if status == OK:
            break
    if status == OK:
        _linearise(layered, v, speed, ambient, True)
        integrate(film, None, ambient, result)
        result[FLOW] = side_flow(film, None, q, v, speed, sigma)
    return status
