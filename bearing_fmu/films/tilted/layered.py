"""V1 on a soft layer: what is prepared of it, and its work space; the equations: `layered_equations`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.slice import CONTACT_RESULTS
from bearing_fmu.films.tilted.corner_films import TiltedFilms
from bearing_fmu.films.tilted.workspace import TiltedFilm, work_space
from bearing_fmu.kernels.cells import NEAR, AxialCells
from bearing_fmu.kernels.unsymmetric_solver import ring_work
from bearing_fmu.kernels.vector import LANES, padded
from bearing_fmu.result import FIELDS, RESULTS

Floats = NDArray[np.float64]

#: Cells along the axis for each row of the rigid film, their clustering at the ends, see `kernels.cells`, and
#: grading of the columns, see `bore.place_rings`; chosen over states in balance and those of a turbine's run.
CELLS, CLUSTERING, GRADING = 2, 2.25, 1.3
#: Of `time`: length of the step; the rate 1/s that follows from it, 0 where nothing is remembered; which of
#: two memories that is, see `deformation`.
STEP, RATE, SOURCE = 0, 1, 2
KEPT = 8  #: What stands before the nodes in what is remembered, see `deformation`


class LayeredFilm(NamedTuple):
    """A tilted film on its layer; n rows, m columns, n' and m' padded."""

    film: TiltedFilm
    rigid: TiltedFilms  #: on which it is solved where the layer hardly gives way
    table: Floats  #: of `contact.layer.layer_table`
    edge: Floats  #: of `contact.edge.edge_table`
    constants: Floats  #: first s of the table; roughness, compliance times pressure unit, both over the
    # clearance; hardness; (2R/b)^2; part of the outer half in the weight of a last cell
    sums: TiltedFilm  #: the same with the weights and levers of the pressure's integrals
    lines: Floats  #: (lines, 1 + NEAR) what makes the pressure on those where the asperities' force is summed
    places: Floats  #: (2, lines) z of the lines, and their weights
    faces: Floats  #: (n + 1, 2 + NEAR) z of the axial faces, and what makes the pressure there
    adjoint: Floats  #: (m n 8,) four adjoint pressures
    over_z: Floats  #: (4, 10, m') of each adjoint pressure, see `layered_residual`
    moments: Floats  #: (6, m') on the columns, see `layered_contact`
    kept: Floats  #: (m n',) pressure before a step
    pressed: Floats  #: (n, m'') how far the film presses the wall back at the columns, and again at the first
    rows: Floats  #: (4, m'') work space
    near: Floats  #: (n, NEAR + 1, m') of the Jacobian, of each cell the next ones along the axis
    advected: (
        Floats  #: (3, n, m') change of the wedge by the deflection before and behind the faces, of the flow
    )
    outer: (
        Floats  #: (3, 2, m') mean pressure of the outer halves over that in the last cells, and its changes
    )
    across: Floats  #: (FIELDS, n + 1, m') at the axial faces
    lower: Floats  #: (m n',) couplings of the Jacobian
    upper: Floats  #: (m n',)
    blocks: Floats  #: (3, m n n') its factor
    work: Floats  #: of `ring_work`
    usual: Floats  #: (RESULTS + CONTACT_RESULTS,) work space of two solutions
    stiff: Floats  #: (RESULTS,) work space, of the rigid bore
    change: Floats  #: (9,) how far the layer takes part, by q and v; the last: how far it did, 0 to 1
    time: Floats  #: (3,) length of the step, s, 0 for a film in balance; rate; which memory
    then: Floats  #: (2, KEPT + 2 n m) what is remembered from before the step, see `deformation`
    now: Floats  #: (2, KEPT + 2 n m) what is remembered after it
    from_rigid: Floats  #: (n, rows) rows of the layered film from those of the rigid one
    ahead: Floats  #: (n, m) how far it is guessed to have given way after the step
    drift: Floats  #: (4,) work space
    way: Floats  #: (2, 4) work space
    counts: Floats  #: (3,) factors, solutions with them, and searches of the last evaluation
    was: Floats  #: (2, n, m) how far the wall had given way at the columns of now, and its slope by the angle


def _cell_film(like: TiltedFilm, cells: AxialCells) -> TiltedFilm:
    """A film with the columns of another, these cells along its axis, and its own work space."""
    n, m = cells.rows, like.circle.shape[2]
    none = np.zeros((1, n))
    return like._replace(
        nodes=cells.nodes,
        weights=cells.weights,
        stiffness=np.zeros(n + 2),
        slopes=cells.slopes().ravel(),
        products=np.zeros(1),
        fine=np.eye(n),  # between them the cubic polynomial overshoots where the pressure falls to an end
        ends=np.zeros((2, n + 2)),
        lines=none,
        back=none,
        held=np.zeros((n, padded(m))),
        **work_space(m, n),
    )


def layered_film(
    like: TiltedFilm, rigid: TiltedFilms, cells: AxialCells, aspect: float, from_rigid: Floats, first: float,
    table: Floats, edge: Floats, sigma: float, compliance: float, hardness: float,
) -> LayeredFilm:  # fmt: skip
    """Prepare the film, of these cells along the axis, with its own work space."""
    n, m = cells.rows, like.circle.shape[2]
    width, length = padded(n), padded(m)
    places, weights = cells.lines()
    film, (whole, moments) = _cell_film(like, cells), cells.integrals()
    levers = np.append(moments / whole, cells.nodes[n:])
    return LayeredFilm(
        film=film,
        sums=film._replace(weights=np.append(whole, np.zeros(2)), nodes=levers),
        rigid=rigid,
        table=table,
        edge=edge,
        constants=np.array(
            [first, sigma, compliance, hardness, aspect**2, 0.5 * cells.weights[0] / whole[0]]
        ),
        lines=cells.between(places),
        places=np.array((places, weights)),
        faces=np.hstack((cells.faces[:, None], cells.between(cells.faces))),
        adjoint=np.zeros(m * n * LANES),
        over_z=np.zeros((4, 10, length)),
        moments=np.zeros((6, length)),
        kept=np.zeros(m * width),
        pressed=np.zeros((n, padded(m + 1))),
        rows=np.zeros((4, padded(m + 1))),
        near=np.zeros((n, NEAR + 1, length)),
        advected=np.zeros((3, n, length)),
        outer=np.zeros((3, 2, length)),
        across=np.zeros((FIELDS, n + 1, length)),
        lower=np.zeros(m * width),
        upper=np.zeros(m * width),
        blocks=np.zeros((3, m * n * width)),
        work=ring_work(n),
        usual=np.zeros(RESULTS + CONTACT_RESULTS),
        stiff=np.zeros(RESULTS),
        change=np.zeros(9),
        time=np.zeros(3),
        then=np.zeros((2, KEPT + 2 * n * m)),
        now=np.zeros((2, KEPT + 2 * n * m)),
        from_rigid=from_rigid,
        ahead=np.zeros((n, m)),
        drift=np.zeros(4),
        way=np.zeros((2, 4)),
        counts=np.zeros(3),
        was=np.zeros((2, n, m)),
    )
