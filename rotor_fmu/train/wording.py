"""The words for what is wrong with a value: what is allowed instead, and the likely spelling of a name."""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable, Mapping
from typing import Any

_ALLOWED = {
    "greater_than": "a number greater than {gt:g}",
    "greater_than_equal": "a number of at least {ge:g}",
    "less_than": "a number less than {lt:g}",
    "less_than_equal": "a number of at most {le:g}",
    "float_parsing": "a number",
    "float_type": "a number",
    "finite_number": "a finite number",
    "bool_type": "true or false",
    "bool_parsing": "true or false",
    "int_parsing": "a whole number",
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "string_type": "a text in quotes",
    "string_pattern_mismatch": "a name that matches {pattern}",
    "list_type": "a list of tables, [[...]]",
    "dict_type": "a table, [...]",
    "model_type": "a table, [...]",
}
_OUT_OF_RANGE = ("greater_than", "greater_than_equal", "less_than", "less_than_equal")
_LONGEST = 60


def choice(given: str, allowed: Iterable[str]) -> str:
    """Say which names are allowed, with the closest of them first if it is close."""
    names = [str(name) for name in allowed]
    return f"{likely(given, names)}allowed are {', '.join(names)}"


def likely(given: str, allowed: Iterable[str]) -> str:
    """Ask for the closest of the names, ``did you mean 'x'? ``, or say nothing where none is close."""
    folded = {name.casefold(): name for name in allowed}
    given = given.casefold()
    close = difflib.get_close_matches(given, folded, n=1)
    close = close or [name for name in folded if given and name.startswith(given)]
    return f"did you mean {folded[close[0]]!r}? " if close else ""


def refusal(key: str, problem: Mapping[str, Any], description: str | None) -> str:
    """Say what is wrong with the value of a key.

    Parameters
    ----------
    key : str
        As the user knows it.
    problem : mapping
        One of pydantic's ``ValidationError.errors()``.
    description : str or None
        Of the field: its unit and after a semicolon the usual slip, said where a number is out of range.
    """
    kind, value, context = problem["type"], problem.get("input"), problem.get("ctx", {})
    if isinstance(value, float) and not math.isfinite(value):
        kind = "finite_number"
    text = _ALLOWED.get(kind, str(problem["msg"])).format(**context)
    if description and kind in _OUT_OF_RANGE:
        unit, semicolon, slip = description.partition(";")
        # A wrong sign is no slip of unit.
        text += f" {unit}" + (semicolon + slip if any(context.values()) else "")
    return f"{key} = {shown(value)}; allowed is {text}"


def shown(value: Any) -> str:
    """Return a value as Python writes it, cut where it is long."""
    text = repr(value)
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."
