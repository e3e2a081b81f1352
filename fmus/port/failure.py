"""Why a unit could not start or step, as a number that travels through FMI like any other output.

A status says that a call failed, and the log tells a reader why; the code tells a master, which acts on it.
"""

from __future__ import annotations

from enum import IntEnum

from fmus.port.variable import Variable


class Failure(IntEnum):
    """What the variable `FAILURE` says of the last start or step."""

    NONE = 0
    FILM = 1
    INPUT = 2
    PARAMETER = 3
    STEP = 4
    CALL = 5


_TEXT = {
    Failure.NONE: "none",
    Failure.FILM: "the film has no solution",
    Failure.INPUT: "an input is not a finite number",
    Failure.PARAMETER: "no start with these parameters",
    Failure.STEP: "no result of the step",
    Failure.CALL: "a call or a step size that is not allowed",
}

FAILURE = Variable(
    "failure",
    "output",
    description="of the last start or step: " + ", ".join(f"{code:d} {_TEXT[code]}" for code in Failure),
    kind="Integer",
)
"""Output of every unit; it is set when a call is refused, and back at 0 after the next step that is not."""
