"""Work space and axial modes of the film of the aligned journal."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from bearing_fmu.kernels.axial import axial_basis, end_slopes
from bearing_fmu.kernels.grid import RING_ROWS
from bearing_fmu.result import FIELDS

Floats = NDArray[np.float64]


class AlignedFilm(NamedTuple):
    """Everything prepared once for one bearing; m columns, r even modes, h rows with z >= 0."""

    values: Floats  #: (r,) eigenvalues, (2R/b)^2 included
    drive: Floats  #: (r,) of a right-hand side that is constant over z
    shapes: Floats  #: (h, r) modes at the rows
    fine: Floats  #: (2 rows, r) modes between the rows, from the middle on
    outflow: Floats  #: (r + 1,) flow out at both ends by unit pressures, and by the film that opens
    weights: Floats  #: (h,) of integrals over z, both halves
    circle: Floats  #: (2, 2, m) columns and faces; cos and sin of the uniform angle
    rings: Floats  #: (2, RING_ROWS, m)
    grading: Floats  #: (7, 4)
    fields: Floats  #: (2, FIELDS, m) columns and faces
    nodal: Floats  #: (h, 4, m) bearing part of the pressure and its derivatives
    modal: Floats  #: (3, m, r) the pressure and two adjoint ones
    factor: Floats  #: (m, 2, r) reciprocal pivots and coupling to the last column
    forcing: Floats  #: (8, m) work space


def aligned_film(columns: int, rows: int, aspect: float) -> AlignedFilm:
    """Prepare a film of `columns` x `rows` with 2R/b = `aspect`."""
    basis = axial_basis(rows)
    mass = basis.weights[:rows]
    stiffness = np.einsum("q,qjk->jk", basis.stiffness_weights() * aspect**2, basis.stiffness_products())
    values, modes = eigh(stiffness, np.diag(mass))
    even = np.flatnonzero(np.abs(mass @ modes) > 1e-8)
    half = np.flatnonzero(basis.nodes[:rows] > -1e-12)
    double = np.where(basis.nodes[half] > 1e-12, 2.0, 1.0)
    places = np.linspace(0.0, 1.0, 2 * rows + 1)[:-1]
    along = end_slopes(basis).sum(axis=0) * basis.stiffness_weights() * aspect**2
    angle = 2.0 * np.pi / columns * np.arange(2 * columns) / 2.0
    return AlignedFilm(
        values=values[even],
        drive=(mass @ modes)[even],
        shapes=np.ascontiguousarray(modes[np.ix_(half, even)]),
        fine=np.ascontiguousarray((basis.interpolation(basis.place(places)) @ modes)[:, even]),
        outflow=np.append(-(along @ basis.slopes @ modes)[even], -basis.weights[rows:].sum()),
        weights=mass[half] * double,
        circle=np.array([[np.cos(t), np.sin(t)] for t in (angle[::2], angle[1::2])]),
        rings=np.zeros((2, RING_ROWS, columns)),
        grading=np.zeros((7, 4)),
        fields=np.zeros((2, FIELDS, columns)),
        nodal=np.zeros((half.size, 4, columns)),
        modal=np.zeros((3, columns, even.size)),
        factor=np.zeros((columns, 2, even.size)),
        forcing=np.zeros((8, columns)),
    )
