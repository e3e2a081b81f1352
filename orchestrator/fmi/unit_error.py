"""What a call to an FMU can come back with, and which end of a run that makes."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from enum import IntEnum
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave

from fmus import port
from orchestrator.errors import OrchestratorError
from orchestrator.outcome import Outcome


class Status(IntEnum):
    """fmi2Status."""

    OK = 0
    WARNING = 1
    DISCARD = 2
    ERROR = 3
    FATAL = 4
    PENDING = 5


class UnitError(OrchestratorError):
    """A call to an FMU that did not end with OK.

    Attributes
    ----------
    unit : str
        Name of the instance.
    status : Status
        What it returned; `Status.DISCARD` leaves a step that may be tried again.
    outcome : Outcome
        How a run ends that cannot go on from here: by the status, and by what the unit's output
        `failure` says (`fmus.port.Failure`), 0 where it has none.
    """

    def __init__(self, unit: str, call: str, status: Status, reason: str, failure: int = 0) -> None:
        self.unit = unit
        self.status = status
        if status is not Status.DISCARD:
            self.outcome = Outcome.UNIT_FAILED
        elif failure == port.Failure.FILM:
            self.outcome = Outcome.FILM_FAILED
        else:
            self.outcome = Outcome.STEP_REFUSED
        super().__init__(f"{unit}: {call} returned {status.name.lower()}" + (f": {reason}" if reason else ""))


def failure_of(variables: Mapping[str, Any], slave: FMU2Slave) -> int:
    """What the output `failure` says of a call that a unit refused; 0 for a unit without such an output."""
    with suppress(KeyError, FMICallException):
        found = variables[port.FAILURE.name]
        if (found.type, found.causality) == ("Integer", "output"):
            return int(slave.getInteger([found.valueReference])[0])
    return 0
