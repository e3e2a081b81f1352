"""How a unit fails: with a reason, never with an exception that crosses the C boundary."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

FILM_FAILED = "film failed"
"""Begins the reason of a bearing that refuses a step because its film has no solution there."""


class UnitError(Exception):
    """A parameter, an input or a state with which the unit cannot go on."""


def attempt(action: Callable[..., None], *arguments: Any) -> str:
    """Run `action`; return what went wrong, empty if nothing did."""
    try:
        action(*arguments)
    except (UnitError, ValueError) as error:
        return str(error) or type(error).__name__
    except Exception as error:  # any: pythonfmu would make fmi2Fatal of it
        return f"{type(error).__name__}: {error}"
    return ""
