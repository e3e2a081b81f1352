"""Work done on the vibrating shaft over a step, exactly."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from rotor_fmu.shaft.condensation import Equilibrium
from rotor_fmu.vibration.modal_shaft import ModalShaft
from rotor_fmu.vibration.spin import simpson
from rotor_fmu.vibration.state_space import augmented_matrix
from rotor_fmu.vibration.unbalance import Unbalance

Array = NDArray[np.float64]

_SHORT = 0.5
"""Norm of A h at which the quadrature below is exact to rounding."""

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(8)


class Work(NamedTuple):
    """Works [J].

    Attributes
    ----------
    bearings, unbalance, damping : float
        On the vibrating shaft, of the bearings and of the unbalance, and what is lost in its damping.
    drive, friction, windage : float
        On the rotation, which does the work of the unbalance: of the drive, and what is lost.
    """

    bearings: float = 0.0
    unbalance: float = 0.0
    damping: float = 0.0
    drive: float = 0.0
    friction: float = 0.0
    windage: float = 0.0


class WorkMaps(NamedTuple):
    """Over a piece of a step, from z = (x0, w0, w1 - w0, rotation): end state and works z N z.

    Attributes
    ----------
    end : ndarray, (2 m, len(z))
        State at the end.
    works : ndarray, (3, len(z), len(z))
        Symmetric N of bearings, unbalance, damping.
    """

    end: Array
    works: Array

    def work(self, z: Array) -> Array:
        """Works over the piece, (3,)."""
        return (self.works @ z) @ z


def work_maps(shaft: ModalShaft, speed: float, step: float, harmonic: Array) -> WorkMaps:
    """Works as exact quadratic forms.

    z runs through exp(A s) z, A the augmented matrix of the step, and a power is z Q z; so

        N(h) = integral of exp(A s).T Q exp(A s) over 0..h,   N(2 h) = N(h) + exp(A h).T N(h) exp(A h)

    starting from a piece so short that Gauss-Legendre quadrature is exact to rounding.

    Parameters
    ----------
    shaft, speed, step, harmonic
        As for `step_maps`.

    Returns
    -------
    WorkMaps
        The maps.
    """
    m, loads = shaft.size, len(shaft.bearing)
    A, scale = augmented_matrix(shaft, speed, step, harmonic)
    size = len(A)
    power = np.zeros((3, size, size))
    wrench, rotation = slice(2 * m, 2 * m + loads), slice(2 * m + 2 * loads, size)
    rate = slice(m, 2 * m)
    power[0, wrench, rate] = shaft.bearing
    power[1, rotation, rate] = harmonic.T
    power[2, rate, rate] = shaft.D
    power = (power + power.transpose(0, 2, 1)) / 2

    norm = float(np.abs(A * step).sum(axis=1).max())
    doublings = max(0, math.ceil(math.log2(norm / _SHORT))) if norm > 0.0 else 0
    h = step / 2**doublings
    works = np.zeros_like(power)
    for xi, weight in zip(_POINTS, _WEIGHTS, strict=True):
        E = scipy.linalg.expm(A * (h * (xi + 1.0) / 2.0))
        works += weight * h / 2.0 * (E.T @ power @ E)
    E = scipy.linalg.expm(A * h)
    for _ in range(doublings):
        works += E.T @ works @ E
        E = E @ E
    # Back from displacements times frequency.
    works[:, :m] *= scale[:, None]
    works[:, :, :m] *= scale
    end = E[: 2 * m]
    end[:m] /= scale[:, None]
    end[:, :m] *= scale
    return WorkMaps(end, works)


class WorkLedger:
    """Adds up works step by step.

    Parameters
    ----------
    shaft : ModalShaft
        The shaft.
    maps : callable
        `WorkMaps` from speed, duration and instant at its end.
    unbalance : Unbalance
        Its excitation.
    """

    def __init__(
        self,
        shaft: ModalShaft,
        maps: Callable[[float, float, float], WorkMaps],
        unbalance: Unbalance,
    ) -> None:
        self._shaft, self._maps, self._unbalance = shaft, maps, unbalance

    def over_step(
        self,
        interval: tuple[float, float],
        rotation: tuple[float, float],
        state: Array,
        wrenches: tuple[Array, Array],
        static: Equilibrium[np.float64],
    ) -> Work:
        """Works over a step that has been taken.

        Parameters
        ----------
        interval : tuple of float
            Instant at the start and length of the step [s].
        rotation : tuple of float
            Angle at the start [rad] and speed [rad/s].
        state : ndarray, (2 m,)
            At the start.
        wrenches : tuple of ndarray, (4 n_b,)
            At the start and the end of the step, counted from those of the static equilibrium.
        static : Equilibrium
            The static equilibrium.

        Returns
        -------
        Work
            Of this step alone.
        """
        (t, H), (angle, speed), (w0, w1) = interval, rotation, wrenches
        inside = sorted({at - t for _, at in self._unbalance.inside(t, t + H)})
        x, total = state, np.zeros(3)
        for a, b in itertools.pairwise((0.0, *inside, H)):
            theta = angle + speed * a
            # In the middle of a piece, where rounding does not matter, it is clear what has appeared.
            turned = self._unbalance.turned(t + 0.5 * (a + b), complex(math.cos(theta), math.sin(theta)))
            start = w0 + (w1 - w0) * (a / H)
            z = np.concatenate([x, start, (w1 - w0) * ((b - a) / H), turned])
            piece = self._maps(speed, b - a, t + b)
            total += piece.work(z)
            x = piece.end @ z
        moved = self._shaft.bearing @ (x - state)[: self._shaft.size]
        total[0] += static.wrench @ moved
        return Work(*(float(w) for w in total))

    def over_turned_step(
        self,
        H: float,
        states: tuple[Array, Array],
        wrenches: tuple[Array, Array],
        static: Equilibrium[np.float64],
        driven: float,
    ) -> Work:
        """Works over a step at changing speed, by Simpson's rule on a motion that is cubic in time.

        The exact forms would have to be made anew for each step.

        Parameters
        ----------
        H : float
            Its length [s].
        states : tuple of ndarray, (2 m,)
            At both ends.
        wrenches, static
            As for `over_step`.
        driven : float
            What the drive does on the vibration, as the work of the unbalance [J].
        """
        w0, w1 = wrenches
        points = simpson((states[0].reshape(2, -1), states[1].reshape(2, -1)), H)
        damping = sum(weight * float(v @ (self._shaft.D @ v)) for _, weight, _, v in points)
        (p0, v0), (p1, v1) = points[0][2:], points[-1][2:]
        moved, turned = self._shaft.bearing @ (p1 - p0), self._shaft.bearing @ (v1 - v0)
        bearings = (0.5 * (w0 + w1) + static.wrench) @ moved + (w1 - w0) @ turned * (H / 12.0)
        return Work(float(bearings), driven, damping)
