"""Whirl modes of a rotating shaft, free or on linearised bearings, and the Campbell diagram.

``M q'' + (D + Ω G + B' C B) q' + (K + B' K_b B) q = 0`` with the bearings' 4x4
stiffness and damping, solved for the eigenvalues of least modulus.  Where the bearings stand on pedestals
or on a modal foundation, its modes follow the shaft's coordinates in q, and B q is journals less housings.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Protocol

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike, NDArray

from rotor_fmu.linear.eigenmodes import eigenmodes
from rotor_fmu.reduction.reduce import ReducedShaft
from rotor_fmu.shaft.matrices import ShaftModel

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


class Bearings(Protocol):
    """Linearised bearings, n_b matrices 4x4 in the order of the wrench and of q."""

    @property
    def stiffness(self) -> Array:
        """K = -dF/dq, (n_b, 4, 4)."""

    @property
    def damping(self) -> Array:
        """C = -dF/dv, (n_b, 4, 4)."""


@dataclass(frozen=True, eq=False)
class LinearBearings:
    """Linearised bearings: stiffness and damping, (n_b, 4, 4) each."""

    stiffness: Array
    damping: Array


@dataclass(frozen=True, eq=False)
class WhirlModes:
    """Modes of one speed, ascending in frequency.

    Attributes
    ----------
    eigenvalues : ndarray, (k,)
        lambda [1/s], imaginary parts positive.
    shapes : ndarray, (n, k)
        Complex displacements of the unreduced shaft, largest deflection 1.
    bending : ndarray, (k,)
        Share of the shaft's strain in the work of all that holds the mode: 1 where the shaft alone bends,
        0 where it moves on its bearings as a rigid body.  Of x^H K x of the shaft to that and the moduli of
        x^H (K + lambda C) x of each bearing and of each of the foundation's modes; as for the strain
        energies in use, where bearings have no C.
    """

    eigenvalues: Complex
    shapes: Complex
    bending: Array = field(default_factory=lambda: np.zeros(0))

    @property
    def frequency(self) -> Array:
        """Damped circular frequency [rad/s], (k,)."""
        return self.eigenvalues.imag

    @property
    def damping_ratio(self) -> Array:
        """-Re(lambda) / |lambda|, (k,); negative if unstable."""
        return -self.eigenvalues.real / np.abs(self.eigenvalues)

    @property
    def direction(self) -> Array:
        """From -1, circular backward whirl, over 0, in a plane, to 1, circular forward whirl, (k,)."""
        x, y = self.shapes[0::4], self.shapes[1::4]
        area = np.sum((x * y.conj()).imag, axis=0)
        return 2.0 * area / np.sum(np.abs(x) ** 2 + np.abs(y) ** 2, axis=0)


def whirl_modes(
    shaft: ShaftModel | ReducedShaft,
    speed: float,
    count: int,
    *,
    bearings: Bearings | None = None,
    above: float = 0.1,
) -> WhirlModes:
    """The lowest oscillating modes.

    Parameters
    ----------
    shaft : ShaftModel or ReducedShaft
        The shaft; shapes are those of the unreduced one in any case.
    speed : float
        [rad/s].
    count : int
        Modes wanted; fewer are returned if there are not as many.
    bearings : Bearings, optional
        Linearised bearings; default: free-free.
    above : float
        Modes below this frequency [rad/s] count as rigid-body motion and are left out.

    Returns
    -------
    WhirlModes
        Of least modulus, ascending in frequency.
    """
    n = shaft.M.shape[0]
    values, vectors = eigenmodes(*system_matrices(shaft, speed, bearings), 2 * count + 16)
    kept = np.flatnonzero(values.imag > above)
    kept = kept[np.argsort(np.abs(values[kept]))][:count]
    kept = kept[np.argsort(values[kept].imag)]
    bending = _bending(shaft, values[kept], vectors[: len(vectors) // 2, kept], bearings)
    shapes = vectors[:n, kept]  # without those of a foundation
    if isinstance(shaft, ReducedShaft):
        shapes = shaft.T @ shapes
    deflection = np.abs(shapes.reshape(-1, 4, len(kept))[:, :2]).max(axis=(0, 1))
    return WhirlModes(values[kept], shapes / deflection, bending)


def _bending(
    shaft: ShaftModel | ReducedShaft, values: Complex, vectors: Complex, bearings: Bearings | None
) -> Array:
    """`WhirlModes.bending` of eigenvalues and their vectors of coordinates as in `system_matrices`."""
    of_shaft = vectors[: shaft.M.shape[0]]
    strain = np.einsum("ik,ik->k", of_shaft.conj(), sp.csr_array(shaft.K) @ of_shaft).real
    if bearings is None:
        return np.ones_like(strain)
    motion = relative_motion(shaft, vectors)
    reacting = bearings.stiffness + values[:, None, None, None] * bearings.damping
    held = np.abs(np.einsum("bik,kbij,bjk->kb", motion.conj(), reacting, motion)).sum(axis=1)
    if shaft.foundation is not None:
        ground = vectors[shaft.M.shape[0] :]
        gives = shaft.foundation.omega[:, None] ** 2 + values * shaft.foundation.damping[:, None]
        held += np.abs(ground.conj() * gives * ground).sum(axis=0)
    return np.asarray(strain / np.maximum(strain + held, np.finfo(np.float64).tiny))


def half_axes(x: Complex, y: Complex) -> tuple[Array, Array, Array]:
    """Elliptic orbits of the phasors x and y: half axes, and direction from -1, backward, to 1, forward.

    x + i y turns as f exp(i w t) + b exp(-i w t) with f = (x + i y) / 2 and b = conj(x - i y) / 2.

    Returns
    -------
    major, minor, direction : ndarray
        Of the shape of x and y.
    """
    forward, backward = np.abs(x + 1j * y) / 2.0, np.abs(x - 1j * y) / 2.0
    total = np.maximum(forward**2 + backward**2, np.finfo(np.float64).tiny)
    return forward + backward, np.abs(forward - backward), (forward**2 - backward**2) / total


def system_matrices(
    shaft: ShaftModel | ReducedShaft, speed: float, bearings: Bearings | None = None
) -> tuple[sp.csc_array, sp.csc_array, sp.csc_array]:
    """Mass, damping with gyroscopic part, and stiffness of the shaft on its bearings, sparse.

    Parameters
    ----------
    shaft, speed, bearings
        As for `whirl_modes`.
    """
    mass, damping, gyroscopic, stiffness, B = _parts(shaft, on_foundation=bearings is not None)
    damping = damping + speed * gyroscopic
    if bearings is not None:
        stiffness = stiffness + B.T @ sp.block_diag(list(bearings.stiffness)) @ B
        damping = damping + B.T @ sp.block_diag(list(bearings.damping)) @ B
    return mass, sp.csc_array(damping), sp.csc_array(stiffness)


def relative_motion(shaft: ShaftModel | ReducedShaft, x: NDArray) -> NDArray:
    """Journals in their housings, (n_b, 4, ...), from coordinates (n, ...) as in `system_matrices`."""
    n = shaft.M.shape[0]
    journals = journal_map(shaft) @ x[:n]
    if len(x) > n and shaft.foundation is not None:
        journals = journals - shaft.foundation.shapes @ x[n:]
    return np.asarray(journals).reshape(-1, 4, *x.shape[1:])


@lru_cache(maxsize=8)
def _parts(shaft: ShaftModel | ReducedShaft, *, on_foundation: bool) -> tuple[sp.csc_array, ...]:
    """Mass, damping, gyroscopic matrix, stiffness and journals, in one sparse form.

    With the foundation's modes behind the coordinates of the shaft, where its bearings stand on one.
    """
    matrices = tuple(sp.csc_array(A) for A in (shaft.M, shaft.D, shaft.G, shaft.K))
    journals, foundation = sp.csc_array(journal_map(shaft)), shaft.foundation
    if foundation is None or not on_foundation:
        return *matrices, journals
    own = np.ones(foundation.size), foundation.damping, np.zeros(foundation.size), foundation.omega**2
    both = (
        sp.block_diag([A, sp.diags_array(values)], format="csc")
        for A, values in zip(matrices, own, strict=True)
    )
    return *both, sp.hstack([journals, -sp.csc_array(foundation.shapes)], format="csc")


def journal_map(shaft: ShaftModel | ReducedShaft) -> sp.csr_array:
    """Journal displacements from the shaft's coordinates, (4 n_b, n)."""
    if isinstance(shaft, ReducedShaft):
        return sp.csr_array(shaft.bearing)
    return sp.csr_array(sp.eye_array(shaft.size, format="csr")[shaft.bearing_dofs.ravel()])


def campbell(
    shaft: ShaftModel | ReducedShaft,
    speeds: ArrayLike,
    count: int,
    *,
    bearings: Bearings | None = None,
    above: float = 0.1,
) -> list[WhirlModes]:
    """Whirl modes over speed with the same bearings at all speeds; parameters as for `whirl_modes`."""
    return [
        whirl_modes(shaft, speed, count, bearings=bearings, above=above)
        for speed in np.asarray(speeds, dtype=np.float64)
    ]
