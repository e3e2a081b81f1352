"""The improved reduced system (IRS), iterated, of one bending plane.

To Guyan's static modes T_0, the identity at the masters, IRS adds the inertia of the slaves as the last
reduced model sees it,

    T_(i+1) = T_0 + P M T_i A_i,    P = K_ss^-1 at the slaves,

where A_i gives reduced accelerations from reduced displacements.  Friswell, Garvey and Penny (1995) take
those of the last reduced model, A_i = M_i^-1 K_i; see `irs_iterations`.  That iteration has two limits:

- it creeps, errors falling like powers of 1 / i, where the slaves, with the masters held, have natural
  frequencies as low as those wanted: a disc that tilts on a slope which is no master is enough;
- the identity at the masters lets the vectors grow without bound where the masters do not tell the lowest
  modes apart, as deflections of a fine mesh do not tell its shear modes.

With A_i = (T_0' M T_i)^-1 K_0 (Xia and Lin 2004) the first iterate and the limit are the same, but T_(i+1)
spans K^-1 M T_i: this is subspace iteration (Bathe 1971) from Guyan's modes on, in which mode j converges
with (omega_j / omega_(m+1))^2 whatever the masters are.  `improved_reduced_system` does it in orthonormal
vectors instead of the identity at the masters, and with K + shift M in place of the singular K of a free
shaft.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import scipy.linalg as sl
import scipy.sparse as sp

from rotor_fmu.reduction.ritz import Array, Basis, Indices, enriched, partition, static_modes, symmetric
from rotor_fmu.shaft.banded import Matrix, cholesky


class ReductionError(RuntimeError):
    """A reduction that did not converge."""


def improved_reduced_system(
    mass: Matrix,
    root: sp.csr_array,
    masters: Indices,
    *,
    modes: int,
    tolerance: float = 1e-7,
    max_iterations: int = 100,
) -> Basis:
    """Iterated IRS from Guyan's static modes on, in orthonormal vectors; see the module.

    The iterates' span tends to as many of the lowest modes as there are masters; the highest of them converge
    as slowly as their neighbours beyond lie close, so the lowest `modes` decide.

    Parameters
    ----------
    mass : ndarray or scipy.sparse.csr_array, (p, p)
        Of one plane, symmetric.
    root : scipy.sparse.csr_array, (r, p)
        Root of the stiffness, K = root.T @ root, with rows that are independent: p - r motions are rigid.
    masters : ndarray of int, (m,)
        Degrees of freedom whose static modes are the start.
    modes : int
        Elastic frequencies, from the lowest, that must converge.
    tolerance : float
        Largest relative change of these in the last iteration.
    max_iterations : int
        Cap.

    Returns
    -------
    Basis
        The modes, ascending, rigid-body motions first, with the elastic frequencies of every iteration,
        Guyan's first.

    Raises
    ------
    ValueError
        As `guyan`.
    ReductionError
        If the cap is reached; the message names the change that was left.
    """
    M, K = sp.csr_array(mass), sp.csr_array(root.T @ root)
    rigid = root.shape[1] - root.shape[0]
    vectors = static_modes(K, partition(K, masters))
    shift = elastic_scale(M, root, vectors)
    held = cholesky(K + shift * M)
    history: list[tuple[float, ...]] = []
    change = np.inf
    for _ in range(max_iterations + 1):
        squares, vectors = _ritz(M, root, vectors, shift)
        history.append(_frequencies(squares[rigid:]))
        if len(history) > 1:
            before, after = (np.array(h[:modes]) for h in history[-2:])
            change = float(np.max(np.abs(after / before - 1.0), initial=0.0))
            if change <= tolerance:
                return Basis(vectors, tuple(history))
        vectors = held.solve(M @ vectors) * (squares + shift)
    raise ReductionError(
        f"IRS with {len(masters)} masters: after {max_iterations} iterations the lowest {modes} frequencies "
        f"still change by {change:.1e} (tolerance {tolerance:.1e}); "
        "allow more iterations, a larger tolerance or more masters"
    )


def irs_iterations(mass: Matrix, root: sp.csr_array, masters: Indices) -> Iterator[Basis]:
    """The bases of IRS iterated as published, one after the other without end, Guyan's first.

    T_(i+1) = T_0 + P M T_i M_i^-1 K_i (Friswell, Garvey, Penny 1995, eq. 20): for looking at its convergence,
    which is slow on some shafts; see the module.  Parameters as for `improved_reduced_system`.
    """
    M, K = sp.csr_array(mass), sp.csr_array(root.T @ root)
    rigid = root.shape[1] - root.shape[0]
    part = partition(K, masters)
    static = static_modes(K, part)
    vectors, shift = static, elastic_scale(M, root, static)
    history: tuple[tuple[float, ...], ...] = ()
    while True:
        squares, _ = _ritz(M, root, vectors, shift)
        history = (*history, _frequencies(squares[rigid:]))
        yield Basis(vectors, history)
        inertia, strain = M @ vectors, root @ vectors
        acceleration = sl.solve(symmetric(vectors.T @ inertia), strain.T @ strain, assume_a="pos")
        vectors = static + part.solve(inertia @ acceleration)


def elastic_scale(mass: sp.csr_array, root: sp.csr_array, vectors: Array) -> float:
    """Least squared elastic frequency [rad^2/s^2] in the span of a basis that holds the rigid motions.

    Where the basis holds nothing else, a frequency between the least and the highest of the shaft.
    """
    rigid = root.shape[1] - root.shape[0]
    scale = float(root.power(2).sum() / mass.diagonal().sum())
    for _ in range(2 if vectors.shape[1] > rigid else 0):  # the second time with a shift that leaves digits
        scale = float(_ritz(mass, root, vectors, scale)[0][rigid])
    return scale


def complemented(
    mass: Matrix,
    stiffness: Matrix,
    converged: Basis,
    masters: Indices,
    *,
    load: Array,
    polar: Matrix,
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
    mass, stiffness : ndarray or scipy.sparse.csr_array, (p, p)
        Symmetric matrices of one plane.
    converged : Basis
        From `improved_reduced_system`.
    masters : ndarray of int, (m,)
        Degrees of freedom that are kept; the first reduced coordinates.
    load : ndarray, (p,)
        A static load, here gravity.
    polar : ndarray or scipy.sparse.csr_array, (p, p)
        Polar inertia; the speed times it couples the planes.
    modes, gyroscopic : int
        Elastic modes to add; how many of them, from the lowest, with their gyroscopic response.

    Raises
    ------
    ValueError
        As `guyan`.
    """
    rigid = converged.vectors.shape[1] - len(converged.history[-1])
    elastic = converged.vectors[:, rigid : rigid + modes]
    part = partition(stiffness, masters)
    extra = np.column_stack([part.solve(load), elastic, part.solve(polar @ elastic[:, :gyroscopic])])
    return Basis(enriched(mass, static_modes(stiffness, part), extra), converged.history)


def _ritz(mass: sp.csr_array, root: sp.csr_array, vectors: Array, shift: float) -> tuple[Array, Array]:
    """Squared frequencies, ascending, and modes, orthonormal in the mass, in the span of a basis.

    Of M q = nu (K + shift M) q with nu = 1 / (square + shift): the lowest frequencies belong to the largest
    nu and keep their digits, which the highest would take from them in K q = square M q.
    """
    strain = root @ vectors
    inertia = symmetric(vectors.T @ (mass @ vectors))
    nu, combined = sl.eigh(inertia, symmetric(strain.T @ strain) + shift * inertia)
    nu, combined = nu[::-1], combined[:, ::-1]
    return 1.0 / nu - shift, vectors @ (combined / np.sqrt(nu))


def _frequencies(squares: Array) -> tuple[float, ...]:
    return tuple(float(w) for w in np.sqrt(squares))
