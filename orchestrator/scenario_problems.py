"""The words for what is wrong with a scenario: one line each, with what is allowed and a likely spelling."""

from __future__ import annotations

import difflib
import math
import typing
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from orchestrator.scenario import Scenario, is_fmu
from rotor_fmu.train import Train

STEPS_PER_REVOLUTION = 10
"""Least number of macro steps in a revolution: below it the unbalance itself is not resolved."""

_ALLOWED = {
    "greater_than": "a number greater than {gt:g}",
    "greater_than_equal": "a number of at least {ge:g}",
    "less_than_equal": "a number of at most {le:g}",
    "float_parsing": "a number",
    "float_type": "a number",
    "finite_number": "a finite number",
    "int_parsing": "a whole number",
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "string_type": "a text in quotes",
    "dict_type": "a table, [...]",
    "model_type": "a table, [...]",
}


def shape_problems(error: ValidationError) -> Iterator[str]:
    """Yield what pydantic found: unknown and missing keys, wrong types, values out of range."""
    for problem in error.errors():
        path = [str(part) for part in problem["loc"]]
        where, kind, value = ".".join(path), problem["type"], problem.get("input")
        if kind == "extra_forbidden":
            yield f"{where}: unknown key; {_choice(path[-1], _keys_at(path[:-1]))}"
        elif kind == "missing":
            yield f"{where}: missing; it must be given"
        elif kind == "literal_error":
            yield f"{where} = {value!r}; {_choice(str(value), _literals(path))}"
        else:
            text = _ALLOWED.get(kind, problem["msg"]).format(**problem.get("ctx", {}))
            yield f"{where} = {value!r}; allowed is {text}"


def name_problems(raw: Mapping[str, Any], train: Train) -> Iterator[str]:
    """Yield names of wheels and bearings that the train does not have."""
    wheels = [wheel.name for wheel in train.wheels]
    bearings = [bearing.name for bearing in train.bearings]
    for name in _table(raw, "depth_at"):
        if name not in bearings:
            yield f"depth_at.{name}: no such bearing; {_choice(name, bearings)}"
    for name in _table(_table(raw, "unbalance"), "at"):
        if name not in wheels:
            yield f"unbalance.at.{name}: no such wheel; {_choice(name, wheels)}"
    analysed = raw.get("analysed_bearing")
    if isinstance(analysed, str) and analysed not in bearings:
        yield f"analysed_bearing = {analysed!r}: no such bearing; {_choice(analysed, bearings)}"
    wheel = _table(raw, "event").get("wheel")
    if isinstance(wheel, str) and wheel not in wheels:
        yield f"event.wheel = {wheel!r}: no such wheel; {_choice(wheel, wheels)}"


def time_problems(scenario: Scenario, train: Train) -> Iterator[str]:
    """Yield contradictions between the times of the scenario and of the train."""
    longest = 2.0 * math.pi / train.speed / STEPS_PER_REVOLUTION
    if scenario.step > longest:
        yield (
            f"step = {scenario.step!r}; allowed is at most a tenth of a revolution of train "
            f"{train.name!r}, {longest:.3g} s"
        )
    if scenario.step > scenario.end:
        yield f"step = {scenario.step!r}; allowed is at most the end time, {scenario.end!r} s"
    if scenario.event is not None and scenario.event.time >= scenario.end:
        yield (
            f"event.time = {scenario.event.time!r}; allowed is a time before the end, {scenario.end!r} s "
            "(take out [event] for a run without blade fracture)"
        )


def _choice(given: str, allowed: Iterable[str]) -> str:
    """Say what is allowed, with the closest of it first if it is close."""
    names = list(allowed)
    folded = {name.casefold(): name for name in names}
    close = difflib.get_close_matches(given.casefold(), folded, n=1)
    hint = f"did you mean {folded[close[0]]!r}? " if close else ""
    return f"{hint}allowed are {', '.join(names)}"


def file_problems(raw: Mapping[str, Any], folder: Path) -> Iterator[str]:
    """Yield FMUs of the user that are not there."""
    for name, depth in _table(raw, "depth_at").items():
        if isinstance(depth, str) and is_fmu(depth) and not (folder / depth).is_file():
            yield f"depth_at.{name} = {depth!r}: no such file"


def _literals(path: list[str]) -> tuple[str, ...]:
    """What is allowed where a literal is expected."""
    model, key = _owner(path)
    allowed = typing.get_args(model.model_fields[key].annotation) if model else ()
    if all(isinstance(a, str) for a in allowed):
        return allowed
    literal, *_ = typing.get_args(allowed[-1])  # a table whose values are depths or files
    return (*typing.get_args(literal), "the path of an .fmu file")


def _table(raw: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    value = raw.get(key)
    return value if isinstance(value, dict) else {}


def _keys_at(path: list[str]) -> list[str]:
    model: type[BaseModel] | None = Scenario
    if path:
        owner, key = _owner(path)
        model = _model_of(owner.model_fields[key].annotation) if owner else None
    return [k for k, field in model.model_fields.items() if not field.exclude] if model else []


def _owner(path: list[str]) -> tuple[type[BaseModel] | None, str]:
    """Return the model that holds the last key of `path` that is a field, and that key."""
    model: type[BaseModel] | None = Scenario
    owner, last = model, path[0]
    for key in path:
        if model is None or key not in model.model_fields:
            continue  # the name of an entry of a table
        owner, last = model, key
        model = _model_of(model.model_fields[key].annotation)
    return owner, last


def _model_of(annotation: Any) -> type[BaseModel] | None:
    for candidate in (annotation, *typing.get_args(annotation)):
        if isinstance(candidate, type) and issubclass(candidate, BaseModel):
            return candidate
    return None
