"""The words for what is wrong with a value: what is allowed instead, and the likely spelling of a name."""

from __future__ import annotations

import difflib
import math
import typing
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from rotor_fmu.train.toml_source import Problem

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError  # the command's help does not wait for it

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
    "string_pattern_mismatch": "a text that matches {pattern}",
    "literal_error": "one of {expected}",
    "too_short": "at least {min_length} of them",
    "too_long": "at most {max_length} of them",
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
    if description and kind == "string_pattern_mismatch":
        text = description
    if description and kind in _OUT_OF_RANGE:
        unit, semicolon, slip = description.partition(";")
        # A wrong sign is no slip of unit.
        text += f" {unit}" + (semicolon + slip if any(context.values()) else "")
    return f"{key} = {shown(value)}; allowed is {text}"


def shown(value: Any) -> str:
    """Return a value as Python writes it, cut where it is long."""
    text = repr(value)
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


def explain(error: ValidationError, raw: Mapping[str, Any], model: type[BaseModel]) -> Iterator[Problem]:
    """Location and text of each problem: where, key = value, what is allowed.

    Parameters
    ----------
    error : ValidationError
        What pydantic found.
    raw : mapping
        The data as read, to name entries by their name instead of a number.
    model : type of BaseModel
        The model that was asked for.
    """
    for problem in error.errors():
        location = problem["loc"]
        if not location:
            yield (), str(problem["msg"]).removeprefix("Value error, ")
            continue
        where, owner = _walk(location[:-1], raw, model)
        key, kind = str(location[-1]), problem["type"]
        if kind == "value_error":
            yield location, _walk(location, raw, model)[0] + str(problem["msg"]).removeprefix("Value error, ")
        elif kind == "extra_forbidden":
            yield location, f"{where}{key}: unknown key; {choice(key, owner.model_fields if owner else ())}"
        elif kind == "missing":
            yield location, f"{where}{key}: missing; it must be given"
        else:
            field = owner.model_fields.get(key) if owner else None
            yield location, where + refusal(key, problem, field.description if field else None)


def _walk(
    path: tuple[int | str, ...], raw: Any, model: type[BaseModel] | None
) -> tuple[str, type[BaseModel] | None]:
    """Readable prefix of a location and the model of the entry it leads to."""
    from pydantic import BaseModel

    words: list[str] = []
    for step in path:
        try:
            raw = raw[step]
        except (KeyError, IndexError, TypeError):
            raw = {}
        if isinstance(step, int):
            name = raw.get("name") if isinstance(raw, dict) else None
            words[-1] += f" {name!r}" if isinstance(name, str) else f" number {step + 1}"
            continue
        words.append(str(step))
        field = model.model_fields.get(step) if model else None
        if field is not None:
            inner = [field.annotation, *typing.get_args(field.annotation)]
            models = [a for a in inner if isinstance(a, type) and issubclass(a, BaseModel)]
            model = models[0] if models else None
    return "".join(f"{word}: " for word in words), model
