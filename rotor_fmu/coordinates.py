"""The coordinates in which a rotor's vibration is stepped: what both kinds of them offer."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Maps(Protocol):
    """The exact maps over a step of one length; m modes, n_b bearings, h harmonic inputs."""

    @property
    def compliance(self) -> Array:
        """S: journal displacements and velocities at the end from the wrenches there, (n_b, 8, 4 n_b)."""

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
