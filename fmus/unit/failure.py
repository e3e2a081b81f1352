"""How a unit fails: with a code and a reason; the exception that crosses the C boundary is the loader's."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from fmus.port.failure import Failure


class UnitError(Exception):
    """A parameter, an input or a state with which the unit cannot go on.

    Parameters
    ----------
    reason : str
        For the log.
    code : Failure, optional
        For the variable `failure`; default is what the failed call stands for.
    """

    def __init__(self, reason: str, code: Failure | None = None) -> None:
        super().__init__(reason)
        self.code = code


class Problem(NamedTuple):
    """Why a call failed: `Failure.NONE` and an empty reason if it did not."""

    code: Failure = Failure.NONE
    reason: str = ""


NONE = Problem()
"""No problem: what each step comes to, so that it is not made each time."""


def attempt(default: Failure, action: Callable[..., None], *arguments: Any) -> Problem:
    """Run `action`; return what went wrong, with the code `default` where the error names none."""
    try:
        action(*arguments)
    except Exception as error:  # any: pythonfmu would make fmi2Fatal of it
        return problem_of(error, default)
    return NONE


def problem_of(error: Exception, default: Failure) -> Problem:
    """What went wrong, with the code `default` where the error names none."""
    if isinstance(error, UnitError | ValueError):
        code = error.code if isinstance(error, UnitError) and error.code else default
        return Problem(code, str(error) or type(error).__name__)
    return Problem(default, f"{type(error).__name__}: {error}")
