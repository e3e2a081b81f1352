"""The coordinates in which a rotor's vibration is stepped: what both kinds of them offer."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Compliance:
    """Displacements and velocities of the journals at the end of a step, from wrenches within it.

    Attributes
    ----------
    start, end : ndarray, (n_b, 8, 4 n_b)
        From wrenches that fall linearly to 0 at the end, and that rise linearly from 0 at the start.
    own : ndarray, (n_b, 4, 4)
        Of `end`, the displacement of each journal by its own wrench, transposed.
    """

    start: Array
    end: Array
    own: Array = field(init=False)

    def __post_init__(self) -> None:
        each = np.arange(len(self.end))
        blocks = self.end.reshape(len(each), 8, len(each), 4)[each, :4, each]
        object.__setattr__(self, "own", blocks.transpose(0, 2, 1).copy())

    def stiffness_numbers(self, K: Array) -> Array:
        """Of each journal on its bearing K, (n_b, 4, 4), the sum of k H^2 / (6 m) over its directions.

        The trace of K S: for a mass m on a spring k a force that rises to f moves it by f H^2 / (6 m).
        """
        return np.asarray(np.einsum("bij,bij->b", K, self.own))


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

    def from_modal(self, state: Array) -> Array:
        """Of (p, p')."""

    def to_modal(self, motion: Array) -> Array:
        """(p, p')."""

    def journals(self, motion: Array) -> Array:
        """Displacements and velocities (q, v) of the journals, (8 n_b,), a new array."""

    def maps(self, speed: float, step: float, harmonic: Array) -> Maps:
        """Maps over a step of `step` [s] at `speed` [rad/s].

        `harmonic`, (m, 2 h), holds modal forces, a pair (factor of cos theta, factor of sin theta) an input.
        """
