"""Ritz bases of one bending plane: static condensation, iterated IRS, component modes."""

from __future__ import annotations

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
    tolerance: float,
    max_iterations: int,
) -> Basis:
    """Iterated IRS: Q_(i+1) = Q_G + P M Q_i M_i^-1 K_i (Friswell, Garvey, Penny 1995, eq. 20).

    Each iteration adds the inertia of the slaves as the last reduced model sees it.  Its fixed
    point spans as many of the lowest modes as there are masters.  The lower half of the elastic
    frequencies decides about convergence: the highest converge as slowly as their
    neighbours beyond the reduced size lie close.

    Parameters
    ----------
    mass, stiffness : ndarray, (p, p)
        Symmetric matrices of one plane.
    masters : ndarray of int, (m,)
        Degrees of freedom that are kept; they are the reduced coordinates.
    tolerance : float
        Largest relative change in an iteration of the lower half of the elastic frequencies.
    max_iterations : int
        Cap; 0 gives Guyan's basis.

    Returns
    -------
    Basis
        With the elastic frequencies of every iteration.

    Raises
    ------
    ValueError
        As `guyan`.
    ReductionError
        If the cap is reached; the message names the change that was left.
    """
    part = _partition(stiffness, masters)
    static = _static_modes(stiffness, part)
    vectors = static
    history = [_elastic_frequencies(mass, stiffness, vectors)]
    change = np.inf
    for _ in range(max_iterations):
        acceleration = sl.solve(vectors.T @ mass @ vectors, vectors.T @ stiffness @ vectors, assume_a="pos")
        vectors = static + part.solve(mass @ vectors @ acceleration)
        history.append(_elastic_frequencies(mass, stiffness, vectors))
        before, after = (np.array(h) for h in history[-2:])
        lower = slice(0, max(len(after) // 2, 1))
        change = float(np.max(np.abs(after - before)[lower] / after[lower], initial=0.0))
        if change <= tolerance:
            break
    else:
        if max_iterations > 0:
            raise ReductionError(
                f"IRS with {len(masters)} masters: after {max_iterations} iterations the lower half of the "
                f"frequencies still changes by {change:.1e} (tolerance {tolerance:.1e}); "
                "allow more iterations, a larger tolerance or more masters"
            )
    return Basis(vectors, tuple(history))


def craig_bampton(mass: Array, stiffness: Array, interface: Indices, *, modes: int) -> Basis:
    """Static modes of the interface and fixed-interface modes (Craig, Bampton 1968).

    Parameters
    ----------
    mass, stiffness : ndarray, (p, p)
        Symmetric matrices of one plane.
    interface : ndarray of int, (i,)
        Degrees of freedom that are kept; the first reduced coordinates.
    modes : int
        Fixed-interface modes to add, those of the lowest frequencies.

    Raises
    ------
    ValueError
        As `guyan`.
    """
    part = _partition(stiffness, interface)
    s = np.ix_(part.slaves, part.slaves)
    count = min(modes, len(part.slaves))
    fixed = np.zeros((len(stiffness), count))
    if count:
        _, fixed[part.slaves] = sl.eigh(stiffness[s], mass[s], subset_by_index=(0, count - 1))
    return Basis(np.hstack([_static_modes(stiffness, part), fixed]))


def _partition(stiffness: Array, masters: Indices) -> _Partition:
    size = len(stiffness)
    masters = np.asarray(masters, dtype=np.intp)
    if len(masters) == 0 or masters.min() < 0 or masters.max() >= size or len(set(masters)) < len(masters):
        raise ValueError(f"masters {masters.tolist()}: allowed are distinct degrees of freedom from 0 to {size - 1}")
    slaves = np.setdiff1d(np.arange(size), masters)
    try:
        factor = sl.cho_factor(stiffness[np.ix_(slaves, slaves)], lower=True) if len(slaves) else (np.eye(0), True)
    except sl.LinAlgError:
        raise ValueError(
            f"masters {masters.tolist()} leave a rigid-body motion free; at least two deflections, or a deflection "
            "and a slope, are needed"
        ) from None
    return _Partition(masters, slaves, factor)


def _static_modes(stiffness: Array, part: _Partition) -> Array:
    modes = -part.solve(stiffness[:, part.masters])
    modes[part.masters] = np.eye(len(part.masters))
    return modes


def _elastic_frequencies(mass: Array, stiffness: Array, vectors: Array) -> tuple[float, ...]:
    """Natural frequencies without the rigid-body modes, [rad/s]."""
    squared = sl.eigh(vectors.T @ stiffness @ vectors, vectors.T @ mass @ vectors, eigvals_only=True)
    return tuple(float(w) for w in np.sqrt(squared[squared > 1e-9 * squared[-1]]))
