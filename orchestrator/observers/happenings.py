"""Brings about what an event does, when its instant comes or its condition has held long enough."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmus import port
from orchestrator.master.coupling import Advance
from orchestrator.master.observer import Observer
from orchestrator.master.rollback import forgets
from orchestrator.master.stepping import Stepper
from orchestrator.master.system import RESPONSE, System
from orchestrator.observers.between import Bores
from orchestrator.scenario.events import BladeLoss, Change, Conditional, Event, Switch

Array = NDArray[np.float64]

_OFFSETS = tuple(f"offset.{name}" for name in port.POSITION)
_SHORT = 1e-9
"""A step in s from the start of a run to itself, which no unit may be asked for."""
_INSTANT = 1e-12
"""Share by which the end of a step may miss an instant and still be it."""


class Happenings(Observer):
    """Brings about the events of a turning rotor.

    Parameters
    ----------
    system : System
        Watched after each of its steps.
    events : sequence of Event
        Of the scenario; blades lost at an instant are lost inside the rotor.
    static : ndarray (bearings, 4)
        Journals at the start, from which vibrations count.
    bores : Bores, optional
        Moved with the bearings.
    """

    def __init__(
        self, system: System, events: Sequence[Event], static: Array, bores: Bores | None = None
    ) -> None:
        self._system, self._static, self._bores = system, static, bores
        self._events = [e for e in events if isinstance(e, Conditional) and not _is_of_the_rotor(e)]
        losses = [index for index, event in enumerate(self._events) if isinstance(event, BladeLoss)]
        self._numbers = {index: k for k, index in enumerate(losses)}
        self._names = [bearing.name for bearing in system.bearings] if self._events else []
        self._happened = np.full(len(self._events), np.nan)
        self._since = np.full(len(self._events), np.nan)
        """From when on the condition of each has held."""
        self._last = np.full(len(self._events), -math.inf)
        """When it was last seen to hold."""
        self._first = math.nan
        """Speed at the start."""
        self._anew = False
        """Whether a condition has brought something about in the last step."""

    @property
    def happened(self) -> list[Event]:
        """The events that their conditions have brought about, with their instants."""
        found = zip(self._events, self._happened.tolist(), strict=True)
        return [event.at(time) for event, time in found if not math.isnan(time) and not event.timed]

    def begin(self, stepper: Stepper) -> None:
        """Take the start of the run."""
        self._first = abs(self._system.speed)
        self._look(0.0, 0.0, None)

    def watch(self, start: float, end: float, advance: Advance) -> None:
        """Look at the conditions after a step."""
        self._look(start, end, advance.evaluated)

    def record(self, step: int, time: float, stepper: Stepper) -> None:
        """Let bearings with rates of their own begin anew behind what a condition has brought about."""
        if self._anew:
            stepper.begin_anew(stepper.level)
        self._anew = False

    def _look(self, start: float, time: float, evaluated: NDArray[np.bool_] | None) -> None:
        for index, event in enumerate(self._events):
            if math.isnan(self._happened[index]) and self._due(index, event, time):
                self._happened[index] = time
                self._anew |= not event.timed
                self._bring_about(index, event, (start, time), evaluated)

    def _bring_about(
        self,
        index: int,
        event: Conditional,
        step: tuple[float, float],
        evaluated: NDArray[np.bool_] | None,
    ) -> None:
        """Bring it about at the end of a step, from its start to its end."""
        if isinstance(event, Switch):
            self._system.switch(event.input)
        elif isinstance(event, BladeLoss):
            self._system.switch(port.LOST, 2.0 ** self._numbers[index])
        elif isinstance(event, Change):
            number = self._names.index(event.bearing)
            self._change(number, event, step, stands=evaluated is None or bool(evaluated[number]))

    def _change(self, number: int, event: Change, step: tuple[float, float], *, stands: bool) -> None:
        """Change a bearing's parameter; its law is the new one from this instant on, if it has no memory.

        One with a memory, or that stands behind this instant, goes on with its old law for a step.
        """
        unit, (start, end) = self._system.bearings[number], step
        (before,) = unit.get_real([event.variable])
        after = before + event.by if event.by is not None else event.value
        unit.set_real([event.variable], np.array([after]))
        if self._bores is not None and event.variable in _OFFSETS:
            self._bores.move(number, _OFFSETS.index(event.variable), after - before)
        if stands and forgets(unit):  # it takes the step once more, to the same inputs
            unit.do_step(start, (end - start) or _SHORT)
            self._system.bearing_group.fetch([number])

    def _due(self, index: int, event: Conditional, time: float) -> bool:
        if event.timed:
            return time >= event.time * (1.0 - _INSTANT)
        if self._holds(event):
            self._last[index] = time
            if math.isnan(self._since[index]):
                self._since[index] = time
        turn = 2.0 * math.pi / max(abs(self._system.speed), 1e-3) if event.vibration is not None else 0.0
        if time - self._last[index] > turn:
            self._since[index] = math.nan
        return time - self._since[index] >= event.lasting

    def _holds(self, event: Conditional) -> bool:
        system = self._system
        if event.vibration is not None:
            off = system.motion[:, :2] - self._static[:, :2]
            return bool(np.hypot(off[:, 0], off[:, 1]).max() > event.vibration)
        if event.least_gap is not None:
            return bool(system.responses[:, RESPONSE["h_min"]].min() < event.least_gap)
        assert event.speed is not None
        now = abs(system.speed)
        return now > event.speed if self._first < event.speed else now < event.speed

    def arrays(self) -> dict[str, NDArray[Any]]:
        """All that it holds, by name."""
        first = np.array([self._first])
        return {"happened": self._happened, "since": self._since, "last": self._last, "first": first}

    def restore(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what `arrays` returned."""
        self._happened[:], self._since[:], self._last[:] = (
            arrays[name] for name in ("happened", "since", "last")
        )
        (self._first,) = arrays["first"].tolist()


def _is_of_the_rotor(event: Event) -> bool:
    """Whether the rotor itself knows when it happens."""
    return isinstance(event, BladeLoss) and event.timed
