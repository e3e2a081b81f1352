"""The reduced shaft in its mass-normalised free-free modes.

The coordinates p of the reduced shaft, x = modes @ p, make the mass matrix the
identity and the stiffness diag(omega^2).  Nothing is truncated: this is a change
of coordinates, in which rigid-body modes are exact and stiff and soft directions
no longer mix in the exponential of the step.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from rotor_fmu.reduction.reduce import ReducedShaft

Array = NDArray[np.float64]

TRACE_DAMPING = 0.7
"""Damping ratio of modes in which nothing moves but what has no mass: they follow, and do not ring."""


@dataclass(frozen=True, eq=False)
class ModalShaft:
    """A shaft in m mass-normalised modal coordinates p.

    ``p'' + (D + speed G) p' + diag(omega^2) p = bearing.T w + wheels.T f``

    Attributes
    ----------
    omega : ndarray, (m,)
        Undamped circular frequencies at rest, 0 for rigid-body modes [rad/s].
    D, G : ndarray, (m, m)
        Damping and gyroscopic matrix [1/s], [1].
    bearing : ndarray, (4 n_b, m)
        Journal displacements from p, four a bearing; its transpose brings wrenches in.
    wheels : ndarray, (2 n_w, m)
        Wheel displacements (x, y) from p.
    T : ndarray, (n, m)
        Displacements of the unreduced shaft from p.
    massless : ndarray of bool, (m,), or None
        Modes in which nothing moves but what has no mass, if there are any.
    """

    omega: Array
    D: Array
    G: Array
    bearing: Array
    wheels: Array
    T: Array
    massless: NDArray[np.bool_] | None = None

    @property
    def size(self) -> int:
        """Number m of coordinates."""
        return len(self.omega)

    @property
    def bearings(self) -> int:
        """Number n_b of bearings."""
        return len(self.bearing) // 4

    @property
    def following(self) -> Array | None:
        """Displacements of the journals that follow wrenches at once, (4 n_b, 4 n_b): of massless modes."""
        if self.massless is None:
            return None
        moved = self.bearing[:, self.massless]
        return np.asarray(moved / self.omega[self.massless] ** 2 @ moved.T)

    def dynamic_stiffness(self, speed: float) -> NDArray[np.complex128]:
        """Z with Z X = f for p = Re(X exp(i speed t)), (m, m)."""
        Z = (1j * speed * (self.D + speed * self.G)).astype(np.complex128)
        Z[np.diag_indices(self.size)] += self.omega**2 - speed**2
        return Z


def to_modal(reduced: ReducedShaft) -> ModalShaft:
    """Transform a reduced shaft to its mass-normalised modes.

    Where the reduced coordinates belong to one bending plane each, so do the
    modes: first those of the x-z plane, then those of the y-z plane.

    Parameters
    ----------
    reduced : ReducedShaft
        M positive definite, K positive semidefinite, both symmetric.

    Returns
    -------
    ModalShaft
        The same shaft; displacements of size n as in ``reduced.T``.

    Raises
    ------
    ValueError
        If the mass matrix is not positive definite or the stiffness has a negative eigenvalue.
    """
    M, K = reduced.M, reduced.K
    groups = _planes(reduced.T, M, K)
    modes = np.zeros_like(M)
    squares = np.zeros(len(M))
    at = 0
    for group in groups:
        here = np.ix_(group, group)
        try:
            values, vectors = scipy.linalg.eigh((K[here] + K[here].T) / 2, (M[here] + M[here].T) / 2)
        except np.linalg.LinAlgError as error:
            raise ValueError(f"reduced shaft: mass matrix M is not positive definite ({error})") from error
        columns = slice(at, at + len(group))
        modes[group, columns] = _fix_signs(vectors)
        squares[columns] = values
        at += len(group)
    omega = np.sqrt(_without_noise(squares))
    T = np.ascontiguousarray(reduced.T @ modes)
    damping = modes.T @ reduced.D @ modes
    massless = None
    if reduced.trace is not None:
        massless = reduced.trace @ T**2 > 0.5  # of the kinetic energy
        damping[np.diag_indices(len(M))] += np.where(massless, 2.0 * TRACE_DAMPING * omega, 0.0)
    return ModalShaft(
        omega=omega,
        D=damping,
        G=modes.T @ reduced.G @ modes,
        bearing=np.ascontiguousarray(reduced.bearing @ modes),
        wheels=np.ascontiguousarray(reduced.wheels @ modes),
        T=T,
        massless=massless,
    )


def _planes(T: Array, M: Array, K: Array) -> list[NDArray[np.intp]]:
    """Coordinates of each bending plane if the planes are uncoupled, else all coordinates in one group."""
    size = np.abs(T)
    in_x = np.maximum(size[0::4].max(axis=0), size[3::4].max(axis=0)) > 0.0
    in_y = np.maximum(size[1::4].max(axis=0), size[2::4].max(axis=0)) > 0.0
    across = np.ix_(in_x, in_y)
    if np.any(in_x & in_y) or np.any(M[across]) or np.any(K[across]):
        return [np.arange(T.shape[1])]
    return [group for group in (np.flatnonzero(in_x), np.flatnonzero(~in_x)) if len(group)]


def _fix_signs(vectors: Array) -> Array:
    """Largest component of every mode positive, so that a saved state means the same in another process."""
    largest = vectors[np.abs(vectors).argmax(axis=0), np.arange(vectors.shape[1])]
    return vectors * np.where(largest < 0.0, -1.0, 1.0)


def _without_noise(squares: Array) -> Array:
    """Squared frequencies with rounding noise about the rigid-body modes set to zero."""
    noise = len(squares) * np.finfo(float).eps * max(squares.max(), 0.0)
    if squares.min() < -1e3 * noise:
        raise ValueError(f"reduced shaft: stiffness K is indefinite, least omega^2 is {squares.min():g}")
    return np.where(squares < noise, 0.0, squares)
