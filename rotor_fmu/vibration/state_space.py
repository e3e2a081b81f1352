"""The exact maps of any shaft over one macro step; for circular ones see `vibration.whirl_coordinates`.

With x = (p, p') the shaft at constant speed is x' = A x + B w + b e^{i theta}.
Over a step of length H the wrenches w on the journals run linearly from w0 to w1
(first-order hold) and the angle theta grows by speed * H, so that

    x1 = transition x0 + wrench_start w0 + wrench_end w1 + harmonic (cos theta0, sin theta0)

holds exactly.  All four come from one matrix exponential of the system augmented
by the inputs (Van Loan 1978, IEEE Trans. Automatic Control 23, 395-404).  The
harmonic input is augmented rather than solved for as X e^{i theta}: the result is
the same, but also exists at a critical speed without damping and at rest.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from rotor_fmu.vibration.coordinates import Compliance, Reading, fingerprint
from rotor_fmu.vibration.detuning import Detuning
from rotor_fmu.vibration.modal_shaft import ModalShaft

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class StepMaps:
    """Maps over a step at one speed, see `rotor_fmu.vibration.coordinates.Maps`.

    Attributes
    ----------
    free : ndarray, (2 m, 2 m + 4 n_b + 2 h)
        End state from (x0, w0, cos and sin of each harmonic input at the start) with w1 = 0.
    wrench_end : ndarray, (2 m, 4 n_b)
        End state from the wrenches w1 at the end.
    compliance : Compliance
        Journal displacements and velocities at the end from w0 and w1.
    """

    free: Array
    wrench_end: Array
    compliance: Compliance

    def coast(self, motion: Array, wrench: Array, rotation: Array) -> Array:
        """(p, p') at the end if the wrenches end with the step."""
        return np.asarray(self.free @ np.concatenate([motion, wrench, rotation]))

    def add_start(self, wrench: Array, motion: Array) -> None:
        """Add what the wrenches at the start do."""
        motion += self.free[:, len(motion) : len(motion) + len(wrench)] @ wrench

    def add_end(self, wrench: Array, motion: Array) -> None:
        """Add what the wrenches at the end do."""
        motion += self.wrench_end @ wrench


class ModalCoordinates:
    """(p, p') themselves, for shafts of any kind; see `rotor_fmu.vibration.coordinates.Coordinates`.

    Parameters
    ----------
    shaft : ModalShaft
        The shaft.
    """

    speed = None

    def __init__(self, shaft: ModalShaft) -> None:
        self._shaft, self._output = shaft, journal_output(shaft)
        self.basis = fingerprint(shaft.T)

    def from_modal(self, state: Array) -> Array:
        """The same."""
        return state

    def to_modal(self, motion: Array) -> Array:
        """The same."""
        return motion

    def displacements(self, motion: Array) -> Array:
        """The first half."""
        return motion[: len(motion) // 2]

    def journals(self, motion: Array) -> Array:
        """Displacements and velocities (q, v) of the journals, (8 n_b,)."""
        return np.asarray(self._output @ motion)

    def maps(self, speed: float, step: float, harmonic: Array) -> StepMaps:
        """Maps over a step."""
        return step_maps(self._shaft, speed, step, harmonic)

    def detuning(self, speed: float, step: float) -> Detuning:
        """What a speed off `speed`, and its change, do to a step."""
        m = self._shaft.size
        A, scale = _scaled(self._shaft, speed, np.eye(m), np.zeros((m, m)))
        push = _unscaled(scipy.linalg.expm(A * step), scale)[:, 2 * m :]
        return Detuning(self._shaft.G, -1.0, np.ascontiguousarray(push), step)

    def reading(self, forces: Array) -> Reading:
        """What a motion is along modal forces."""
        return Reading(scipy.linalg.block_diag(forces.T, forces.T))


def state_matrix(shaft: ModalShaft, speed: float) -> Array:
    """A of x' = A x + ..., x = (p, p'), (2 m, 2 m)."""
    m = shaft.size
    A = np.zeros((2 * m, 2 * m))
    A[:m, m:] = np.eye(m)
    A[m:, :m] = np.diag(-(shaft.omega**2))
    A[m:, m:] = -(shaft.D + speed * shaft.G)
    return A


def journal_output(shaft: ModalShaft) -> Array:
    """Journals (q, v) of each bearing from x = (p, p'), rows of eight a bearing, (8 n_b, 2 m)."""
    n_b, m = shaft.bearings, shaft.size
    output = np.zeros((n_b, 8, 2 * m))
    rows = shaft.bearing.reshape(n_b, 4, m)
    output[:, :4, :m] = rows
    output[:, 4:, m:] = rows
    return output.reshape(8 * n_b, 2 * m)


def step_maps(shaft: ModalShaft, speed: float, step: float, harmonic: Array) -> StepMaps:
    """Maps over a step.

    Parameters
    ----------
    shaft : ModalShaft
        The shaft.
    speed : float
        Constant over the step [rad/s].
    step : float
        H [s].
    harmonic : ndarray, (m, 2 h)
        Modal forces, one pair (factor of cos theta, factor of sin theta) an input.

    Returns
    -------
    StepMaps
        The maps.
    """
    m, loads = shaft.size, len(shaft.bearing)
    A, scale = augmented_matrix(shaft, speed, step, harmonic)
    state = _unscaled(scipy.linalg.expm(A * step), scale)
    end = np.ascontiguousarray(state[:, 2 * m + loads : 2 * m + 2 * loads])
    free = np.hstack([state[:, : 2 * m + loads], state[:, 2 * m + 2 * loads :]])
    free[:, 2 * m : 2 * m + loads] -= end
    output = journal_output(shaft)
    start = free[:, 2 * m : 2 * m + loads]
    of_start, of_end = ((output @ part).reshape(-1, 8, loads) for part in (start, end))
    return StepMaps(free, end, Compliance(of_start, of_end, shaft.following))


def augmented_matrix(shaft: ModalShaft, speed: float, step: float, harmonic: Array) -> tuple[Array, Array]:
    """Rate matrix of z = (x, w, w1 - w0, cos and sin of each harmonic input) within a step.

    Parameters
    ----------
    shaft, speed, step, harmonic
        As for `step_maps`.

    Returns
    -------
    matrix : ndarray, (2 m + 8 n_b + 2 h, 2 m + 8 n_b + 2 h)
        For displacements times `scale`, which makes them of the size of velocities: the norm of A
        then is of order omega instead of omega^2.
    scale : ndarray, (m,)
        Frequencies [rad/s].
    """
    m, loads = shaft.size, len(shaft.bearing)
    inputs = np.hstack([shaft.bearing.T, np.zeros((m, loads)), harmonic])
    drift = np.zeros((inputs.shape[1],) * 2)
    drift[:loads, loads : 2 * loads] = np.eye(loads) / step
    drift[2 * loads :, 2 * loads :] = rotation_rate(harmonic.shape[1], speed)
    return _scaled(shaft, speed, inputs, drift)


def _scaled(shaft: ModalShaft, speed: float, inputs: Array, drift: Array) -> tuple[Array, Array]:
    """[[A, (0, inputs)], [0, drift]] for displacements times frequency, and the frequencies."""
    m = shaft.size
    elastic = shaft.omega[shaft.omega > 0.0]
    scale = np.maximum(shaft.omega, elastic.min() if elastic.size else 1.0)
    A = np.zeros((2 * m + len(drift),) * 2)
    A[: 2 * m, : 2 * m] = state_matrix(shaft, speed)
    A[:m] *= scale[:, None]
    A[:, :m] /= scale
    A[m : 2 * m, 2 * m :] = inputs
    A[2 * m :, 2 * m :] = drift
    return A, scale


def _unscaled(exponential: Array, scale: Array) -> Array:
    """Rows of the state, for displacements themselves."""
    m = len(scale)
    state = exponential[: 2 * m]
    state[:m] /= scale[:, None]
    state[:, :m] *= scale
    return state


def rotation_rate(columns: int, speed: float) -> Array:
    """Rate matrix of (cos theta, sin theta), once for each harmonic input."""
    return np.kron(np.eye(columns // 2), np.array([[0.0, -speed], [speed, 0.0]]))
