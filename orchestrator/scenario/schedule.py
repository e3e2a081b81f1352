"""The schedule of a run: rotor speed over time, and what happens when."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from orchestrator.scenario import events
from orchestrator.scenario.events import Event
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.train import Train

_WHOLE = 1e-6
"""Share of a revolution by which a span may miss a whole number of them and still count as one."""


@dataclass(frozen=True)
class Schedule:
    """Rotor speed over time and the events of a run.

    Attributes
    ----------
    speed : float
        Rotor speed in rad/s, the same at all times.
    events : tuple of Event
        In the order of their instants.
    """

    speed: float
    events: tuple[Event, ...] = ()

    @property
    def instants(self) -> tuple[float, ...]:
        """Instants of the events in s, ascending, each once."""
        return tuple(sorted({event.time for event in self.events}))

    def revolutions(self, start: float, end: float) -> float:
        """Revolutions of the rotor from one instant to another."""
        return (end - start) * self._frequency

    def later(self, time: float, revolutions: float) -> float:
        """The instant that comes so many revolutions behind another; before it where they are negative."""
        return time + revolutions / self._frequency

    def whole(self, start: float, end: float) -> int:
        """How many whole revolutions fit between two instants."""
        return math.floor(self.revolutions(start, end) + _WHOLE)

    def attributes(self) -> dict[str, Any]:
        """Attributes of a record from which `from_attributes` makes the schedule again."""
        return {"speed": self.speed, "events": events.to_json(self.events)}

    @property
    def _frequency(self) -> float:
        return abs(self.speed) / (2.0 * math.pi)


def schedule_of(scenario: Scenario, train: Train) -> Schedule:
    """The schedule of a scenario on its train."""
    return Schedule(train.speed, tuple(sorted(scenario.events, key=lambda event: event.time)))


def from_attributes(attributes: Mapping[str, Any]) -> Schedule:
    """The schedule of a recorded run."""
    return Schedule(float(attributes["speed"]), events.from_json(str(attributes.get("events", "[]"))))
