"""Symmetric matrices of narrow band, as beams give: factorised once, and their lowest modes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import scipy.linalg as sl
import scipy.sparse as sp
import scipy.sparse.linalg as sla
from numpy.typing import NDArray

Array = NDArray[np.float64]
Matrix: TypeAlias = Array | sp.csr_array

_DENSE = 800
"""Size up to which all eigenvalues are computed densely."""


@dataclass(frozen=True, eq=False)
class BandedCholesky:
    """Lower triangular L with L L.T = matrix, in LAPACK's lower band storage, (u + 1, n)."""

    band: Array

    def solve(self, loads: Array) -> Array:
        """Solve with the matrix, (n, k)."""
        return np.asarray(sl.cho_solve_banded((self.band, True), loads))

    def root_times(self, vectors: Array) -> Array:
        """L.T @ vectors, whose scalar products are those of the matrix, (n, k)."""
        upper, n = self._upper(), self.band.shape[1]
        return np.asarray(sp.dia_array((upper, np.arange(len(upper))), shape=(n, n)) @ vectors)

    def root_solve(self, vectors: Array) -> Array:
        """Solve with L.T, (n, k)."""
        upper = self._upper()
        return np.asarray(sl.solve_banded((0, len(upper) - 1), upper[::-1], vectors))

    def _upper(self) -> Array:
        """Diagonals of L.T from the main one up, entries of column j at place j."""
        return np.stack([np.roll(row, k) for k, row in enumerate(self.band)])


def lower_band(matrix: Matrix) -> Array:
    """A symmetric matrix in LAPACK's lower band storage, as narrow as it is, (u + 1, n)."""
    entries = sp.coo_array(matrix)
    row, column = entries.coords
    below = row >= column
    band = np.zeros((int((row - column).max(initial=0)) + 1, entries.shape[1]))
    np.add.at(band, (row[below] - column[below], column[below]), entries.data[below])
    return band


def cholesky(matrix: Matrix) -> BandedCholesky:
    """Factorise a symmetric, positive definite matrix.

    Raises
    ------
    numpy.linalg.LinAlgError
        If it is not positive definite to rounding: a pivot below n eps times its diagonal entry is none.
    """
    band = lower_band(matrix)
    factor = sl.cholesky_banded(band, lower=True)
    if np.any(factor[0] ** 2 < band.shape[1] * np.finfo(float).eps * band[0]):
        raise np.linalg.LinAlgError("singular to working precision")
    return BandedCholesky(factor)


def lowest_modes(mass: Matrix, stiffness: Matrix, count: int, shift: float = 0.0) -> tuple[Array, Array]:
    """The lowest modes of stiffness v = w^2 mass v.

    Parameters
    ----------
    mass, stiffness : ndarray or scipy.sparse.csr_array, (n, n)
        Symmetric; the mass positive definite.
    count : int
        Modes wanted, up to n.
    shift : float
        Makes stiffness + shift mass positive definite, where the stiffness leaves motions free; best near
        the lowest squared frequency that is not zero.

    Returns
    -------
    squares, shapes : ndarray, (count,), (n, count)
        Ascending squared frequencies; shapes orthonormal in the mass.
    """
    n = mass.shape[0]
    if n <= _DENSE or count > n // 3:
        dense = (sp.csr_array(A).toarray() for A in (stiffness, mass))
        squares, shapes = sl.eigh(*dense, subset_by_index=(0, count - 1))
        return squares, shapes
    K, M = sp.csr_array(stiffness), sp.csr_array(mass)
    inverse = sla.LinearOperator((n, n), matvec=cholesky(K + shift * M).solve, dtype=np.float64)
    start = np.random.default_rng(0).normal(size=n)  # ARPACK's own start is not reproducible
    squares, shapes = sla.eigsh(K, count, M, sigma=-shift, OPinv=inverse, v0=start)
    order = np.argsort(squares)
    return squares[order], shapes[:, order]
