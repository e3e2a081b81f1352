"""V1 on a soft layer: film and asperities press the wall back, the gap follows from both.

At each node the rigid gap plus c times the film's pressure is the gap s without asperities, from which
`bearing_fmu.contact.layer` gives the gap; there the oil flows by Patir and Cheng's flow factor, and the
wedge is the average gap of `bore.gap`. The discrete equations are those of `reynolds`, now not linear in
the pressure. Where a film presses the wall back it advects its own deflection, which is taken mostly from
the upstream column. How far the wall had given way before a step, see `deformation`, makes its rate, which
counts in the squeezed volume as that of the journal does, by implicit Euler.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.gap import flow_gap
from bearing_fmu.contact.asperities import REACH
from bearing_fmu.contact.layer import deflection, rough_flow
from bearing_fmu.contact.slice import CONTACT_RESULTS
from bearing_fmu.films.tilted.corner_films import TiltedFilms
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.axial import AxialBasis
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import COS, METRIC, SIN
from bearing_fmu.kernels.vector import LANES, add_rows
from bearing_fmu.result import CONDUCTANCE, GAP, OPEN, OPEN_1, OPEN_2, POWER, RESULTS, SQUEEZE

Floats = NDArray[np.float64]

#: Share of the upstream column in the deflection that is advected: with 1 it is smeared, with 1/2 it swings.
UPSTREAM = 0.75
#: Clustering of rows at the ends, see `kernels.axial`, and grading of the columns, see `bore.place_rings`:
#: over states of a turbine's run the largest pressure at 48 x 8 is within some 10 % (with 1.7 and 1, 31 %).
CLUSTERING, GRADING = 2.4, 1.3
_LINES = 4  #: for each row, on which the asperities' force is summed
_FLAT = 1e-12
KEPT = 8  #: What stands before the nodes in what is remembered, see `deformation`


class LayeredFilm(NamedTuple):
    """A tilted film on its layer; n rows, m columns, n' and m' padded."""

    film: TiltedFilm
    rigid: TiltedFilms  #: on which it is solved where the layer hardly gives way, with the same work space
    table: Floats  #: of `contact.layer.layer_table`
    constants: (
        Floats  #: first s of the table; roughness, compliance times pressure unit over clearance; hardness
    )
    lines: Floats  #: (4 n, n) basis on the lines on which the asperities' force is summed
    places: Floats  #: (2, 4 n) z of the lines, and their weights
    explicit: Floats  #: (16,) work space
    kept: Floats  #: (m n',) pressure before a step
    advected: Floats  #: (2, n, m') change of wedge and of flow by the deflection at the faces
    lower: Floats  #: (m n',) couplings of the Jacobian
    upper: Floats  #: (m n',)
    blocks: Floats  #: (3, m n n') its factor
    work: Floats  #: (2 n n' + 4 n',)
    usual: Floats  #: (RESULTS + CONTACT_RESULTS,) work space of two solutions
    stiff: Floats  #: (RESULTS,) work space, of the rigid bore
    change: Floats  #: (9,) how far the layer takes part, by q and v; the last: how far it did, 0 to 1
    time: Floats  #: (2,) length of the step, s, 0 for a film in balance; the rate 1/s that follows from it
    then: Floats  #: (KEPT + 2 n m,) what is remembered from before the step, see `deformation`
    now: Floats  #: (KEPT + 2 n m,) what is remembered after it
    from_rigid: Floats  #: (n, n) rows of the layered film from those of the rigid one
    ahead: Floats  #: (n, m) how far it is guessed to have given way after the step
    drift: Floats  #: (4,) work space
    way: Floats  #: (2, 4) work space
    counts: Floats  #: (3,) factors, solutions with them, and searches of the last evaluation
    was: Floats  #: (2, n, m) how far the wall had given way at the columns of now, and its slope by the angle


def layered_film(
    film: TiltedFilm, rigid: TiltedFilms, basis: AxialBasis, from_rigid: Floats, first: float, table: Floats,
    sigma: float, compliance: float, hardness: float,
) -> LayeredFilm:  # fmt: skip
    """Prepare the film, of this axial basis, with its own work space."""
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    places, weights = basis.gauss(_LINES * n)
    return LayeredFilm(
        film=film,
        rigid=rigid,
        table=table,
        constants=np.array([first, sigma, compliance, hardness]),
        lines=basis.interpolation(places),
        places=np.array((places, weights)),
        explicit=np.zeros(16),
        kept=np.zeros(m * width),
        advected=np.zeros((2, n, film.face.shape[2])),
        lower=np.zeros(m * width),
        upper=np.zeros(m * width),
        blocks=np.zeros((3, m * n * width)),
        work=np.zeros(2 * n * width + 4 * width),
        usual=np.zeros(RESULTS + CONTACT_RESULTS),
        stiff=np.zeros(RESULTS),
        change=np.zeros(9),
        time=np.zeros(2),
        then=np.zeros(KEPT + 2 * n * m),
        now=np.zeros(KEPT + 2 * n * m),
        from_rigid=from_rigid,
        ahead=np.zeros((n, m)),
        drift=np.zeros(4),
        way=np.zeros((2, 4)),
        counts=np.zeros(3),
        was=np.zeros((2, n, m)),
    )


@inner_kernel
def _gap(layered: LayeredFilm, s: float) -> tuple[float, float, float]:
    """Gap and its two derivatives by s, all over the clearance."""
    first, sigma = layered.constants[0], layered.constants[1]
    back, slope, bend = deflection(s / sigma, first, layered.table)
    return s + sigma * back, 1.0 + slope, bend / sigma


@inner_kernel
def _set_columns(layered: LayeredFilm, ambient: float) -> None:
    """Open gap and conductance along the axis at the columns."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    cell, sigma, soft = 2.0 * np.pi / m, layered.constants[1], layered.constants[2]
    metric, near = film.rings[0, METRIC], REACH * sigma
    for j in range(n + 2):
        field, scale = film.column[:, j], film.stiffness[j] * cell * sigma**3
        for i in range(m):
            pressure = ambient + (film.pressures[0, j, i] if j < n else 0.0)
            h, h1 = field[GAP, i] + soft * max(pressure, 0.0), 1.0
            t, t1, t2 = h, 1.0, 0.0
            if h < near:
                h, h1, h2 = _gap(layered, h)
                t, t1, t2 = flow_gap(h, sigma)
                t1, t2 = t1 * h1, t2 * h1 * h1 + t1 * h2
            field[OPEN, i], field[OPEN_1, i], field[OPEN_2, i] = t, t1, t2
            flow, flow1 = rough_flow(h / sigma)
            field[CONDUCTANCE, i] = scale * metric[i] * flow
            field[POWER, i] = flow1 / (flow * sigma) * t / max(t1 / h1, _FLAT)


@inner_kernel
def _set_faces(layered: LayeredFilm, speed: float, ambient: float) -> None:
    """Wedge and conductance around at the faces, with their changes by the deflection."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    cell, sigma, soft = 2.0 * np.pi / m, layered.constants[1], layered.constants[2]
    metric, from_here = film.rings[1, METRIC], UPSTREAM if speed >= 0.0 else 1.0 - UPSTREAM
    for j in range(n):
        field, scale, pressure = film.face[:, j], film.weights[j] / cell * sigma**3, film.pressures[0, j]
        for i in range(m):
            fore = i + 1 if i + 1 < m else 0
            here = soft * max(pressure[i] + ambient, 0.0)
            there = soft * max(pressure[fore] + ambient, 0.0)
            h, h1 = field[GAP, i] + 0.5 * (here + there), 1.0
            t, t1 = field[GAP, i] + from_here * here + (1.0 - from_here) * there, 1.0
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
def linearise(layered: LayeredFilm, v: Floats, speed: float, ambient: float, whole: bool) -> float:
    """Residual, and where the `whole` is wanted the Jacobian, transposed as the solver wants it.

    Returns
    -------
    float
        Norm of the residual.
    """
    film = layered.film
    n, m, length = film.face.shape[1], film.circle.shape[2], film.face.shape[2]
    width = film.coupling.shape[0] // m
    block, soft, square = n * width, layered.constants[2], 0.0
    rate, cell = layered.time[1], 2.0 * np.pi / m
    from_here = UPSTREAM if speed >= 0.0 else 1.0 - UPSTREAM
    cos, sin, metric = film.rings[1, COS], film.rings[1, SIN], film.rings[0, METRIC]
    b, sides, pressures = layered.blocks[0], film.sides, film.pressures[0]
    _set_columns(layered, ambient)
    _set_faces(layered, speed, ambient)
    axial = film.column[CONDUCTANCE].reshape(-1)
    if whole:
        b[:] = 0.0
    for i in range(m if whole else 0):
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
            gives = cell * metric[i] * rate
            squeeze[i] += gives * (soft * max(pressures[j, i] + ambient, 0.0) - layered.was[0, j, i])
            at = i * width + j
            if whole:
                here = soft if pressures[j, i] + ambient > 0.0 else 0.0
                there = soft if pressures[j, fore] + ambient > 0.0 else 0.0
                # flow at the face after column i: by the pressure of column i, and less that of the next
                own = along[i] + here * (from_here * wedge[i] - 0.5 * bent[i])
                next_ = along[i] - there * ((1.0 - from_here) * wedge[i] - 0.5 * bent[i])
                layered.lower[at], layered.upper[at] = own, next_
                b[i * block + j * width + j] += own
                b[i * block + j * width + j] += 2.0 * weight * here * (t2[i] * squeeze[i] + t1[i] * gives)
                b[fore * block + j * width + j] += next_
            flow = -along[i] * pressures[n + j, i] + weight * speed * t[i]
            before = -film.face[CONDUCTANCE, j, back] * pressures[n + j, back] + weight * speed * t[back]
            sides[at] = before - flow - 2.0 * weight * t1[i] * squeeze[i]
    for i in range(m):
        for q in range(n + 2):
            flow = film.column[CONDUCTANCE, q, i] * pressures[2 * n + q, i]
            for j in range(n):
                sides[i * width + j] -= film.slopes[q * n + j] * flow
            if whole and q < n and pressures[q, i] + ambient > 0.0:
                by_gap = film.column[POWER, q, i] * film.column[OPEN_1, q, i] / film.column[OPEN, q, i]
                at = i * block + q * width
                for j in range(n):
                    b[at + j] += film.slopes[q * n + j] * by_gap * flow * soft
        for j in range(n):
            square += sides[i * width + j] ** 2
    return np.sqrt(square)
