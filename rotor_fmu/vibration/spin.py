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

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.vibration.drive import Braking
from rotor_fmu.vibration.modal_shaft import ModalShaft
from rotor_fmu.vibration.turning import Turning
from rotor_fmu.vibration.unbalance import Unbalance

Array = NDArray[np.float64]
States = tuple[Array, Array]
"""Modal displacements and velocities (p, p') at both ends of a step, (2 m,) each."""


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
    shaft, unbalance : ModalShaft, Unbalance
        What turns.
    inertia : float
        About its axis [kg m2].
    """

    def __init__(self, shaft: ModalShaft, unbalance: Unbalance, inertia: float) -> None:
        self.inertia = inertia
        self._shaft, self._unbalance = shaft, unbalance
        self._pull = unbalance.forces(shaft, 1.0)

    def momentum(self, time: float, angle: float, state: Array) -> float:
        """Return c of what has appeared by an instant [kg m2/s]."""
        turned = self._unbalance.turned(time, complex(-math.sin(angle), math.cos(angle)))
        return float((self._pull @ turned) @ state[self._shaft.size :])

    def energy(self, time: float, turn: tuple[float, float], state: Array) -> float:
        """E at an angle [rad] and a speed [rad/s] [J]."""
        angle, speed = turn
        return 0.5 * self.inertia * speed**2 + speed * self.momentum(time, angle, state)

    def work(self, t: float, turning: Turning, states: States) -> float:
        """Work of the unbalance on the vibration in a step, by Simpson's rule on a motion cubic in time [J].

        With the moments that an acceleration leaves of the gyroscopic ones, which the drive does, too.
        """
        H, work = turning.step, 0.0
        for at, weight, p, v in simpson(states, H):
            turned = self._unbalance.turned(t + at, turning.pull_at(at))
            force = self._pull @ turned - turning.acceleration * (self._shaft.G @ p)
            work += weight * float(force @ v)
        return work

    def speed_after(
        self, t: float, turn: tuple[float, float], H: float, state: Array, now: Braking, owed: float
    ) -> float:
        """Speed of a free rotor at the end of a step [rad/s]; it does not turn back.

        Parameters
        ----------
        t, turn, H : float, tuple of float, float
            Instant at the start [s], angle [rad] and speed [rad/s] there, and length of the step [s].
        state : ndarray, (2 m,)
            The motion at the start.
        now : Braking
            What acts.
        owed : float
            See `Account`.
        """
        angle, speed = turn
        sign = math.copysign(1.0, speed)
        c = sign * self.momentum(t + 0.5 * H, angle, state)
        given = self._given(t, turn, state) * H
        push = now.torque * H
        rest = owed + abs(speed) * (0.5 * self.inertia * abs(speed) + c + 0.5 * push)
        rest -= H * (now.friction + now.windage) + given
        half = (0.5 * push - c) / self.inertia  # of I W^2 / 2 + (c - T H / 2) W = rest
        return sign * max(0.0, half + math.sqrt(max(0.0, half**2 + 2.0 * rest / self.inertia)))

    def _given(self, t: float, turn: tuple[float, float], state: Array) -> float:
        """Power of the unbalance on the vibration at the start of a step [W]."""
        angle, speed = turn
        pull = speed**2 * complex(math.cos(angle), math.sin(angle))
        return float((self._pull @ self._unbalance.turned(t, pull)) @ state[self._shaft.size :])

    def account(
        self, t: float, turning: Turning, states: States, now: Braking, owed: float | None, given: float
    ) -> Account:
        """What a step that has been taken makes of the rotation's energy.

        Parameters
        ----------
        t, turning, states, now
            As above.
        owed : float or None
            At its start; None where the drive holds the speed and so gives what is missing.
        given : float
            Work of the unbalance on the vibration in it [J].
        """
        H, ends = turning.step, (abs(turning.start), abs(turning.end))
        middle = t + 0.5 * H  # where rounding does not matter it is clear what has appeared
        angles = turning.angle, turning.angle_at(H)
        turns = zip((turning.start, turning.end), angles, states, strict=True)
        before, after = (self.energy(middle, (angle, speed), x) for speed, angle, x in turns)
        friction, windage = H * now.friction, H * now.windage
        if owed is None:
            return Account(after - before + friction + windage + given, friction, windage, 0.0)
        drive = now.torque * H * 0.5 * sum(ends)
        rest = before + owed + drive - friction - windage - given - after
        if ends[1] == 0.0:  # at standstill friction takes what there is
            friction, rest = friction + rest, 0.0
        return Account(drive, friction, windage, rest)


def simpson(states: States, H: float) -> list[tuple[float, float, Array, Array]]:
    """Instants, weights, displacements and velocities for Simpson's rule on a motion cubic in time."""
    (p0, v0), (p1, v1) = (np.split(state, 2) for state in states)
    middle = 0.5 * (p0 + p1) + 0.125 * H * (v0 - v1), 1.5 * (p1 - p0) / H - 0.25 * (v0 + v1)
    return [(0.0, H / 6.0, p0, v0), (0.5 * H, H / 1.5, *middle), (H, H / 6.0, p1, v1)]
