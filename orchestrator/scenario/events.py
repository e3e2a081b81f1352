"""What happens to a train at an instant.

A kind of event is one class: its keys in the scenario, the parameters that it sets, the words for it.
`KINDS` is the only list of them: scenario, schedule, units, record and figures ask the events themselves.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, PlainValidator, SerializeAsAny, ValidationError, model_validator
from pydantic_core import PydanticCustomError, PydanticKnownError

from fmus import port
from orchestrator.scenario.fields import Angle, Finite, Model, NotNegative, Positive
from rotor_fmu.train.train import Train

Values = dict[str, float | int | bool | str]
"""Parameters of an FMU by variable name."""


class Event(Model):
    """Something that happens at an instant.

    Attributes
    ----------
    kind : str
        What kind of event it is.
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
    def timed(self) -> bool:
        """Whether its instant is known beforehand."""
        return math.isfinite(self.time)

    @property
    def text(self) -> str:
        """What happens, and where."""
        return self.label

    @property
    def when(self) -> str:
        """When it happens, in words."""
        return f"at {self.time:g} s"

    def parameters(self, train: Train) -> Values:
        """Parameters of the rotor that it sets."""
        return {}


class Conditional(Event):
    """Something that happens at an instant, or as soon as a condition holds, once.

    Attributes
    ----------
    time : float
        Instant in s; without one a condition must be given.
    vibration : float or None
        Condition: a journal moves further than this from where it started, in its bearing, in m.
    least_gap : float or None
        Condition: the least gap of a bearing is below this, in m.
    speed : float or None
        Condition: the speed has fallen below this, in rad/s, or risen above it where it began below.
    lasting : float
        How long a condition must hold before it counts, in s; a vibration is taken to go on for a revolution.
    """

    time: Annotated[float, Field(ge=0.0)] = math.inf
    vibration: Positive | None = None
    least_gap: float | None = None
    speed: Positive | None = None
    lasting: NotNegative = 0.0

    @model_validator(mode="after")
    def _has_one_cause(self) -> Conditional:
        causes = [self.vibration, self.least_gap, self.speed]
        given = sum(cause is not None for cause in causes) + self.timed
        if given != 1:
            raise ValueError("allowed is one of time, vibration, least_gap and speed")
        return self

    @property
    def when(self) -> str:
        """When it happens, in words."""
        lasting = f" for {self.lasting:g} s" if self.lasting else ""
        if self.vibration is not None:
            return f"when a journal moves more than {1e6 * self.vibration:g} µm{lasting}"
        if self.least_gap is not None:
            return f"when a gap is below {1e6 * self.least_gap:g} µm{lasting}"
        return super().when if self.speed is None else f"at {self.speed:g} rad/s{lasting}"

    def at(self, time: float) -> Conditional:
        """The event as it happened [s]."""
        given = self.model_dump(exclude=set(CONDITIONS))
        return type(self).model_validate({**given, "time": time})


CONDITIONS = ("vibration", "least_gap", "speed", "lasting")
"""Keys of a condition."""


class BladeLoss(Conditional):
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
        """Parameters of the rotor that it sets, if it is the first, and the only one at its wheel."""
        index = self.wheel_number(train)
        return {
            "fracture.time": self.time,
            f"wheel[{index}].blade_unbalance": self.unbalance,
            f"wheel[{index}].blade_phase": self.phase,
        }

    def wheel_number(self, train: Train) -> int:
        """Number of its wheel, from 1."""
        return 1 + [wheel.name for wheel in train.wheels].index(self.wheel)


class Switch(Conditional):
    """Something that an input of the rotor switches on, one of `fmus.port.SWITCHES`."""

    input: ClassVar[str]


class Trip(Switch):
    """The machine is tripped: nothing drives the rotor any more, which slows down by itself."""

    label: ClassVar[str] = "trip"
    noun: ClassVar[str] = "trip"
    input: ClassVar[str] = port.RELEASED
    kind: Literal["trip"] = "trip"


class VacuumBreak(Switch):
    """The vacuum is broken: from now on the windage is `rotation.windage_broken`."""

    label: ClassVar[str] = "vacuum broken"
    noun: ClassVar[str] = "vacuum break"
    input: ClassVar[str] = port.VACUUM_BROKEN
    kind: Literal["vacuum-break"] = "vacuum-break"


class Change(Conditional):
    """A parameter of a bearing changes: its oil, its supply, its surfaces, or where it stands.

    Attributes
    ----------
    bearing : str
        Name of the bearing.
    parameter : str
        viscosity in Pa s, ambient_pressure, feed_pressure in Pa, friction, or offset.x, offset.y in m,
        offset.tilt_x, offset.tilt_y in rad; no other may change while a bearing runs.
    value : float or None
        What it becomes.
    by : float or None
        What is added to it, in place of a value; so a bearing sinks.
    """

    label: ClassVar[str] = "change"
    noun: ClassVar[str] = "change"
    kind: Literal["change"] = "change"
    bearing: str
    parameter: Literal[tuple(port.CHANGEABLE)]  # type: ignore[valid-type]
    value: Finite | None = None
    by: Finite | None = None

    @model_validator(mode="after")
    def _has_one_value(self) -> Change:
        if (self.value is None) == (self.by is None):
            raise ValueError("allowed is either value or by")
        variable = next(v for v in port.BEARING_PARAMETERS if v.name == self.variable)
        if self.value is not None and not variable.admits(self.value):
            raise ValueError(f"value = {self.value!r}; allowed is {variable.range}")
        return self

    @property
    def variable(self) -> str:
        """Name of the parameter on the unit."""
        return port.CHANGEABLE[self.parameter]

    @property
    def text(self) -> str:
        """What happens, and where."""
        return f"{self.parameter} changes at {self.bearing}"


KINDS: dict[str, type[Event]] = {
    "blade-loss": BladeLoss,
    "trip": Trip,
    "vacuum-break": VacuumBreak,
    "change": Change,
}
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
    try:
        return KINDS[kind].model_validate(value)
    except ValidationError as error:
        if not isinstance(value, Mapping) or any(name in value for name in ("time", *CONDITIONS[:-1])):
            raise
        others = [_again(found) for found in error.errors() if found["type"] != "value_error"]
        missing = {"type": "missing", "loc": ("time",), "input": value}
        raise ValidationError.from_exception_data("Event", [*others, missing]) from None  # type: ignore[list-item]


def _again(found: Any) -> Any:
    """A problem that pydantic has found, to be raised once more."""
    kind, context = found["type"], found.get("ctx")
    try:
        PydanticKnownError(kind, context)
    except (KeyError, TypeError):  # a custom one
        return {**found, "type": PydanticCustomError(kind, found["msg"], context)}
    return found


AnyEvent = Annotated[SerializeAsAny[Event], PlainValidator(event_of)]
"""An event of any kind."""


def loss_parameters(events: Sequence[Event], train: Train) -> Values:
    """Parameters of the rotor for the blades lost: those of the first instant, and a list of the others."""
    losses = sorted((e for e in events if isinstance(e, BladeLoss)), key=lambda loss: loss.time)
    values: Values = {}
    others = []
    for loss in losses:
        given = loss.parameters(train)
        if (
            loss.timed
            and loss.time == losses[0].time
            and values.keys().isdisjoint(given.keys() - {"fracture.time"})
        ):
            values |= given
        else:
            others.append(
                [loss.time if loss.timed else None, loss.wheel_number(train), loss.unbalance, loss.phase]
            )
    return values | ({port.LOSSES: json.dumps(others)} if others else {})


def to_json(events: Sequence[Event]) -> str:
    """Return events as text, for the attributes of a record."""
    conditions = [set(CONDITIONS) if event.timed else None for event in events]
    every = zip(events, conditions, strict=True)
    return json.dumps([e.model_dump(mode="json", exclude=without, exclude_none=True) for e, without in every])


def from_json(text: str) -> tuple[Event, ...]:
    """Return the events that `to_json` wrote."""
    return tuple(event_of(table) for table in json.loads(text))
