"""Trains that are others but for some keys: ``base = "train.toml"`` and what differs.

``[every_bearing]`` has keys of all bearings with a bore, ``[[bearing]]`` those of the bearing of that name,
and any other key takes the place of the base's.  A bore takes the place of the base's with all its keys.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from rotor_fmu.train.bore import KEYS
from rotor_fmu.train.toml_source import Problem, TomlError, TomlSource, read_toml

_BASE, _EVERY = "base", "every_bearing"


class _Derived(TomlSource):
    """What a derived file and its base say together; its lines are in two files, and are not told."""

    def __init__(self, raw: dict[str, Any]) -> None:
        super().__init__("")
        self.raw = raw

    def located(self, problems: Iterable[Problem]) -> Iterator[str]:
        """Yield the texts of problems."""
        for _, text in problems:
            yield text


def based(source: TomlSource, path: Path) -> tuple[TomlSource, Path]:
    """What a train's file says with its base, and the file from which its tables count.

    Raises
    ------
    TomlError
        The base cannot be read, or has a base itself, or what takes its place is no table.
    """
    own = dict(source.raw)
    name = own.pop(_BASE, None)
    if name is None:
        if _EVERY in own:
            raise TomlError(f"{_EVERY}: allowed is it beside {_BASE}")
        return source, path
    if not isinstance(name, str):
        raise TomlError(f"{_BASE} = {name!r}; allowed is the path of a train's file")
    there = path.parent / name
    raw = read_toml(there).raw
    if _BASE in raw:
        raise TomlError(f"{_BASE} = {name!r}; allowed is a train without {_BASE}")
    every, each = own.pop(_EVERY, {}), own.pop("bearing", [])
    listed = isinstance(each, list) and all(isinstance(one, Mapping) and "name" in one for one in each)
    if not isinstance(every, Mapping) or not listed:
        raise TomlError(f"{_EVERY} and bearing: allowed are a table, and tables with the name of a bearing")
    known = [one.get("name") for one in raw.get("bearing", [])]
    for one in each:
        if one["name"] not in known:
            raise TomlError(f"bearing {one['name']!r}; allowed are those of the base, {', '.join(known)}")
    changes = {one["name"]: one for one in each}
    bearings = [_changed(one, every, changes.get(one.get("name"), {})) for one in raw.get("bearing", [])]
    return _Derived({**raw, **own, "bearing": bearings}), there


def _changed(bearing: Mapping[str, Any], every: Mapping[str, Any], own: Mapping[str, Any]) -> dict[str, Any]:
    """A bearing with what takes the place of its keys."""
    new = {**(every if "clearance" in bearing else {}), **own}
    kept = {key: value for key, value in bearing.items() if key not in KEYS or "bore" not in new}
    return {**kept, **new}
