"""The film as one writes it in an afternoon: uniform finite volumes, scipy.sparse, difference tangents.

The other side of benchmark a.  Dimensionless, with P = p C^2 / (mu speed R^2), z from -1 to 1 and

    d/dphi(H^3 dP/dphi) + (D/L)^2 d/dz(H^3 dP/dz) = 6 dH/dphi + 12 dH/dt,
    H = 1 - (x + ty z) cos(phi) - (y - tx z) sin(phi).

Negative pressures are set to zero at the nodes afterwards (Gümbel 1914).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

Array = NDArray[np.float64]

DIFFERENCE = 1e-6
"""Step of the difference tangents in every component of the dimensionless state."""


@dataclass(frozen=True)
class UniformFilm:
    """A film on cells of equal size.

    Attributes
    ----------
    columns, rows : int
        Cells around the circumference and along the axis.
    aspect : float
        L/D.
    """

    columns: int
    rows: int
    aspect: float

    def wrench(self, q: Array, v: Array) -> Array:
        """(Fx, Fy, Mx, My) at the state q, v = (x, y, tx, ty) and its rate, (4,)."""
        return self._wrench(self._factor(q), q, v)

    def tangent(self, q: Array, v: Array) -> tuple[Array, Array]:
        """Wrench (4,) and -dF/d(q, v) (4, 8) by eight forward differences.

        Of the nine systems the four with another v share the factor of the first.
        """
        factor = self._factor(q)
        wrench = self._wrench(factor, q, v)
        tangent = np.empty((4, 8))
        for k in range(4):
            step = DIFFERENCE * np.eye(4)[k]
            tangent[:, k] = wrench - self.wrench(q + step, v)
            tangent[:, 4 + k] = wrench - self._wrench(factor, q, v + step)
        return wrench, tangent / DIFFERENCE

    def _gap(self, phi: Array, z: Array, q: Array) -> Array:
        x, y, tx, ty = q
        return 1.0 - (x + ty * z) * np.cos(phi) - (y - tx * z) * np.sin(phi)

    def _cells(self) -> tuple[Array, Array, float, float]:
        width, height = 2.0 * np.pi / self.columns, 2.0 / self.rows
        phi = width * np.arange(self.columns)
        z = -1.0 + height * (np.arange(self.rows) + 0.5)
        return phi[:, None], z[None, :], width, height

    def _factor(self, q: Array) -> object:
        """LU factor of the symmetric five-point matrix, P = 0 at both ends."""
        phi, z, width, height = self._cells()
        around = self._gap(phi + 0.5 * width, z, q) ** 3 * height / width
        edges = np.linspace(-1.0, 1.0, self.rows + 1)[None, :]
        along = self._gap(phi, edges, q) ** 3 * width / height / self.aspect**2
        along[:, [0, -1]] *= 2.0  # the wall is half a cell away
        diagonal = around + np.roll(around, 1, axis=0) + along[:, :-1] + along[:, 1:]
        index = np.arange(self.columns * self.rows).reshape(self.columns, self.rows)
        after, inner = np.roll(index, -1, axis=0), along[:, 1:-1].ravel()
        pairs = [
            (index.ravel(), after.ravel(), around.ravel()),
            (index[:, :-1].ravel(), index[:, 1:].ravel(), inner),
        ]
        row = np.concatenate([index.ravel(), *(a for i, j, _ in pairs for a in (i, j))])
        column = np.concatenate([index.ravel(), *(a for i, j, _ in pairs for a in (j, i))])
        value = np.concatenate([diagonal.ravel(), *(-v for _, _, v in pairs for _ in range(2))])
        matrix = sp.csc_matrix((value, (row, column)))
        symmetric = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0}
        return splu(matrix, options={"SymmetricMode": True}, **symmetric)

    def _wrench(self, factor: object, q: Array, v: Array) -> Array:
        phi, z, width, height = self._cells()
        wedge = self._gap(phi + 0.5 * width, z, q) - self._gap(phi - 0.5 * width, z, q)
        squeeze = self._gap(phi, z, v) - 1.0
        flow = -(6.0 * wedge * height + 12.0 * squeeze * width * height)
        pressure = np.maximum(factor.solve(flow.ravel()), 0.0).reshape(flow.shape) * width * height
        cos, sin = np.cos(phi), np.sin(phi)
        parts = (-pressure * cos, -pressure * sin, pressure * z * sin, -pressure * z * cos)
        return np.array([part.sum() for part in parts])
