"""The shaft and what its bearings stand on, in one set of coordinates.

Shaft and foundation meet in the wrenches of the bearings alone, so that each is stepped exactly by itself,
the foundation mode by mode and of any stiffness.  To the law of the bearings both are one structure whose
journals move relative to their housings.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.linalg as sl
from numpy.typing import NDArray

from rotor_fmu.foundation.foundation import Foundation
from rotor_fmu.vibration.coordinates import Compliance, Coordinates, Maps, Reading, fingerprint
from rotor_fmu.vibration.detuning import Detuning
from rotor_fmu.vibration.modal_shaft import ModalShaft

Array = NDArray[np.float64]


def supported(shaft: ModalShaft, foundation: Foundation | None) -> ModalShaft:
    """The shaft with the modes of the foundation behind its own; its `bearing` is journals less housings."""
    if foundation is None:
        return shaft
    k = foundation.size

    def widened(rows: Array) -> Array:
        return np.hstack([rows, np.zeros((len(rows), k))])

    return replace(
        shaft,
        omega=np.concatenate([shaft.omega, foundation.omega]),
        D=sl.block_diag(shaft.D, np.diag(foundation.damping)),
        G=sl.block_diag(shaft.G, np.zeros((k, k))),
        bearing=np.hstack([shaft.bearing, -foundation.shapes]),
        wheels=widened(shaft.wheels),
        T=widened(shaft.T),
        massless=None if shaft.massless is None else np.append(shaft.massless, np.zeros(k, bool)),
    )


@dataclass(frozen=True, eq=False)
class SupportedMaps:
    """Maps over a step, see `rotor_fmu.vibration.coordinates.Maps`.

    Attributes
    ----------
    shaft : Maps
        Of the shaft, whose motion has the first `states` numbers.
    free : ndarray, (k, 2, 2)
        Displacement and velocity of each mode at the end from those at the start.
    start, end : ndarray, (2 k, 4 n_b)
        Both of all modes from the wrenches at the start and at the end.
    compliance : Compliance
        Journals in their housings.
    """

    shaft: Maps
    states: int
    free: Array
    start: Array
    end: Array
    compliance: Compliance

    def coast(self, motion: Array, wrench: Array, rotation: Array) -> Array:
        """Motion at the end if the wrenches end with the step."""
        of_modes = motion[self.states :].reshape(2, -1)
        moved = np.einsum("kij,jk->ik", self.free, of_modes).ravel() + self.start @ wrench
        return np.concatenate([self.shaft.coast(motion[: self.states], wrench, rotation), moved])

    def add_start(self, wrench: Array, motion: Array) -> None:
        """Add what the wrenches at the start do."""
        self.shaft.add_start(wrench, motion[: self.states])
        motion[self.states :] += self.start @ wrench

    def add_end(self, wrench: Array, motion: Array) -> None:
        """Add what the wrenches at the end do."""
        self.shaft.add_end(wrench, motion[: self.states])
        motion[self.states :] += self.end @ wrench


class SupportedCoordinates:
    """Those of the shaft, and behind them (z, z') of the foundation; see `vibration.coordinates.Coordinates`.

    Parameters
    ----------
    shaft : Coordinates
        Of the shaft alone.
    foundation : Foundation
        Under its bearings.
    states : int
        Numbers 2 m that tell the shaft's motion.
    """

    def __init__(self, shaft: Coordinates, foundation: Foundation, states: int) -> None:
        self._shaft, self._foundation, self._states = shaft, foundation, states
        self.speed = shaft.speed
        self.basis = fingerprint(np.frombuffer(shaft.basis, np.uint8), foundation.shapes, foundation.omega)

    def from_modal(self, state: Array) -> Array:
        """Of (p, p')."""
        p, m = state.reshape(2, -1), self._states // 2
        return np.concatenate([self._shaft.from_modal(p[:, :m].ravel()), p[:, m:].ravel()])

    def to_modal(self, motion: Array) -> Array:
        """(p, p')."""
        own = self._shaft.to_modal(motion[: self._states]).reshape(2, -1)
        return np.hstack([own, motion[self._states :].reshape(2, -1)]).ravel()

    def displacements(self, motion: Array) -> Array:
        """Modal displacements p."""
        own, foundation = self._shaft.displacements(motion[: self._states]), motion[self._states :]
        return np.concatenate([own, foundation[: len(foundation) // 2]])

    def journals(self, motion: Array) -> Array:
        """Displacements and velocities of the journals in their housings, (8 n_b,)."""
        return self._shaft.journals(motion[: self._states]) - self.housings(motion).ravel()

    def housings(self, motion: Array) -> Array:
        """Displacements and velocities of the housings, (n_b, 8)."""
        return self._foundation.housings(*motion[self._states :].reshape(2, -1))

    def detuning(self, speed: float, step: float) -> Detuning:
        """What a speed off `speed`, and its change, do to a step of the shaft."""
        return self._shaft.detuning(speed, step)

    def reading(self, forces: Array) -> Reading:
        """What a motion is along modal forces of the shaft."""
        return self._shaft.reading(forces)

    def maps(self, speed: float, step: float, harmonic: Array) -> SupportedMaps:
        """Maps over a step."""
        maps, foundation = self._shaft.maps(speed, step, harmonic), self._foundation
        exponential, scale = _mode_exponentials(foundation, step)
        load = -foundation.shapes.T
        # Displacements times frequency back to displacements.
        free = exponential[:, :2, :2].copy()
        free[:, 0, 1] /= scale
        free[:, 1, 0] *= scale
        of_start, of_end = exponential[:, :2, 2] - exponential[:, :2, 3], exponential[:, :2, 3]
        start, end = (
            np.vstack([(part[:, 0] / scale)[:, None] * load, part[:, 1][:, None] * load])
            for part in (of_start, of_end)
        )
        k = foundation.size
        parts = []
        for part, of_shaft in ((start, maps.compliance.start), (end, maps.compliance.end)):
            moved = [
                (foundation.shapes @ rows).reshape(-1, 4, part.shape[1]) for rows in (part[:k], part[k:])
            ]
            parts.append(of_shaft - np.concatenate(moved, axis=1))
        return SupportedMaps(
            maps, self._states, free, start, end, Compliance(parts[0], parts[1], maps.compliance.following)
        )


def _mode_exponentials(foundation: Foundation, step: float) -> tuple[Array, Array]:
    """Exponential of (scale z, z', w, w1 - w0) over a step, (k, 4, 4), and scale [rad/s]."""
    omega, k = foundation.omega, foundation.size
    scale = np.maximum(omega, 1.0 / step)
    A = np.zeros((k, 4, 4))
    A[:, 0, 1] = scale * step
    A[:, 1, 0] = -(omega**2) / scale * step
    A[:, 1, 1] = -foundation.damping * step
    A[:, 1, 2] = step
    A[:, 2, 3] = 1.0
    return np.array([sl.expm(matrix) for matrix in A]), scale
