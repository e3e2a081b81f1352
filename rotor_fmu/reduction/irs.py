"""The improved reduction system (IRS), iterated, of one bending plane."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import scipy.linalg as sl

from rotor_fmu.reduction.ritz import Array, Basis, Indices, enriched, partition, static_modes, symmetric


class ReductionError(RuntimeError):
    """A reduction that did not converge."""


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
    part = partition(stiffness, masters)
    static = static_modes(stiffness, part)
    vectors = static
    history: tuple[tuple[float, ...], ...] = ()
    while True:
        reduced_mass, reduced_stiffness = (symmetric(vectors.T @ A @ vectors) for A in (mass, stiffness))
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
    _, shapes = sl.eigh(symmetric(V.T @ stiffness @ V), symmetric(V.T @ mass @ V))
    rigid = V.shape[1] - len(converged.history[-1])
    elastic = V @ shapes[:, rigid : rigid + modes]
    part = partition(stiffness, masters)
    extra = np.column_stack([part.solve(load), elastic, part.solve(polar @ elastic[:, :gyroscopic])])
    return Basis(enriched(mass, static_modes(stiffness, part), extra), converged.history)


def _elastic_frequencies(mass: Array, stiffness: Array) -> tuple[float, ...]:
    """Natural frequencies without the rigid-body modes, [rad/s]."""
    squared = sl.eigh(stiffness, mass, eigvals_only=True)
    return tuple(float(w) for w in np.sqrt(squared[squared > 1e-10 * squared[-1]]))
