"""The rotation of the shaft as energy: what is stored in it, and how a free rotor changes its speed.

With the inertia I, the speed W = phi' and an unbalance U that turns with it, the kinetic energy of the whole
is that of the vibration and

    E = I W^2 / 2 + W c,        c = Re(conj(z') i U exp(i phi))

c being the moment of momentum that unbalance and vibration have together.  Lagrange's equation of phi,
(I W + c)' = T + W Re(-conj(z') U exp(i phi)), times W is

    E' = T W - F z',            F = U (W^2 - i W') exp(i phi)

(derived here; Genta 2005, Dynamics of Rotating Systems, section 6, has the equations).  So a free rotor loses
what the torques take and, exactly, the work that its unbalance does on the vibration.  That work is known
when the step has been taken, the speed at its end before: so the energy is kept, and what a step's guess has
missed counts in the next one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.vibration.drive import Braking
from rotor_fmu.vibration.turning import Turning
from rotor_fmu.vibration.unbalance import Unbalance

Array = NDArray[np.float64]
Along = tuple[complex, complex]
"""Displacement and velocity along the pull of the unbalance; the real part is that at angle 0."""


@dataclass(frozen=True)
class Account:
    """What the rotation got and gave in a step [J].

    Attributes
    ----------
    drive, friction, windage : float
        Works; the last two are what they took.
    owed : float
        By which E lies above that of the speed, to be made good in the next step.
    """

    drive: float
    friction: float
    windage: float
    owed: float


class Spin:
    """The rotation of a shaft with its unbalance.

    Parameters
    ----------
    unbalance : Unbalance
        What turns.
    inertia : float
        About its axis [kg m2].
    """

    def __init__(self, unbalance: Unbalance, inertia: float) -> None:
        self.inertia, self._unbalance = inertia, unbalance

    def along(self, time: float, seen: Array) -> Along:
        """The motion along the pull of what has appeared by an instant.

        Parameters
        ----------
        time : float
            [s].
        seen : ndarray, (2, 2 + 2 l)
            Along the pull of each, see `MapCache.reading`.
        """
        p, v = (seen.view(np.complex128) @ self._unbalance.appeared(time)).tolist()
        return p, v

    def momentum(self, angle: float, along: Along) -> float:
        """Return c [kg m2/s]."""
        return _dot(complex(-math.sin(angle), math.cos(angle)), along[1])

    def energy(self, turn: tuple[float, float], along: Along) -> float:
        """E at an angle [rad] and a speed [rad/s] [J]."""
        angle, speed = turn
        return 0.5 * self.inertia * speed**2 + speed * self.momentum(angle, along)

    def work(self, t: float, turning: Turning, seen: tuple[Array, Array]) -> float:
        """Work of the unbalance on the vibration in a step, by Simpson's rule on a motion cubic in time [J].

        `seen` is the motion at both ends, as in `along`.
        """
        H = turning.step
        first, last = (self.along(t + 0.5 * H, x) for x in seen)
        points = simpson((first, last), H)
        if any(True for _ in self._unbalance.inside(t, t + H)):  # what has not appeared yet does not pull
            points = [
                simpson((self.along(t + at, seen[0]), self.along(t + at, seen[1])), H)[k]
                for k, (at, *_) in enumerate(points)
            ]
        return sum(weight * _dot(turning.pull_at(at), v) for at, weight, _, v in points)

    def speed_after(
        self, turn: tuple[float, float], H: float, along: Along, now: Braking, owed: float
    ) -> float:
        """Speed of a free rotor at the end of a step [rad/s]; it does not turn back.

        Parameters
        ----------
        turn, H : tuple of float, float
            Angle [rad] and speed [rad/s] at the start, and length of the step [s].
        along : tuple of complex
            The motion at the start.
        now : Braking
            What acts.
        owed : float
            See `Account`.
        """
        angle, speed = turn
        sign = math.copysign(1.0, speed)
        c = sign * self.momentum(angle, along)
        pull = speed**2 * complex(math.cos(angle), math.sin(angle))
        push = now.torque * H
        rest = owed + abs(speed) * (0.5 * self.inertia * abs(speed) + c + 0.5 * push)
        rest -= H * (now.friction + now.windage + _dot(pull, along[1]))
        half = (0.5 * push - c) / self.inertia  # of I W^2 / 2 + (c - T H / 2) W = rest
        return sign * max(0.0, half + math.sqrt(max(0.0, half**2 + 2.0 * rest / self.inertia)))

    def account(
        self, turning: Turning, ends: tuple[Along, Along], now: Braking, owed: float | None, given: float
    ) -> Account:
        """What a step that has been taken makes of the rotation's energy.

        Parameters
        ----------
        turning : Turning
            How the rotor turned.
        ends : tuple
            The motion at both ends, along the pull of what has appeared in the middle of the step.
        now
            As above.
        owed : float or None
            At its start; None where the drive holds the speed and so gives what is missing.
        given : float
            Work of the unbalance on the vibration in it [J].
        """
        H, speeds = turning.step, (abs(turning.start), abs(turning.end))
        before = self.energy((turning.angle, turning.start), ends[0])
        after = self.energy((turning.angle_at(H), turning.end), ends[1])
        friction, windage = H * now.friction, H * now.windage
        if owed is None:
            return Account(after - before + friction + windage + given, friction, windage, 0.0)
        drive = now.torque * H * 0.5 * sum(speeds)
        rest = before + owed + drive - friction - windage - given - after
        if speeds[1] == 0.0:  # at standstill friction takes what there is
            friction, rest = friction + rest, 0.0
        return Account(drive, friction, windage, rest)


def _dot(one: complex, other: complex) -> float:
    return one.real * other.real + one.imag * other.imag


def simpson(ends: Any, H: float) -> list[tuple[float, float, Any, Any]]:
    """Instants, weights, displacements and velocities for Simpson's rule on a motion cubic in time.

    `ends` are displacements and velocities at both, numbers or arrays.
    """
    (p0, v0), (p1, v1) = ends
    middle = 0.5 * (p0 + p1) + 0.125 * H * (v0 - v1), 1.5 / H * (p1 - p0) - 0.25 * (v0 + v1)
    return [(0.0, H / 6.0, p0, v0), (0.5 * H, H / 1.5, *middle), (H, H / 6.0, p1, v1)]
