"""How a scenario's rotor turns, where its speed changes."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from orchestrator.scenario.fields import Model, NotNegative, Positive

Course = tuple[tuple[float, float], ...]
"""Instants in s, ascending, and speeds there in rad/s; linear in between, constant outside."""


def speed_on(course: Course, time: float) -> float:
    """Speed of a course at an instant in rad/s."""
    return float(np.interp(time, [at for at, _ in course], [speed for _, speed in course]))


def _rows(value: Any) -> Any:
    """Rows of an instant and a speed."""
    try:
        rows = tuple((float(time), float(speed)) for time, speed in value)
    except (TypeError, ValueError):
        rows = ()
    sound = bool(rows) and all(math.isfinite(x) for row in rows for x in row)
    if not sound or any(b[0] <= a[0] for a, b in pairwise(rows)) or rows[0][1] <= 0.0:
        allowed = "rows [s, rad/s], instants ascending, the first speed above 0"
        raise PydanticCustomError("course", "{allowed}", {"allowed": allowed})
    return rows


def _torque(value: Any) -> Any:
    """Rows of a speed and a torque, or one torque at all speeds."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        value = [[0.0, value]]
    try:
        rows = tuple((float(speed), float(torque)) for speed, torque in value)
    except (TypeError, ValueError):
        rows = ()
    sound = bool(rows) and all(math.isfinite(x) for row in rows for x in row)
    if not sound or any(b[0] <= a[0] for a, b in pairwise(rows)) or rows[0][0] < 0.0:
        allowed = "a torque in N m, or rows [rad/s, N m], speeds ascending from 0 on"
        raise PydanticCustomError("course", "{allowed}", {"allowed": allowed})
    return rows


class Rotation(Model):
    """The speed over time; without this table it is the train's.

    Attributes
    ----------
    course : tuple
        Prescribed speed: rows [s, rad/s], linear in between and constant outside; none: the train's speed. An
        event of kind trip ends it.
    torque : tuple
        Law of the drive until a trip: rows [rad/s, N m], linear in between and constant outside, or one
        torque; the speed then follows from the torques. None: the drive holds the speed.
    inertia : float or None
        Of all that turns about its axis, in kg m2; None: that of the train's shaft, wheels and masses.
    haste : float
        How many times faster than its inertia lets it a free speed changes, to see a coast-down in minutes:
        the inertia counts divided by it. Critical speeds that pass faster answer with less, and later.
    windage, windage_broken : float
        Torque of the windage over the square of the speed, in N m s2, in vacuum and with the vacuum broken.
    """

    course: Annotated[Course, BeforeValidator(_rows)] | None = None
    torque: Annotated[Course, BeforeValidator(_torque)] | None = None
    inertia: Positive | None = None
    haste: Annotated[float, Field(ge=1.0, le=1e4)] = 1.0
    windage: NotNegative = 0.0
    windage_broken: NotNegative = Field(0.0)

    @model_validator(mode="after")
    def _breaking_the_vacuum_brakes(self) -> Rotation:
        if 0.0 < self.windage_broken < self.windage:
            raise ValueError("windage_broken is below windage; allowed is more, for the vacuum is broken")
        return self

    @model_validator(mode="after")
    def _is_driven_one_way(self) -> Rotation:
        if self.torque is not None and self.course is not None:
            raise ValueError("torque beside course; allowed is one of them: the speed is given, or follows")
        return self
