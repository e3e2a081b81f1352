"""Ritz bases of one bending plane: static condensation, iterated IRS, component modes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy.linalg as sl
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


class ReductionError(RuntimeError):
    """A reduction that did not converge."""


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
class _Partition:
    """Masters and slaves, with the slave stiffness factorised once."""

    masters: Indices
    slaves: Indices
    factor: tuple[Array, bool]

    def solve(self, loads: Array) -> Array:
        """K_ss^-1 applied to the slave rows of `loads`, zero at the masters: P @ loads."""
        result = np.zeros_like(loads)
        if len(self.slaves):
            result[self.slaves] = sl.cho_solve(self.factor, loads[self.slaves])
        return result


def guyan(mass: Array, stiffness: Array, masters: Indices) -> Basis:
    """Static condensation (Guyan 1965).

    Parameters
    ----------
    mass, stiffness : ndarray, (p, p)
        Symmetric matrices of one plane; `mass` does not enter.
    masters : ndarray of int, (m,)
        Degrees of freedom that are kept; they are the reduced coordinates.

    Raises
    ------
    ValueError
        If masters are missing, repeated or out of range, or leave a rigid-body motion free.
    """
    del mass
    return Basis(_static_modes(stiffness, _partition(stiffness, masters)))


def improved_reduced_system(
    mass: Array,
    stiffness: Array,
    masters: Indices,
    *,
    modes: int,
    tolerance: float = 1e-7,
    max_iterations: int = 100,
) -> Basis:
    """Iterated IRS: Q_(i+1) = Q_G + P M Q_i M_i^-1 K_i (Friswell, Garvey, Penny 1995, eq. 20).

    Each iteration adds the inertia of the slaves as the last reduced model sees it.  Its fixed point
    spans as many of the lowest modes as there are masters; the highest of them converge as slowly
    as their neighbours beyond lie close, so the lowest `modes` decide.

    Parameters
    ----------
    mass, stiffness : ndarray, (p, p)
        Symmetric matrices of one plane.
    masters : ndarray of int, (m,)
        Degrees of freedom that are kept; they are the reduced coordinates.
    modes : int
        Elastic frequencies, from the lowest, that must converge.
    tolerance : float
        Largest relative change of these in the last iteration.
    max_iterations : int
        Cap.

    Returns
    -------
    Basis
        With the elastic frequencies of every iteration, Guyan's first.

    Raises
    ------
    ValueError
        As `guyan`.
    ReductionError
        If the cap is reached; the message names the change that was left.
    """
    change = np.inf
    for basis in irs_iterations(mass, stiffness, masters):
        if len(basis.history) > 1:
            before, after = (np.array(h) for h in basis.history[-2:])
            if len(before) == len(after):
                change = float(np.max(np.abs(after / before - 1.0)[:modes], initial=0.0))
            if change <= tolerance:
                return basis
            if len(basis.history) > max_iterations:
                break
    raise ReductionError(
        f"IRS with {len(masters)} masters: after {max_iterations} iterations the lowest {modes} frequencies "
        f"still change by {change:.1e} (tolerance {tolerance:.1e}); "
        "allow more iterations, a larger tolerance or more masters"
    )


def irs_iterations(mass: Array, stiffness: Array, masters: Indices) -> Iterator[Basis]:
    """The bases of iterated IRS one after the other without end, Guyan's first."""
    part = _partition(stiffness, masters)
    static = _static_modes(stiffness, part)
    vectors = static
    history: tuple[tuple[float, ...], ...] = ()
    while True:
        reduced_mass, reduced_stiffness = (_symmetric(vectors.T @ A @ vectors) for A in (mass, stiffness))
        history = (*history, _elastic_frequencies(reduced_mass, reduced_stiffness))
        yield Basis(vectors, history)
        acceleration = sl.solve(reduced_mass, reduced_stiffness, assume_a="pos")
        vectors = static + part.solve(mass @ vectors @ acceleration)


def complemented(
    mass: Array,
    stiffness: Array,
    converged: Basis,
    masters: Indices,
    *,
    load: Array,
    polar: Array,
    modes: int,
    gyroscopic: int,
) -> Basis:
    """Static modes of masters, completed by the lowest modes of a converged IRS.

    Converged IRS is a truncation to free-free modes at rest: it has lost the static flexibility under
    forces at its masters and knows nothing of rotation.  This basis has

    - all of Guyan's static modes, so that statics under forces at the masters are exact,
    - the shape under a distributed load with the masters held, so that the sag is exact,
    - the lowest elastic modes that IRS found, so that their free-free frequencies are exact,
    - the static response to the gyroscopic moments of these modes: their change with speed to first order.

    Parameters
    ----------
    mass, stiffness : ndarray, (p, p)
        Symmetric matrices of one plane.
    converged : Basis
        From `improved_reduced_system`.
    masters : ndarray of int, (m,)
        Degrees of freedom that are kept; the first reduced coordinates.
    load : ndarray, (p,)
        A static load, here gravity.
    polar : ndarray, (p, p)
        Polar inertia; the speed times it couples the planes.
    modes, gyroscopic : int
        Elastic modes to add; how many of them, from the lowest, with their gyroscopic response.

    Raises
    ------
    ValueError
        As `guyan`.
    """
    V = converged.vectors
    _, shapes = sl.eigh(_symmetric(V.T @ stiffness @ V), _symmetric(V.T @ mass @ V))
    rigid = V.shape[1] - len(converged.history[-1])
    elastic = V @ shapes[:, rigid : rigid + modes]
    part = _partition(stiffness, masters)
    extra = np.column_stack([part.solve(load), elastic, part.solve(polar @ elastic[:, :gyroscopic])])
    return Basis(enriched(mass, _static_modes(stiffness, part), extra), converged.history)


def craig_bampton(
    mass: Array, stiffness: Array, interface: Indices, *, modes: int, load: Array | None = None
) -> Basis:
    """Static modes of the interface and fixed-interface modes (Craig, Bampton 1968).

    Parameters
    ----------
    mass, stiffness : ndarray, (p, p)
        Symmetric matrices of one plane.
    interface : ndarray of int, (i,)
        Degrees of freedom that are kept; the first reduced coordinates.
    modes : int
        Fixed-interface modes to add, those of the lowest frequencies.
    load : ndarray, (p,), optional
        The shape under this load with the interface held is added.

    Raises
    ------
    ValueError
        As `guyan`.
    """
    part = _partition(stiffness, interface)
    s = np.ix_(part.slaves, part.slaves)
    fixed = np.zeros((len(stiffness), min(modes, len(part.slaves))))
    if fixed.size:
        _, fixed[part.slaves] = sl.eigh(stiffness[s], mass[s], subset_by_index=(0, fixed.shape[1] - 1))
    static = _static_modes(stiffness, part)
    fixed *= np.sqrt(np.mean(np.sum(static * (mass @ static), axis=0)))  # as heavy as the static
    basis = np.hstack([static, fixed])
    return Basis(basis if load is None else enriched(mass, basis, part.solve(load)[:, None]))


def enriched(mass: Array, vectors: Array, extra: Array, dependence: float = 1e-9) -> Array:
    """Add to a basis what other vectors bring anew, orthogonal to it in the mass matrix.

    Parameters
    ----------
    mass : ndarray, (p, p)
        Symmetric, positive definite.
    vectors : ndarray, (p, m)
        The basis; its columns are kept as they are.
    extra : ndarray, (p, k)
        Candidates.
    dependence : float
        Part of a candidate, relative to its mass norm, below which it counts as dependent on the basis.

    Returns
    -------
    ndarray, (p, m + r)
        With r <= k.
    """
    root = sl.cholesky(mass)
    orthonormal, _ = sl.qr(root @ vectors, mode="economic")
    rest = root @ extra
    rest /= np.linalg.norm(rest, axis=0)
    for _ in range(2):  # twice is enough (Parlett 1998, section 6.9)
        rest -= orthonormal @ (orthonormal.T @ rest)
    directions, size, _ = sl.svd(rest, full_matrices=False)
    added = sl.solve_triangular(root, directions[:, size > dependence])
    return np.hstack([vectors, added * np.sqrt(np.mean(np.sum((root @ vectors) ** 2, axis=0)))])


def _partition(stiffness: Array, masters: Indices) -> _Partition:
    size = len(stiffness)
    masters = np.asarray(masters, dtype=np.intp)
    if len(masters) == 0 or masters.min() < 0 or masters.max() >= size or len(set(masters)) < len(masters):
        raise ValueError(
            f"masters {masters.tolist()}: allowed are distinct degrees of freedom from 0 to {size - 1}"
        )
    slaves = np.setdiff1d(np.arange(size), masters)
    try:
        held = stiffness[np.ix_(slaves, slaves)] if len(slaves) else np.eye(1)
        factor = sl.cho_factor(held, lower=True)
    except sl.LinAlgError:
        raise ValueError(
            f"masters {masters.tolist()} leave a rigid-body motion free; "
            "at least two deflections, or a deflection and a slope, are needed"
        ) from None
    return _Partition(masters, slaves, factor)


def _static_modes(stiffness: Array, part: _Partition) -> Array:
    modes = -part.solve(stiffness[:, part.masters])
    modes[part.masters] = np.eye(len(part.masters))
    return modes


def _elastic_frequencies(mass: Array, stiffness: Array) -> tuple[float, ...]:
    """Natural frequencies without the rigid-body modes, [rad/s]."""
    squared = sl.eigh(stiffness, mass, eigvals_only=True)
    return tuple(float(w) for w in np.sqrt(squared[squared > 1e-10 * squared[-1]]))


def _symmetric(matrix: Array) -> Array:
    return (matrix + matrix.T) / 2.0
