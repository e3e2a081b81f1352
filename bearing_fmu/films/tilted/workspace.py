"""Work space and layout of the film between a tilted journal and its bore.

Nothing in the work space outlives an evaluation.  So films of one resolution take it from a common stock,
which stays in the processor's nearest memory, whatever the number of bearings.

In the corners of accuracy grids of their own serve, see `corner_films`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.axial import CLUSTERING, axial_basis, end_slopes
from bearing_fmu.kernels.grid import RING_ROWS
from bearing_fmu.kernels.vector import padded
from bearing_fmu.result import FIELDS
from bearing_fmu.stock import Stock

Floats = NDArray[np.float64]

LINES = 12  #: for each row


class TiltedFilm(NamedTuple):
    """Everything prepared once for one bearing, basis and uniform circle, and work space.

    n rows and m columns; n' and m' are padded to whole vectors.  A *pressure* is a stack of n rows
    of nodal values, n rows of their differences to the next column, and n + 2 rows of axial slopes.
    """

    nodes: Floats  #: (n + 2,) z of the interior nodes and the two ends
    weights: Floats  #: (n + 2,) of integrals over z
    stiffness: Floats  #: (n + 2,) of the axial stiffness, (2R/b)^2 included
    slopes: Floats  #: ((n + 2) n,) derivatives of the basis
    products: Floats  #: ((n + 2) n n',) their outer products
    fine: Floats  #: (4 n, n) basis between the nodes
    ends: Floats  #: (2, n + 2) derivatives of what is 1 at an end and 0 at all other nodes
    lines: Floats  #: (12 n, n) basis on the lines between the nodes
    back: Floats  #: (12 n, n) what of a line's weight each row takes, over its own
    circle: Floats  #: (2, 2, m) columns and faces; cos and sin of the uniform angle
    held: Floats  #: (n, m') 1 where the film is ruptured, 2 where the pressure is always the cavity's
    # from here on work space
    rings: Floats  #: (2, RING_ROWS, m) columns and faces on the graded grid
    grading: Floats  #: (7, 4) map parameter, its derivative, work space
    column: Floats  #: (FIELDS, n + 2, m') at the columns
    face: Floats  #: (FIELDS, n, m') between the columns
    nodal: Floats  #: (4, n, m') bearing part of the pressure and its derivatives
    cuts: Floats  #: (12 n, 4, m') as `nodal`, on the lines
    mixed: Floats  #: (1,) whether the positive part is cut on lines, see `lines`
    pressures: Floats  #: (5, 3 n + 2, m') the pressure and four adjoint ones
    forcing: Floats  #: (6, 3 n + 2, m') tangent of the residual and what it is made of
    blocks: Floats  #: (3, m n n') factor
    coupling: Floats  #: (m n',) between neighbouring columns
    sides: Floats  #: (4 m n',) right-hand sides, then solutions
    block: Floats  #: (n n',) work space
    row: Floats  #: (8 n',) work space
    blend: Floats  #: (8,) work space of two grids, see `films.corners`


def work_space(columns: int, rows: int) -> dict[str, Floats]:
    """The arrays of a new work space."""
    width, length = padded(rows), padded(columns)
    return {
        "rings": np.zeros((2, RING_ROWS, columns)),
        "grading": np.zeros((7, 4)),
        "column": np.zeros((FIELDS, rows + 2, length)),
        "face": np.zeros((FIELDS, rows, length)),
        "nodal": np.zeros((4, rows, length)),
        "cuts": np.zeros((LINES * rows, 4, length)),
        "mixed": np.zeros(1),
        "pressures": np.zeros((5, 3 * rows + 2, length)),
        "forcing": np.zeros((6, 3 * rows + 2, length)),
        "blocks": np.zeros((3, columns * rows * width)),
        "coupling": np.zeros(columns * width),
        "sides": np.zeros(4 * columns * width),
        "block": np.zeros(rows * width),
        "row": np.zeros(8 * width),
        "blend": np.zeros(8),
    }


STOCK = Stock(work_space)
"""Of the tilted films of this process."""


def tilted_film(
    columns: int, rows: int, aspect: float, space: dict[str, Floats], clustering: float = CLUSTERING
) -> TiltedFilm:
    """Prepare a film of `columns` x `rows` with 2R/b = `aspect` in a work space."""
    basis = axial_basis(rows, clustering)
    width = padded(rows)
    products = np.zeros((rows + 2, rows, width))
    products[:, :, :rows] = basis.stiffness_products()
    angle = 2.0 * np.pi / columns * np.arange(2 * columns) / 2.0
    circle = np.array([[np.cos(t), np.sin(t)] for t in (angle[::2], angle[1::2])])
    on_lines, back = basis.lines(LINES * rows)
    return TiltedFilm(
        nodes=basis.nodes,
        weights=basis.weights,
        stiffness=basis.stiffness_weights() * aspect**2,
        slopes=basis.slopes.ravel(),
        products=products.ravel(),
        fine=basis.interpolation(basis.place(np.linspace(-1.0, 1.0, 4 * rows + 2)[1:-1])),
        ends=end_slopes(basis),
        lines=on_lines,
        back=back,
        circle=circle,
        held=np.zeros((rows, padded(columns))),
        **{name: array for name, array in space.items() if name in TiltedFilm._fields},
    )
