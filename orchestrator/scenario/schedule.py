"""The schedule of a run: rotor speed over time, and what happens when."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from orchestrator.scenario import events
from orchestrator.scenario.events import Event
from orchestrator.scenario.rotation import Course, speed_on
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.train import Train

Array = NDArray[np.float64]

_HALVINGS = 60
_ROWS = 500
"""Of the course that a record keeps of a run."""
_WHOLE = 1e-6
"""Share of a revolution by which a span may miss a whole number of them and still count as one."""


@dataclass(frozen=True)
class Schedule:
    """Rotor speed over time and the events of a run.

    Attributes
    ----------
    speed : float
        Rotor speed in rad/s: at all times, or at the start where it changes.
    events : tuple of Event
        In the order of their instants.
    course : tuple of (float, float)
        Instants and speeds where it changes, linear in between; else empty.
    """

    speed: float
    events: tuple[Event, ...] = ()
    course: Course = ()

    @property
    def instants(self) -> tuple[float, ...]:
        """Instants of the events in s, ascending, each once."""
        return tuple(sorted({event.time for event in self.events}))

    def speed_at(self, time: float) -> float:
        """Speed at an instant in rad/s."""
        return speed_on(self.course, time) if self.course else self.speed

    def revolutions(self, start: float, end: float) -> float:
        """Revolutions of the rotor from one instant to another."""
        if self.course:
            return (self._angle(end) - self._angle(start)) / (2.0 * math.pi)
        return (end - start) * self._frequency

    def later(self, time: float, revolutions: float) -> float:
        """The instant that comes so many revolutions behind another; before it where they are negative."""
        if not self.course:
            return time + revolutions / self._frequency
        wanted = self._angle(time) + 2.0 * math.pi * revolutions
        slowest = min(x for x in (abs(self.speed), *(abs(v) for _, v in self.course)) if x > 0.0)
        reach = 2.0 * math.pi * abs(revolutions) / slowest
        low, high = time - reach, time + reach
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self._angle(middle) < wanted else (low, middle)
        return high

    def _angle(self, time: float) -> float:
        """Angle that the rotor has turned since the start of the course, forward, in rad."""
        times, speeds = (np.array(column) for column in zip(*self.course, strict=True))
        speeds = np.abs(speeds)
        inside = times < time
        knots = np.append(times[inside], time)
        at = np.append(speeds[inside], np.interp(time, times, speeds))
        if not inside.any():
            return float((time - times[0]) * speeds[0])
        return float(np.trapezoid(at, knots))

    def whole(self, start: float, end: float) -> int:
        """How many whole revolutions fit between two instants."""
        return math.floor(self.revolutions(start, end) + _WHOLE)

    def attributes(self) -> dict[str, Any]:
        """Attributes of a record from which `from_attributes` makes the schedule again."""
        course = {"course": json.dumps(self.course)} if self.course else {}
        return {"speed": self.speed, "events": events.to_json(self.events), **course}

    @property
    def _frequency(self) -> float:
        return abs(self.speed) / (2.0 * math.pi)


def schedule_of(scenario: Scenario, train: Train) -> Schedule:
    """The schedule of a scenario on its train, as far as it is known beforehand."""
    known = sorted((event for event in scenario.events if event.timed), key=lambda event: event.time)
    course = scenario.rotation.course if scenario.rotation is not None else None
    return Schedule(scenario.start_speed(train.speed), tuple(known), course or ())


def from_attributes(attributes: Mapping[str, Any]) -> Schedule:
    """The schedule of a recorded run."""
    course = json.loads(str(attributes.get("course", "[]")))
    found = events.from_json(str(attributes.get("events", "[]")))
    return Schedule(float(attributes["speed"]), found, tuple((float(t), float(v)) for t, v in course))


def turned(schedule: Schedule, times: Array, speeds: Array, happened: Sequence[Event]) -> Schedule:
    """The schedule with the speeds of a run, and the events that its conditions have brought about."""
    stride = max(1, len(times) // _ROWS)
    kept = sorted({*range(0, len(times), stride), len(times) - 1})
    course = tuple((float(times[k]), float(speeds[k])) for k in kept)
    every = sorted((*schedule.events, *happened), key=lambda event: event.time)
    return Schedule(schedule.speed, tuple(every), course)
