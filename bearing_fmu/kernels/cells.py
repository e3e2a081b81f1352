"""Finite volumes along the axis, dense at the ends, for films whose pressure is not smooth there.

A cell's pressure is that in its middle. Between the middles it is interpolated by the four next cells, at
the faces between them the slope is that of the same cubic polynomial; beyond the last middles, where the
pressure falls to that at the end, perhaps within a small part of the cell, `bearing_fmu.contact.edge`
says what happens.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

NEAR = 4  #: cells that make what is interpolated, and the least number of cells
_LINES = 2  #: points of Gauss' rule on each half of a cell


@dataclass(frozen=True)
class AxialCells:
    """Cells over z in [-1, 1], which is the axial coordinate over half the width.

    Attributes
    ----------
    faces : ndarray, shape (rows + 1,)
        z of the faces, those of the ends included.
    nodes : ndarray, shape (rows + 2,)
        z of the middles of the cells, then of the two ends -1 and 1.
    weights : ndarray, shape (rows + 2,)
        Widths of the cells; of the ends 0.
    """

    faces: Floats
    nodes: Floats
    weights: Floats

    @property
    def rows(self) -> int:
        """Number of cells."""
        return self.faces.size - 1

    def slopes(self) -> Floats:
        """Slope by z at each face (row) of a pressure in each cell (column), 0 at the ends."""
        n, nodes = self.rows, self.nodes[: self.rows]
        slopes = np.zeros((n + 2, n))
        for k in range(1, n):
            first = min(max(k - NEAR // 2, 0), n - NEAR)
            x = nodes[first : first + NEAR] - self.faces[k]
            slopes[k, first : first + NEAR] = np.linalg.inv(np.vander(x, increasing=True))[1]
        slopes[0, 0] = 1.0 / (nodes[0] + 1.0)
        slopes[n, n - 1] = -1.0 / (1.0 - nodes[n - 1])
        return slopes

    def between(self, z: Floats) -> Floats:
        """What makes the pressure at points z: the first of the next cells, and the parts of each.

        Returns
        -------
        ndarray, shape (points, 1 + NEAR)
        """
        n, nodes = self.rows, self.nodes[: self.rows]
        first = np.clip(np.searchsorted(nodes, z) - NEAR // 2, 0, n - NEAR)
        found = np.ones((z.size, 1 + NEAR))
        found[:, 0] = first
        for i in range(NEAR):
            for k in range(NEAR):
                if k != i:
                    at = nodes[first + k]
                    found[:, 1 + i] *= (z - at) / (nodes[first + i] - at)
        return found

    def interpolation(self, z: Floats) -> Floats:
        """As `between`, a column for each cell."""
        parts = self.between(z)
        dense = np.zeros((z.size, self.rows))
        first = parts[:, 0].astype(int)
        for i in range(NEAR):
            dense[np.arange(z.size), first + i] = parts[:, 1 + i]
        return dense

    def lines(self) -> tuple[Floats, Floats]:
        """Lines on which what changes within a cell is summed, but for the outer halves of the last cells.

        Returns
        -------
        places, weights : ndarray, shape (lines,)
            z and weights of integrals.
        """
        places, weights = [], []
        nodes = self.nodes
        t, w = np.polynomial.legendre.leggauss(_LINES)
        for k in range(self.rows - 1):
            for low, high in ((nodes[k], self.faces[k + 1]), (self.faces[k + 1], nodes[k + 1])):
                places.append(low + 0.5 * (t + 1.0) * (high - low))
                weights.append(0.5 * w * (high - low))
        return np.concatenate(places), np.concatenate(weights)

    def means(self, values: Callable[[Floats], Floats]) -> Floats:
        """Means over the cells of functions of z, given as `values` at points (rows)."""
        t, w = np.polynomial.legendre.leggauss(4)
        n = self.rows
        middle, half = self.nodes[:n], 0.5 * self.weights[:n]
        at = (middle[:, None] + half[:, None] * t).ravel()
        return np.einsum("k,jkr->jr", 0.5 * w, values(at).reshape(n, t.size, -1))

    def integrals(self) -> tuple[Floats, Floats]:
        """Weights of integrals of the pressure and of the pressure times z, shape (rows,) each.

        A cell has the parabola through its middle and those of its neighbours, beyond the last middle the
        pressure there.
        """
        n, nodes = self.rows, self.nodes[: self.rows]
        weights, moments = np.zeros(n), np.zeros(n)
        t, w = np.polynomial.legendre.leggauss(3)
        for k in range(n):
            first = min(max(k - 1, 0), n - 3)
            for low, high in ((self.faces[k], nodes[k]), (nodes[k], self.faces[k + 1])):
                z, part = low + 0.5 * (t + 1.0) * (high - low), 0.5 * w * (high - low)
                if low == -1.0 or high == 1.0:
                    weights[k] += part.sum()
                    moments[k] += part @ z
                    continue
                for i in range(first, first + 3):
                    others = np.delete(nodes[first : first + 3], i - first)
                    value = np.prod((z[:, None] - others) / (nodes[i] - others), axis=1)
                    weights[i] += part @ value
                    moments[i] += (part * z) @ value
        return weights, moments


def axial_cells(rows: int, clustering: float) -> AxialCells:
    """Cells with faces at z = tanh(k t) / tanh(k), t evenly spaced."""
    faces = np.tanh(clustering * np.linspace(-1.0, 1.0, rows + 1)) / np.tanh(clustering)
    faces = 0.5 * (faces - faces[::-1])
    ends = np.array([-1.0, 1.0])
    return AxialCells(
        faces=faces,
        nodes=np.concatenate((0.5 * (faces[1:] + faces[:-1]), ends)),
        weights=np.concatenate((np.diff(faces), np.zeros(2))),
    )
