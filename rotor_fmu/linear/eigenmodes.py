"""Eigenvalues of damped, rotating systems: all of small ones, the lowest of large ones."""

from __future__ import annotations

import numpy as np
import scipy.linalg as sl
import scipy.sparse as sp
import scipy.sparse.linalg as sla
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_DENSE = 250
"""Degrees of freedom up to which all eigenvalues are computed densely."""

_SHIFT = 1.0
"""Where the sparse solver looks first, near zero but off the rigid-body modes [rad/s]."""

_FIRST = 16
"""Eigenvalues of the first look, which only says where the others lie."""

_BEYOND = 2.0
"""The second shift, over the largest modulus of the first look."""


def eigenmodes(
    mass: sp.csc_array, damping: sp.csc_array, stiffness: sp.csc_array, count: int
) -> tuple[Complex, Complex]:
    """Eigenvalues [1/s] of least modulus of M q'' + D q' + K q = 0, at least `count`, and their vectors.

    Parameters
    ----------
    mass, damping, stiffness : scipy.sparse.csc_array, (n, n)
        Real or complex; the mass positive definite.
    count : int
        Wanted; all 2 n are returned of a small system, and never more.
    """
    n = mass.shape[0]
    if n <= _DENSE:
        return _dense_modes(*(_to_dense(A) for A in (mass, damping, stiffness)))
    return _sparse_modes(mass, damping, stiffness, min(count, 2 * n - 2))


def _dense_modes(mass: Array, damping: Array, stiffness: Array) -> tuple[Complex, Complex]:
    n = len(mass)
    factor = sl.cho_factor(mass)
    companion = np.block(
        [[np.zeros((n, n)), np.eye(n)], [-sl.cho_solve(factor, stiffness), -sl.cho_solve(factor, damping)]]
    )
    values, vectors = sl.eig(companion)
    return values, vectors


def _sparse_modes(
    mass: sp.csc_array, damping: sp.csc_array, stiffness: sp.csc_array, count: int
) -> tuple[Complex, Complex]:
    """Arnoldi's method on the inverse, shifted twice.

    The second shift lies amid the eigenvalues wanted, at a distance from the defective ones of rigid bodies.
    What is factorised is the system at the shift s, s^2 M + s D + K, half as large as the companion
    matrix (Tisseur and Meerbergen 2001, section 5.1).
    """
    rough, _ = _nearest(mass, damping, stiffness, _SHIFT, min(_FIRST, count), 1e-2)
    return _nearest(mass, damping, stiffness, _BEYOND * float(np.abs(rough).max()), count, 0.0)


def _nearest(
    mass: sp.csc_array,
    damping: sp.csc_array,
    stiffness: sp.csc_array,
    shift: float,
    count: int,
    tolerance: float,
) -> tuple[Complex, Complex]:
    """Eigenvalues nearest to a shift and vectors of the companion form (x, lambda x)."""
    n = mass.shape[0]
    companion = sp.block_array([[None, sp.eye_array(n)], [-stiffness, -damping]], format="csc")
    metric = sp.block_diag([sp.eye_array(n), mass], format="csc")
    slope = sp.csc_array(damping + shift * mass)
    factor = sla.splu(sp.csc_array(stiffness + shift * slope))

    def solved(load: NDArray) -> NDArray:
        """Solve (companion - shift metric) (u, w) = load, with w = load_u + shift u."""
        u = factor.solve(-(load[n:] + slope @ load[:n]))
        return np.concatenate([u, load[:n] + shift * u])

    inverse = sla.LinearOperator((2 * n, 2 * n), solved, dtype=companion.dtype)
    start = np.random.default_rng(0).normal(size=2 * n)  # ARPACK's own start is not reproducible
    values, vectors = sla.eigs(companion, count, metric, sigma=shift, OPinv=inverse, v0=start, tol=tolerance)
    return values, vectors


def _to_dense(matrix: sp.csc_array) -> Array:
    return np.asarray(matrix.toarray())
