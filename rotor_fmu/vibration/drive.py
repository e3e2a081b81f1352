"""The speed of the rotor: as an input says, along a course, or free under friction and windage.

Free, the kinetic energy I W^2 / 2 of the rotation falls by the friction power of the bearings and by the
power of the windage, c W^3 (its torque grows as the square of the speed).  What the vibration gives back to
the rotation is left out.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from fmus.port import COURSE

Row = tuple[float, float]


@dataclass(frozen=True)
class Drive:
    """What turns the rotor.

    Attributes
    ----------
    course : tuple of (float, float)
        Instants [s], ascending, and speeds there [rad/s], linear in between and constant outside; empty: the
        speed is given from outside.
    inertia : float
        Of the train about its axis [kg m2].
    windage, windage_broken : float
        Torque over the square of the speed [N m s2], in vacuum and with the vacuum broken.
    """

    course: tuple[Row, ...] = ()
    inertia: float = 0.0
    windage: float = 0.0
    windage_broken: float = 0.0

    def on_course(self, time: float) -> float:
        """Speed of the course [rad/s]."""
        times, speeds = zip(*self.course, strict=True)
        return float(np.interp(time, times, speeds))

    def let_go(self, speed: float, step: float, friction: float, *, broken: bool) -> float:
        """Speed at the end of a step in which nothing drives the rotor.

        Parameters
        ----------
        speed, step : float
            At its start [rad/s], and its length [s].
        friction : float
            Power of the bearings' friction [W].
        broken : bool
            Whether the vacuum is broken.

        Raises
        ------
        ValueError
            Without an inertia.
        """
        if not self.inertia > 0.0:
            raise ValueError(f"drive.inertia = {self.inertia} kg m2; allowed for a released rotor is > 0")
        windage = (self.windage_broken if broken else self.windage) * abs(speed) ** 3
        energy = 0.5 * self.inertia * speed**2 - step * (friction + windage)
        return math.copysign(math.sqrt(max(0.0, 2.0 * energy / self.inertia)), speed)


def course_of(text: str) -> tuple[Row, ...]:
    """The course in a text, ``[[0, 157], [10, 0]]``.

    Raises
    ------
    ValueError
        Saying what is allowed.
    """
    if not text:
        return ()
    try:
        course = tuple((float(time), float(speed)) for time, speed in json.loads(text))
    except (TypeError, ValueError):
        course = ()
    finite = all(math.isfinite(x) for row in course for x in row)
    if not course or not finite or any(b[0] <= a[0] for a, b in pairwise(course)):
        allowed = "rows of an instant in s, ascending, and a speed in rad/s"
        raise ValueError(f"{COURSE} = {text!r}; allowed are {allowed}")
    return course
