"""The whirl of a circular shaft at constant speed, decoupled.

In the complex plane (`rotor_fmu.vibration.whirl_plane`) the shaft is z' = A z + B w with z = (omega r, r'),
rigid-body motions times the least elastic frequency.
Its elastic modes are nearly orthogonal: they decouple, and a step of any length multiplies each by
its own exponential.  The rigid-body motions do not, since a body that drifts has a defective
eigenvalue; they stay together in a small block.  Schur form with that block first, which a
Sylvester equation uncouples from the rest (Golub and Van Loan 2013, Matrix Computations, 7.6.3).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import scipy.linalg as sl
from numpy.typing import NDArray

from rotor_fmu.vibration.coordinates import Compliance, Reading, fingerprint
from rotor_fmu.vibration.detuning import Detuning
from rotor_fmu.vibration.first_order_hold import harmonic_hold, linear_hold
from rotor_fmu.vibration.modal_shaft import ModalShaft
from rotor_fmu.vibration.state_space import rotation_rate
from rotor_fmu.vibration.whirl_loops import add_product, coast, parts
from rotor_fmu.vibration.whirl_plane import WhirlPlane, whirl_plane

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_CONDITION = 1e5
"""Condition number, in the row-sum norm, up to which modes count as decoupled; digits are lost with it."""


@dataclass(frozen=True, eq=False)
class WhirlMaps:
    """Maps over a step, see `vibration.coordinates.Maps`; s coordinates of 2 k in the coupled block.

    Attributes
    ----------
    block : ndarray, (2, s, s)
        Of the coupled motions; this and the next two as `whirl_loops.parts`.
    start : ndarray, (2, 2 n_b + 2 h, 2 k)
        Motion at the end from the wrenches at the start and the rotation.
    end : ndarray, (2, 2 n_b, 2 k)
        From the wrenches at the end.
    growth : ndarray, (4 k - 2 s,)
        Of each decoupled one, in pairs.
    compliance : Compliance
        Journals at the end from the wrenches.
    journals : ndarray, (2, 2 k, 4 n_b)
        Journals from a motion.
    of_step : tuple of ndarray
        What `whirl_loops.step` takes of it, memory included.
    no_kick : ndarray, (4 k,)
        Zeros.
    """

    block: Array
    start: Array
    end: Array
    growth: Array
    compliance: Compliance
    journals: Array
    of_step: tuple[Array, ...] = field(init=False)
    no_kick: Array = field(init=False)
    _total: Array = field(init=False)

    def __post_init__(self) -> None:
        total, seen = np.zeros((2, self.end.shape[2])), np.zeros((2, self.journals.shape[2]))
        maps, moves = (self.block, self.growth, self.start, self.end, self.journals), self.compliance
        memory = total, seen, np.zeros(total.size)
        of_step = *maps, moves.start, moves.end, moves.own, moves.mixed, *memory
        for name, value in (("of_step", of_step), ("no_kick", np.zeros(total.size)), ("_total", total)):
            object.__setattr__(self, name, value)

    def coast(self, motion: Array, wrench: Array, rotation: Array) -> Array:
        """Motion at the end if the wrenches end with the step."""
        after = np.empty_like(motion)
        coast(self.block, self.growth, self.start, wrench, rotation, motion, self._total, after)
        return after

    def add_start(self, wrench: Array, motion: Array) -> None:
        """Add what the wrenches at the start do."""
        add_product(self.start, wrench, self._total, motion)

    def add_end(self, wrench: Array, motion: Array) -> None:
        """Add what the wrenches at the end do."""
        add_product(self.end, wrench, self._total, motion)


class NotDecoupledError(ValueError):
    """The elastic modes are too near to one another in shape."""


class WhirlCoordinates:
    """Coordinates of a circular shaft at one speed, see `rotor_fmu.vibration.coordinates.Coordinates`.

    They are complex, real and imaginary part next to each other.

    Parameters
    ----------
    plane : WhirlPlane
        The shaft.
    speed : float
        [rad/s].
    following : ndarray, (4 n_b, 4 n_b), or None
        See `Compliance`.

    Raises
    ------
    NotDecoupledError
        If elastic modes do not decouple, as at critical damping.
    """

    def __init__(self, plane: WhirlPlane, speed: float, following: Array | None = None) -> None:
        k = len(plane.omega)
        self.speed = speed
        self._plane, self._following = plane, following
        elastic = plane.omega[plane.omega > 0.0]
        least = elastic.min() if elastic.size else 1.0
        # Displacements times frequency are of the size of velocities: A is then nearly normal.
        scale = np.maximum(plane.omega, least)
        A = np.zeros((2 * k, 2 * k), dtype=np.complex128)
        A[:k, k:] = np.diag(scale)
        A[k:, :k] = np.diag(-(plane.omega**2) / scale)
        A[k:, k:] = -(plane.D - 1j * speed * plane.P)
        self._block, self._rates, modes = _decoupled(A, least / 2.0)
        inverse = np.linalg.inv(modes)
        if not np.linalg.norm(modes, np.inf) * np.linalg.norm(inverse, np.inf) <= _CONDITION:
            raise NotDecoupledError(f"whirl at {speed} rad/s: the elastic modes do not decouple")
        self._to_state, self._from_state = modes, inverse
        self._to_state[:k] /= scale[:, None]
        self._from_state[:, :k] *= scale
        self.basis = fingerprint(plane.journal, self._to_state)
        rows = np.stack([plane.journal @ modes[:k], plane.journal @ modes[k:]])
        # Of each bearing x + i y, tilt_x + i tilt_y, then their rates: the port's order.
        self._journals = np.ascontiguousarray(rows.reshape(2, -1, 2, 2 * k).transpose(1, 0, 2, 3))
        self._journals = self._journals.reshape(-1, 2 * k)
        self._journal_parts, self._displacement_parts = parts(self._journals), parts(self._to_state[:k])

    def from_modal(self, state: Array) -> Array:
        """Of (p, p')."""
        of_x, of_y = state.reshape(2, 2, -1).transpose(1, 0, 2)
        return (self._from_state @ (of_x + 1j * of_y).ravel()).view(np.float64)

    def to_modal(self, motion: Array) -> Array:
        """(p, p')."""
        whirl = (self._to_state @ motion.view(np.complex128)).reshape(2, -1)
        return np.stack([whirl.real, whirl.imag], axis=1).ravel()

    def displacements(self, motion: Array) -> Array:
        """Modal displacements p."""
        count = len(self._plane.omega)
        found = np.zeros(2 * count)
        add_product(self._displacement_parts, motion, np.empty((2, count)), found)
        return np.concatenate([found[0::2], found[1::2]])

    def journals(self, motion: Array) -> Array:
        """Displacements and velocities (q, v) of the journals, (8 n_b,)."""
        found, count = np.zeros(2 * len(self._journals)), len(self._journals)
        add_product(self._journal_parts, motion, np.empty((2, count)), found)
        return found

    def maps(self, speed: float, step: float, harmonic: Array) -> WhirlMaps:
        """Maps over a step; ValueError at another speed than that of the coordinates."""
        if speed != self.speed:
            raise ValueError(f"whirl coordinates of {self.speed} rad/s cannot step at {speed} rad/s")
        k, slow = len(self._plane.omega), len(self._block)
        load = self._from_state[:, k:] @ self._plane.load
        pull = self._from_state[:, k:] @ self._plane.harmonic(harmonic)
        block, start, end = self._block_maps(step, load[:slow], pull[:slow])
        falling, rising = linear_hold(self._rates, step)
        forward, backward = (harmonic_hold(self._rates, turn, step) for turn in (speed, -speed))
        # c cos + s sin = (c - i s)/2 e^{i theta} + (c + i s)/2 e^{-i theta}, for each input
        cos, sin = pull[slow:, 0::2], pull[slow:, 1::2]
        ahead, back = (cos - 1j * sin) / 2.0 * forward[:, None], (cos + 1j * sin) / 2.0 * backward[:, None]
        turned = np.stack([ahead + back, 1j * (ahead - back)], axis=2).reshape(len(pull) - slow, -1)
        start = np.vstack([start, np.hstack([falling[:, None] * load[slow:], turned])])
        end = np.vstack([end, rising[:, None] * load[slow:]])
        of_start, of_end = (_as_real(self._journals @ part[:, : end.shape[1]]) for part in (start, end))
        compliance = Compliance(of_start, of_end, self._following)
        growth = np.exp(self._rates * step).view(np.float64)
        return WhirlMaps(parts(block), parts(start), parts(end), growth, compliance, self._journal_parts)

    def detuning(self, speed: float, step: float) -> Detuning:
        """What a speed off `speed`, and its change, do to a step."""
        k, slow = len(self._plane.omega), len(self._block)
        into = self._from_state[:, k:]
        held = np.zeros((2 * slow, 2 * slow), dtype=np.complex128)
        held[:slow] = step * np.hstack([self._block, np.eye(slow)])
        of_block = sl.expm(held)[:slow, slow:] @ into[:slow]
        falling, rising = linear_hold(self._rates, step)
        of_rates = (falling + rising)[:, None] * into[slow:]
        return Detuning(self._plane.P, 1j, np.vstack([of_block, of_rates]), step, self._to_state)

    def reading(self, forces: Array) -> Reading:
        """What a motion is along modal forces of both planes."""
        pairs, k = self._plane.harmonic(forces).conj().T, len(self._plane.omega)
        return Reading(np.vstack([pairs @ self._to_state[:k], pairs @ self._to_state[k:]]))

    def _block_maps(self, step: float, load: Complex, pull: Complex) -> tuple[Complex, Complex, Complex]:
        """Block, start and end of the coupled motions by one exponential (Van Loan 1978)."""
        slow, loads = load.shape
        inputs = loads + loads + pull.shape[1]
        A = np.zeros((slow + inputs, slow + inputs), dtype=np.complex128)
        A[:slow, :slow] = self._block * step
        A[:slow, slow:] = step * np.hstack([load, np.zeros_like(load), pull])
        A[slow : slow + loads, slow + loads : slow + 2 * loads] = np.eye(loads)
        A[slow + 2 * loads :, slow + 2 * loads :] = step * rotation_rate(pull.shape[1], self.speed)
        E = sl.expm(A)[:slow]
        of_start, end = E[:, slow : slow + loads], E[:, slow + loads : slow + 2 * loads]
        return E[:, :slow], np.hstack([of_start - end, E[:, slow + 2 * loads :]]), end


def whirl_coordinates(shaft: ModalShaft, speed: float) -> WhirlCoordinates | None:
    """Coordinates of a shaft in which its whirl decouples, or None if there are none."""
    plane = whirl_plane(shaft)
    if plane is None:
        return None
    try:
        return WhirlCoordinates(plane, speed, shaft.following)
    except (NotDecoupledError, np.linalg.LinAlgError):
        return None


def _decoupled(A: Complex, slow: float) -> tuple[Complex, Complex, Complex]:
    """Block of the eigenvalues of modulus below `slow`, the other eigenvalues, and the basis of both."""
    T, Z, size = sl.schur(A, output="complex", sort=lambda value: abs(value) < slow)
    block, rest = T[:size, :size], T[size:, size:]
    rates, vectors = sl.eig(rest)
    modes = Z.copy()
    if size and len(rates):
        modes[:, size:] += Z[:, :size] @ sl.solve_sylvester(block, -rest, -T[:size, size:])
    modes[:, size:] = modes[:, size:] @ vectors
    return block, rates, modes


def _as_real(response: Complex) -> Array:
    """A complex response of pairs to pairs, (4 n_b, 2 n_b), for real and imaginary parts, (n_b, 8, 4 n_b)."""
    rows, columns = response.shape
    real = np.empty((rows, 2, columns, 2))
    real[:, 0, :, 0] = real[:, 1, :, 1] = response.real
    real[:, 1, :, 0] = response.imag
    real[:, 0, :, 1] = -response.imag
    return real.reshape(-1, 8, 2 * columns)
