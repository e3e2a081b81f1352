"""The speed of the rotor: as an input says, along a course, or free under torques.

Free, the rotation goes on by its energy, see `rotor_fmu.vibration.spin`.  The driving torque is a law over
the speed; windage grows as its square, friction comes as the power of each bearing.
"""

from __future__ import annotations

import json
import math
from collections.abc import Set
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from fmus.port import COURSE, RELEASED, TORQUE, VACUUM_BROKEN

Row = tuple[float, float]


class Braking(NamedTuple):
    """What acts on the rotation during a step.

    Attributes
    ----------
    torque : float
        Of the drive [N m], along the rotation.
    friction, windage : float
        Powers that brake [W].
    """

    torque: float = 0.0
    friction: float = 0.0
    windage: float = 0.0


NOTHING = Braking()
"""Where nothing acts, or it does not matter."""


@dataclass(frozen=True)
class Drive:
    """What turns the rotor.

    Attributes
    ----------
    course : tuple of (float, float)
        Instants [s], ascending, and speeds there [rad/s], linear in between and constant outside; empty: the
        speed is given from outside, or free.
    inertia : float
        Of the train about its axis [kg m2].
    windage, windage_broken : float
        Torque over the square of the speed [N m s2], in vacuum and with the vacuum broken.
    torque : tuple of (float, float)
        Speeds [rad/s], ascending, and torques of the drive there [N m], linear in between and constant
        outside; empty: the drive holds the speed, whatever that takes, until it is released.
    """

    course: tuple[Row, ...] = ()
    inertia: float = 0.0
    windage: float = 0.0
    windage_broken: float = 0.0
    torque: tuple[Row, ...] = ()

    def on_course(self, time: float) -> float:
        """Speed of the course [rad/s]."""
        return _on(self.course, time)

    def braking(self, speed: float, friction: float, on: Set[str] = frozenset()) -> Braking:
        """What acts on the rotation at a speed [rad/s] under a power of friction [W].

        Parameters
        ----------
        on : set of str
            Which of `fmus.port.SWITCHES` are on.
        """
        windage = (self.windage_broken if VACUUM_BROKEN in on else self.windage) * abs(speed) ** 3
        driven = bool(self.torque) and RELEASED not in on
        return Braking(_on(self.torque, abs(speed)) if driven else 0.0, friction, windage)

    def is_free(self, on: Set[str]) -> bool:
        """Whether torques decide the speed, with these switches on.

        Raises
        ------
        ValueError
            If they do, but there is no inertia.
        """
        free = RELEASED in on or bool(self.torque)
        if free and not self.inertia > 0.0:
            raise ValueError(f"drive.inertia = {self.inertia} kg m2; allowed for a free rotor is > 0")
        return free


def _on(rows: tuple[Row, ...], at: float) -> float:
    places, values = zip(*rows, strict=True)
    return float(np.interp(at, places, values))


def course_of(text: str) -> tuple[Row, ...]:
    """The course in a text, ``[[0, 157], [10, 0]]``.

    Raises
    ------
    ValueError
        Saying what is allowed.
    """
    return _rows_of(text, COURSE, "rows of an instant in s, ascending, and a speed in rad/s")


def torque_of(text: str) -> tuple[Row, ...]:
    """The law of a drive in a text, ``[[0, 9e3], [157, 7e3]]``, likewise."""
    return _rows_of(text, TORQUE, "rows of a speed in rad/s, ascending, and a torque in N m")


def _rows_of(text: str, name: str, allowed: str) -> tuple[Row, ...]:
    if not text:
        return ()
    try:
        rows = tuple((float(at), float(value)) for at, value in json.loads(text))
    except (TypeError, ValueError):
        rows = ()
    finite = all(math.isfinite(x) for row in rows for x in row)
    if not rows or not finite or any(b[0] <= a[0] for a, b in pairwise(rows)):
        raise ValueError(f"{name} = {text!r}; allowed are {allowed}")
    return rows
