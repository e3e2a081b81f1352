"""What the bearings stand on, as decoupled modes: pedestals, or a measured or computed modal model.

With mass-normalised modes z of the foundation and the wrenches w of the bearings on the shaft,

    z'' + D z' + omega^2 z = -shapes.T w,      housings h = shapes z

(Craig and Kurdila 2006, Fundamentals of Structural Dynamics, section 10.2).  A pedestal of mass m, stiffness
k and damping c in a direction is one such mode: z = sqrt(m) h, omega^2 = k / m, D = c / m.
The displacement of the housings counts from where they stand under the loads of the start, to which bearings
are aligned; there the foundation carries the static wrenches, and z = 0.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.train.seat import FoundationMode, Pedestal
from rotor_fmu.train.train import Train

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Foundation:
    """k decoupled modes under n_b bearings.

    Attributes
    ----------
    omega, damping : ndarray, (k,)
        Undamped frequencies [rad/s] and D [1/s].
    shapes : ndarray, (4 n_b, k)
        Housings x, y, tilt_x, tilt_y, bearing by bearing, from the modal displacements.
    """

    omega: Array
    damping: Array
    shapes: Array

    @property
    def size(self) -> int:
        """Number k of modes."""
        return len(self.omega)

    def housings(self, z: Array, rate: Array) -> Array:
        """Displacements and velocities of the housings, (n_b, 8), from modal ones, (k,) each."""
        return np.asarray(np.hstack([(self.shapes @ part).reshape(-1, 4) for part in (z, rate)]))

    def wrench(self, z: Array, rate: Array) -> Array:
        """What springs and dampers under each housing take beyond the static wrench, (n_b, 4) in N, N m.

        The force on the foundation at a bearing: w on the shaft pushes the housing by -w, its inertia takes a
        part, springs and dampers the rest.  Of a pedestal exactly that; of a modal model, whose springs lie
        anywhere, the share of each bearing by least squares over the modes.
        """
        taken = self.omega**2 * z + self.damping * rate
        if self._of_pedestals is not None:
            return (self._of_pedestals @ taken).reshape(-1, 4)
        return np.asarray(np.linalg.lstsq(self.shapes.T, taken, rcond=None)[0]).reshape(-1, 4)

    @property
    def _of_pedestals(self) -> Array | None:
        """The inverse of shapes.T where each mode moves one housing in one direction, (4 n_b, k)."""
        moved = self.shapes != 0.0
        if np.any(moved.sum(axis=0) != 1) or np.any(moved.sum(axis=1) > 1):
            return None
        return np.divide(1.0, self.shapes, out=np.zeros_like(self.shapes), where=moved)


def foundation_of(train: Train) -> Foundation | None:
    """The foundation of a train; None where all of its bearings stand rigidly."""
    if train.foundation:
        return of_modes(train.foundation)
    return of_pedestals([seat.pedestal for seat in train.bearings])


def of_modes(modes: Sequence[FoundationMode]) -> Foundation:
    """A modal model."""
    omega = np.array([mode.frequency for mode in modes])
    ratio = np.array([mode.damping_ratio for mode in modes])
    return Foundation(omega, 2.0 * ratio * omega, np.array([mode.shape for mode in modes]).T.copy())


def of_pedestals(pedestals: Sequence[Pedestal | None]) -> Foundation | None:
    """Pedestals, one a bearing or None for one that stands rigidly."""
    omega, damping, places = [], [], []
    for index, pedestal in enumerate(pedestals):
        for direction in range(4):
            spring = pedestal.direction(direction) if pedestal is not None else None
            if spring is not None:
                mass, stiffness, damper = spring
                omega.append(math.sqrt(stiffness / mass))
                damping.append(damper / mass)
                places.append((4 * index + direction, 1.0 / math.sqrt(mass)))
    if not places:
        return None
    shapes = np.zeros((4 * len(pedestals), len(places)))
    for column, (row, value) in enumerate(places):
        shapes[row, column] = value
    return Foundation(np.array(omega), np.array(damping), shapes)
