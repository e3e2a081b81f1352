"""From a sample to the scenario and the train that it is about."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from rotor_fmu.train.wording import choice, shown

TRAIN = "train."
"""What keys of the train begin with."""

_WITH_UNIT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*)")
"""A number and its unit, as a train's file may give values."""


class KeyPathError(ValueError):
    """A key that leads to nothing; says what is allowed."""


def changed(data: Mapping[str, Any], key: str, value: Any, *, factor: bool = False) -> dict[str, Any]:
    """What a file says, with the value of a dotted key replaced or multiplied; the original stays.

    Parameters
    ----------
    data : mapping
        As TOML gives it.
    key : str
        Tables by name; in lists of tables by name or index, or ``*`` for all of them.
    value : object
        The value, or the factor.
    factor : bool
        Whether it is one.

    Raises
    ------
    KeyPathError
        Where the key leads to no table, or a factor to no number.
    """
    result: dict[str, Any] = _put(data, key.split("."), value, factor)
    return result


def _put(here: Any, path: list[str], value: Any, factor: bool) -> Any:
    if not path:
        return _times(here, value) if factor else value
    step, rest = path[0], path[1:]
    if isinstance(here, Mapping):
        # what is missing may be a key with a default, or a table: reading it says whether it is one
        below = here.get(step, {} if rest else None)
        return {**here, step: _put(below, rest, value, factor)}
    if isinstance(here, list):
        return [
            _put(item, rest, value, factor) if k in chosen(here, step) else item
            for k, item in enumerate(here)
        ]
    raise KeyPathError(f"{step}: leads through {shown(here)}; allowed are keys of tables")


def _times(here: Any, factor: Any) -> Any:
    """A number times a factor, also one that a text gives with its unit, and each of a list."""
    if isinstance(here, list) and here:
        return [_times(item, factor) for item in here]
    if isinstance(here, int | float) and not isinstance(here, bool):
        return here * factor
    found = _WITH_UNIT.fullmatch(here) if isinstance(here, str) else None
    if found is None:
        raise KeyPathError(f"is {shown(here)} there; allowed is a number, for factor is true")
    return f"{float(found[1]) * factor!r} {found[2]}"


def chosen(items: list[Any], step: str) -> list[int]:
    """The places of a list that a step means."""
    if step == "*" and items:
        return list(range(len(items)))
    names = [
        str(item["name"]) if isinstance(item, Mapping) and "name" in item else str(k)
        for k, item in enumerate(items)
    ]
    if step in names:
        return [names.index(step)]
    if step.isdecimal() and int(step) < len(items):
        return [int(step)]
    raise KeyPathError(f"{step}: {choice(step, [*names, '*'])}")


def with_values(data: Mapping[str, Any], changes: Mapping[str, tuple[Any, bool]]) -> dict[str, Any]:
    """What a file says with several keys replaced; a value with whether it is a factor, by key."""
    result = dict(data)
    for key, (value, factor) in changes.items():
        result = changed(result, key, value, factor=factor)
    return result
