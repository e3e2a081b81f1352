"""Ritz bases of one bending plane: static condensation and component modes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg as sl
import scipy.sparse as sp
from numpy.typing import NDArray

from rotor_fmu.shaft.banded import BandedCholesky, Matrix, cholesky, lowest_modes

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Basis:
    """A Ritz basis.

    Attributes
    ----------
    vectors : ndarray, (p, m)
        Full displacement of one plane = vectors @ reduced coordinates.
    history : tuple of tuple of float
        Elastic natural frequencies [rad/s] after each iteration, where the basis is iterated.
    """

    vectors: Array
    history: tuple[tuple[float, ...], ...] = ()


@dataclass(frozen=True, eq=False)
class Partition:
    """Masters and slaves, with the slave stiffness factorised once; no factor without slaves."""

    masters: Indices
    slaves: Indices
    factor: BandedCholesky | None

    def solve(self, loads: Array) -> Array:
        """K_ss^-1 applied to the slave rows of `loads`, zero at the masters: P @ loads."""
        result = np.zeros_like(loads)
        if self.factor is not None:
            result[self.slaves] = self.factor.solve(loads[self.slaves])
        return result


def guyan(mass: Matrix, stiffness: Matrix, masters: Indices) -> Basis:
    """Static condensation (Guyan 1965).

    Parameters
    ----------
    mass, stiffness : ndarray or scipy.sparse.csr_array, (p, p)
        Symmetric matrices of one plane; `mass` does not enter.
    masters : ndarray of int, (m,)
        Degrees of freedom that are kept; they are the reduced coordinates.

    Raises
    ------
    ValueError
        If masters are missing, repeated or out of range, or leave a rigid-body motion free.
    """
    del mass
    return Basis(static_modes(stiffness, partition(stiffness, masters)))


def craig_bampton(
    mass: Matrix, stiffness: Matrix, interface: Indices, *, modes: int, load: Array | None = None
) -> Basis:
    """Static modes of the interface and fixed-interface modes (Craig, Bampton 1968).

    Parameters
    ----------
    mass, stiffness : ndarray or scipy.sparse.csr_array, (p, p)
        Symmetric matrices of one plane.
    interface : ndarray of int, (i,)
        Degrees of freedom that are kept; the first reduced coordinates.
    modes : int
        Fixed-interface modes to add, those of the lowest frequencies; at most as many as there are.
    load : ndarray, (p,), optional
        The shape under this load with the interface held is added.

    Raises
    ------
    ValueError
        As `guyan`.
    """
    part = partition(stiffness, interface)
    fixed = np.zeros((stiffness.shape[0], min(modes, len(part.slaves))))
    if fixed.size:
        M, K = (sp.csr_array(A)[part.slaves][:, part.slaves] for A in (mass, stiffness))
        _, fixed[part.slaves] = lowest_modes(M, K, fixed.shape[1])
    static = static_modes(stiffness, part)
    fixed *= np.sqrt(np.mean(np.sum(static * (mass @ static), axis=0)))  # as heavy as the static
    basis = np.hstack([static, fixed])
    return Basis(basis if load is None else enriched(mass, basis, part.solve(load)[:, None]))


def enriched(mass: Matrix, vectors: Array, extra: Array, dependence: float = 1e-9) -> Array:
    """Add to a basis what other vectors bring anew, orthogonal to it in the mass matrix.

    Parameters
    ----------
    mass : ndarray or scipy.sparse.csr_array, (p, p)
        Symmetric, positive definite.
    vectors : ndarray, (p, m)
        The basis; its columns are kept as they are.
    extra : ndarray, (p, k)
        Candidates; columns of zeros bring nothing.
    dependence : float
        Part of a candidate, relative to its mass norm, below which it counts as dependent on the basis.

    Returns
    -------
    ndarray, (p, m + r)
        With r <= k.
    """
    root = cholesky(mass)
    weighted = root.root_times(vectors)
    orthonormal, _ = sl.qr(weighted, mode="economic")
    rest = root.root_times(extra)
    rest = rest[:, rest.any(axis=0)]
    rest /= np.linalg.norm(rest, axis=0)
    for _ in range(2):  # twice is enough (Parlett 1998, section 6.9)
        rest -= orthonormal @ (orthonormal.T @ rest)
    directions, size, _ = sl.svd(rest, full_matrices=False)
    room = len(weighted) - weighted.shape[1]
    added = root.root_solve(directions[:, : np.count_nonzero(size[:room] > dependence)])
    return np.hstack([vectors, added * np.sqrt(np.mean(np.sum(weighted**2, axis=0)))])


def partition(stiffness: Matrix, masters: Indices) -> Partition:
    """Split off masters and factorise the slaves' stiffness; raises ValueError as `guyan`."""
    size = stiffness.shape[0]
    masters = np.asarray(masters, dtype=np.intp)
    if len(masters) == 0 or masters.min() < 0 or masters.max() >= size or len(set(masters)) < len(masters):
        raise ValueError(
            f"masters {masters.tolist()}: allowed are distinct degrees of freedom from 0 to {size - 1}"
        )
    slaves = np.setdiff1d(np.arange(size), masters)
    if not len(slaves):
        return Partition(masters, slaves, None)
    try:
        factor = cholesky(sp.csr_array(stiffness)[slaves][:, slaves])
    except np.linalg.LinAlgError:
        raise ValueError(
            f"masters {masters.tolist()} leave a rigid-body motion free; "
            "at least two deflections, or a deflection and a slope, are needed"
        ) from None
    return Partition(masters, slaves, factor)


def static_modes(stiffness: Matrix, part: Partition) -> Array:
    """Shapes under unit displacements of one master each, the others held, (p, m)."""
    modes = -part.solve(sp.csr_array(stiffness)[:, part.masters].toarray())
    modes[part.masters] = np.eye(len(part.masters))
    return modes


def symmetric(matrix: Array) -> Array:
    """The symmetric part, against rounding."""
    return (matrix + matrix.T) / 2.0
