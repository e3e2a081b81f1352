"""What happens to a train at an instant.

A kind of event is one class: its keys in the scenario, the parameters that it sets, the words for it.
`KINDS` is the only list of them: scenario, schedule, units, record and figures ask the events themselves.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, ClassVar, Literal

from pydantic import PlainValidator, SerializeAsAny, ValidationError

from orchestrator.scenario.fields import Angle, Model, NotNegative, Positive
from rotor_fmu.train.train import Train

Values = dict[str, float | int | bool | str]
"""Parameters of an FMU by variable name."""


class Event(Model):
    """Something that happens at an instant.

    Attributes
    ----------
    kind : str
        Names the class in a scenario.
    time : float
        Instant in s; it need not fall on a macro step.
    label, noun : str
        How figures call it, and what it is called where it is known which one is meant.
    """

    label: ClassVar[str]
    noun: ClassVar[str]
    kind: str
    time: NotNegative

    @property
    def text(self) -> str:
        """What happens, and where."""
        return self.label

    def parameters(self, train: Train) -> Values:
        """Parameters of the rotor that it sets."""
        return {}


class BladeLoss(Event):
    """A blade breaks off: the unbalance of its wheel jumps.

    Attributes
    ----------
    wheel : str
        Name of the wheel.
    unbalance : float
        Mass of the lost part times its radius, in kg m.
    phase : float
        Angle of the added unbalance at t = 0, in rad.
    """

    label: ClassVar[str] = "blade fracture"
    noun: ClassVar[str] = "fracture"
    kind: Literal["blade-loss"] = "blade-loss"
    wheel: str
    unbalance: Positive
    phase: Angle = 0.0

    @property
    def text(self) -> str:
        """What happens, and where."""
        return f"{self.label} at {self.wheel}"

    def parameters(self, train: Train) -> Values:
        """Parameters of the rotor that it sets."""
        index = 1 + [wheel.name for wheel in train.wheels].index(self.wheel)
        return {
            "fracture.time": self.time,
            f"wheel[{index}].blade_unbalance": self.unbalance,
            f"wheel[{index}].blade_phase": self.phase,
        }


KINDS: dict[str, type[Event]] = {"blade-loss": BladeLoss}
"""The kinds of events by their name."""
DEFAULT = "blade-loss"
"""What a table without a kind describes."""


def event_of(value: Any) -> Event:
    """Return the event that a table describes.

    Raises
    ------
    pydantic.ValidationError
        When it describes none.
    """
    if isinstance(value, Event):
        return value
    kind = value.get("kind", DEFAULT) if isinstance(value, Mapping) else DEFAULT
    if kind not in KINDS:
        expected = {"expected": ", ".join(KINDS)}
        error = {"type": "literal_error", "loc": ("kind",), "input": kind, "ctx": expected}
        raise ValidationError.from_exception_data("Event", [error])  # type: ignore[list-item]
    return KINDS[kind].model_validate(value)


AnyEvent = Annotated[SerializeAsAny[Event], PlainValidator(event_of)]
"""An event of any kind."""


def contradictions(events: Sequence[Event]) -> Iterator[tuple[int, str, str]]:
    """Yield index, key and reason of what the rotor cannot do: it has one instant, and one blade a wheel."""
    losses = [(index, event) for index, event in enumerate(events) if isinstance(event, BladeLoss)]
    wheels: set[str] = set()
    for index, loss in losses:
        first = losses[0][1].time
        if loss.time != first:
            yield index, "time", f"allowed is {first!r} s, as of the first: blades break at one instant"
        elif loss.wheel in wheels:
            yield index, "wheel", "allowed is another wheel: one blade breaks at each"
        wheels.add(loss.wheel)


def to_json(events: Sequence[Event]) -> str:
    """Return events as text, for the attributes of a record."""
    return json.dumps([event.model_dump(mode="json") for event in events])


def from_json(text: str) -> tuple[Event, ...]:
    """Return the events that `to_json` wrote."""
    return tuple(event_of(table) for table in json.loads(text))
