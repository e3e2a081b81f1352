"""The coordinates in which a rotor's vibration is stepped: what both kinds of them offer."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.vibration.detuning import Detuning
from rotor_fmu.vibration.law_loops import stiffness_numbers

Array = NDArray[np.float64]


def fingerprint(*bases: NDArray[Any]) -> bytes:
    """Sixteen bytes that differ where any number of the bases does."""
    digest = hashlib.sha256()
    for basis in bases:
        digest.update(np.ascontiguousarray(basis).tobytes())
    return digest.digest()[:16]


@dataclass(frozen=True, eq=False)
class Compliance:
    """Displacements and velocities of the journals at the end of a step, from wrenches within it.

    Attributes
    ----------
    start, end : ndarray, (n_b, 8, 4 n_b)
        From wrenches that fall linearly to 0 at the end, and that rise linearly from 0 at the start.
    following : ndarray, (4 n_b, 4 n_b), or None
        Displacements that follow the wrenches at once, as of massless journals; they upset no step.
    mixed : ndarray, (4 n_b, 4 n_b)
        Of `end` the displacements alone, without those.
    own : ndarray, (n_b, 4, 4)
        Of those, of each journal by its own wrench, transposed.
    """

    start: Array
    end: Array
    following: Array | None = None
    mixed: Array = field(init=False)
    own: Array = field(init=False)

    def __post_init__(self) -> None:
        each = np.arange(len(self.end))
        for name in ("start", "end"):  # compiled loops take arrays of one layout
            object.__setattr__(self, name, np.ascontiguousarray(getattr(self, name)))
        mixed = self.end[:, :4]
        if self.following is not None:
            mixed = mixed - self.following.reshape(mixed.shape)
        own = mixed.reshape(len(each), 4, len(each), 4)[each, :, each]
        object.__setattr__(self, "mixed", np.ascontiguousarray(mixed.reshape(4 * len(each), -1)))
        object.__setattr__(self, "own", own.transpose(0, 2, 1).copy())

    def stiffness_numbers(self, law: Array) -> Array | None:
        """How far bearings with laws [K C], (n_b, 4, 8), are from the stiffness that a linear wrench bears.

        For one mass m on a spring k it is k H^2 / (6 m) = k S, since a force that rises to f moves it by
        S f = f H^2 / (6 m).  Of many: with g_ij^2 = tr(K_i S_ij K_j S_ji) the sum over j of
        g_ij sqrt(g_ii / g_jj), which by Gershgorin's theorem for blocks (Feingold and Varga 1962, Pacific
        J. Math. 12, 1241-1250) bounds the eigenvalues of K S for symmetric K; scaled so that a stiff
        bearing does not make its soft neighbours stiff.

        Returns
        -------
        ndarray, (n_b,) or None
            None where a cruder bound shows that none is above 1.
        """
        sizes = np.empty((len(law) + 1, len(law)))
        found = stiffness_numbers(law, self.own, self.mixed, np.empty_like(self.mixed), sizes)
        return sizes[-1] if found else None


@dataclass(frozen=True, eq=False)
class Reading:
    """What a motion is along given modal forces.

    Attributes
    ----------
    rows : ndarray, (2 j, s)
        Real, or complex for motions of pairs, of which the real part counts.
    """

    rows: NDArray[Any]

    def __call__(self, motion: Array) -> Array:
        """Displacements and velocities, (2, j); a foundation behind the shaft in the motion stays out."""
        kind = self.rows.dtype
        own = self.rows.shape[1] * kind.itemsize // 8
        return np.ascontiguousarray((self.rows @ motion[:own].view(kind)).real).reshape(2, -1)


class Maps(Protocol):
    """The exact maps over a step of one length; m modes, n_b bearings, h harmonic inputs."""

    @property
    def compliance(self) -> Compliance:
        """What wrenches within the step move the journals by at its end."""

    def coast(self, motion: Array, wrench: Array, rotation: Array) -> Array:
        """Motion at the end if the wrenches end with the step, a new array.

        Parameters
        ----------
        motion : ndarray, (2 m,)
            At the start.
        wrench : ndarray, (4 n_b,)
            At the start; it falls linearly to 0.
        rotation : ndarray, (2 h,)
            cos and sin of the angle at the start, for each harmonic input; 0 to leave one out.
        """

    def add_start(self, wrench: Array, motion: Array) -> None:
        """Add to the motion at the end what wrenches, (4 n_b,), do that fall from it linearly to 0."""

    def add_end(self, wrench: Array, motion: Array) -> None:
        """Add to the motion at the end what wrenches, (4 n_b,), do that rise to it linearly from 0."""


class Coordinates(Protocol):
    """2 m numbers that tell the vibration of a shaft about its static equilibrium."""

    @property
    def speed(self) -> float | None:
        """The speed [rad/s] to which they belong; None for modal displacements and velocities (p, p')."""

    @property
    def basis(self) -> bytes:
        """Fingerprint of what the numbers count; eigenvectors differ from processor to processor."""

    def from_modal(self, state: Array) -> Array:
        """Of (p, p')."""

    def to_modal(self, motion: Array) -> Array:
        """(p, p')."""

    def displacements(self, motion: Array) -> Array:
        """Modal displacements p alone, (m,), for less than `to_modal` takes."""

    def journals(self, motion: Array) -> Array:
        """Displacements and velocities (q, v) of the journals, (8 n_b,), a new array."""

    def maps(self, speed: float, step: float, harmonic: Array) -> Maps:
        """Maps over a step of `step` [s] at `speed` [rad/s].

        `harmonic`, (m, 2 h), holds modal forces, a pair (factor of cos theta, factor of sin theta) an input.
        """

    def detuning(self, speed: float, step: float) -> Detuning:
        """What a speed off `speed`, and its change, do to a step."""

    def reading(self, forces: Array) -> Reading:
        """What a motion is along modal forces of the shaft, (m, j)."""
