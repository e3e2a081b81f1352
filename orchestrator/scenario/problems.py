"""The words for what is wrong with a scenario: one line each, with what is allowed and a likely spelling."""

from __future__ import annotations

import math
import os
import typing
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from bearing_fmu.depths import LINEAR
from orchestrator.scenario.events import KINDS, BladeLoss, Change, Event, Switch
from orchestrator.scenario.scenario import Scenario, is_fmu
from rotor_fmu.train.toml_source import Location, Problem
from rotor_fmu.train.train import Train
from rotor_fmu.train.wording import choice, refusal, shown

STEPS_PER_REVOLUTION = 10
"""Least number of macro steps in a revolution: below it the unbalance itself is not resolved."""

MOST_STEPS = 1e9
"""Of a run: a day for a train whose step takes a tenth of a millisecond."""

COARSEST = 0.1
"""Tolerance of many rates up to which the turbine's contact was found, at 0.3 its shaft was thrown out."""

FASTEST, WIDEST = 5.0, 10.0
"""Times the rated speed, times the largest clearance: beyond that a value is in another unit."""

_BYTES_AT_BEARING = 8 * 31
_BYTES_AT_NODE = 4 * 4
"""Of one sample of the record, see `orchestrator.observers.recorder`."""


def shape_problems(error: ValidationError) -> Iterator[Problem]:
    """Yield what pydantic found: unknown and missing keys, wrong types, values out of range."""
    for problem in error.errors():
        path = [str(part) for part in problem["loc"]]
        where, kind = ".".join(path), problem["type"]
        if kind == "extra_forbidden":
            text = f"{where}: unknown key; {choice(path[-1], _keys_at(path[:-1]))}"
        elif kind == "missing":
            text = f"{where}: missing; it must be given"
        elif kind == "literal_error":
            value = problem["input"]
            text = f"{where} = {shown(value)}; {choice(str(value), _literals(path))}"
        elif kind == "depth":
            value = problem["input"]
            text = f"{where} = {shown(value)}; {choice(str(value), problem['ctx']['allowed'])}"
        elif kind == "value_error" and "allowed is" in problem["msg"]:
            text = f"{where} = {shown(problem['input'])}; {problem['msg'].removeprefix('Value error, ')}"
        else:
            text = refusal(where, problem, _description(path))
        yield problem["loc"], text


def name_problems(raw: Mapping[str, Any], train: Train) -> Iterator[Problem]:
    """Yield names of wheels and bearings that the train does not have."""
    wheels = {wheel.name: "wheel" for wheel in train.wheels}
    bearings = {bearing.name: "bearing" for bearing in train.bearings}
    others = wheels | bearings | {coupling.name: "coupling" for coupling in train.couplings}

    def unknown(name: str, kind: str, allowed: Iterable[str]) -> str:
        other = f" ({name!r} is a {others[name]})" if name in others else ""
        return f"no such {kind}{other}; {choice(name, allowed)}"

    for name in _table(raw, "depth_at"):
        if name not in bearings:
            yield ("depth_at", name), f"depth_at.{name}: {unknown(name, 'bearing', bearings)}"
    for name in _table(_table(raw, "unbalance"), "at"):
        if name not in wheels:
            yield ("unbalance", "at", name), f"unbalance.at.{name}: {unknown(name, 'wheel', wheels)}"
    analysed = raw.get("analysed_bearing")
    if isinstance(analysed, str) and analysed not in bearings:
        text = unknown(analysed, "bearing", bearings)
        yield ("analysed_bearing",), f"analysed_bearing = {analysed!r}: {text}"
    events = raw.get("events")
    for index, event in enumerate(events if isinstance(events, list) else ()):
        wheel = event.get("wheel") if isinstance(event, dict) else None
        if isinstance(wheel, str) and wheel not in wheels:
            text = unknown(wheel, "wheel", wheels)
            yield ("events", index, "wheel"), f"events.{index}.wheel = {wheel!r}: {text}"
        bearing = event.get("bearing") if isinstance(event, dict) else None
        if isinstance(bearing, str) and bearing not in bearings:
            text = unknown(bearing, "bearing", bearings)
            yield ("events", index, "bearing"), f"events.{index}.bearing = {bearing!r}: {text}"


def unbalance_problems(scenario: Scenario, train: Train) -> Iterator[Problem]:
    """Yield unbalances that are more than the whole wheel has at its radius."""
    given: list[tuple[Location, str, float]] = [
        (("unbalance", "at", name), name, at.unbalance) for name, at in scenario.unbalance.at.items()
    ]
    for index, event in enumerate(scenario.events):
        if isinstance(event, BladeLoss):
            given.append((("events", index), event.wheel, event.unbalance))
    wheels = {wheel.name: wheel for wheel in train.wheels}
    for location, name, unbalance in given:
        wheel = wheels.get(name)
        most = 0.5 * wheel.mass * wheel.mean_diameter if wheel else 0.0
        if 0.0 < most < unbalance:
            where = ".".join(map(str, location))
            yield (
                (*location, "unbalance"),
                f"{where}.unbalance = {unbalance!r}; allowed is at most {most:.4g} kg m, all of "
                f"wheel {name!r} at its mean radius; did you give kg mm?",
            )


def time_problems(scenario: Scenario, train: Train) -> Iterator[Problem]:
    """Yield contradictions between the times of the scenario and of the train."""
    course = scenario.rotation.course if scenario.rotation is not None else None
    fastest = max(abs(speed) for _, speed in course) if course else train.speed
    longest = 2.0 * math.pi / fastest / STEPS_PER_REVOLUTION
    if scenario.step > longest:
        yield (
            ("step",),
            f"step = {scenario.step!r}; allowed is at most a tenth of a revolution of train "
            f"{train.name!r}, {longest:.3g} s",
        )
    if scenario.step < scenario.end / MOST_STEPS:
        yield (
            ("step",),
            f"step = {scenario.step!r}; allowed is at least {scenario.end / MOST_STEPS:.3g} s, a billionth "
            "of the run, which would never end",
        )
    if scenario.coupling == "jacobi" and scenario.tolerance is not None:
        yield (
            ("tolerance",),
            f"tolerance = {scenario.tolerance!r}; allowed is none with coupling jacobi, whose bearings see "
            "the rotor a step late: what that neglects does not fall with the step; take gauss-seidel",
        )
    if scenario.coupling == "multirate" and (scenario.tolerance or 0.0) > COARSEST:
        yield (
            ("tolerance",),
            f"tolerance = {scenario.tolerance!r}; allowed is at most {COARSEST:g} with coupling multirate: "
            "beyond that a journal may hit its shell before the bearing is evaluated again",
        )
    if scenario.step > scenario.end:
        yield ("step",), f"step = {scenario.step!r}; allowed is at most the end time, {scenario.end!r} s"
    for index, event in enumerate(scenario.events):
        if event.timed and event.time >= scenario.end:
            yield (
                ("events", index, "time"),
                f"events.{index}.time = {event.time!r}; allowed is a time before the end, {scenario.end!r} s "
                "(take out the event for a run without it)",
            )
    size = record_size(scenario, train)
    memory = _memory()
    if size > memory:
        interval = max(scenario.record.interval, scenario.step) * size / memory
        yield (
            ("end",),
            f"end = {scenario.end!r}; its record takes {size / 1e9:.3g} GB, and this machine has "
            f"{memory / 1e9:.3g}; allowed is an earlier end, or a record.interval from {interval:.2g} s on",
        )


def scale_problems(scenario: Scenario, train: Train) -> Iterator[Problem]:
    """Yield speeds and lengths far beyond the train's own, which no run would come to: in rev/min or um."""
    fastest = FASTEST * train.speed
    # without a film there is no clearance, and a journal may go anywhere
    widest = WIDEST * max(seat.clearance if seat.has_film else math.inf for seat in train.bearings)
    speed = f"allowed is at most {FASTEST:g} times the train's, {fastest:.4g} rad/s; did you give rev/min?"
    length = f"allowed is at most {WIDEST:g} times the largest clearance, {widest:.3g} m; did you give um?"
    limits = {"speed": (fastest, speed), "vibration": (widest, length), "least_gap": (widest, length)}
    course = scenario.rotation.course if scenario.rotation is not None else None
    if course and (top := max((value for _, value in course), key=abs)) and abs(top) > fastest:
        yield ("rotation", "course"), f"rotation.course: {top!r}; {speed}"
    for index, event in enumerate(scenario.events):
        for key, (most, words) in limits.items():
            value = getattr(event, key, None)
            if value is not None and abs(value) > most:
                yield ("events", index, key), f"events.{index}.{key} = {value!r}; {words}"


def event_problems(scenario: Scenario) -> Iterator[Problem]:
    """Yield events that lack what they need."""
    for index, event in enumerate(scenario.events):
        if scenario.rotation is None and (isinstance(event, (Switch, Change)) or not event.timed):
            what = f"events.{index}.kind = {event.kind!r}"
            what += "" if event.timed or not isinstance(event, BladeLoss) else ", by a condition"
            yield ("events", index, "kind"), f"{what}; allowed is it beside a table rotation"
        if isinstance(event, Change) and scenario.depth_of(event.bearing) == LINEAR.name:
            where = f"events.{index}.bearing = {event.bearing!r}"
            yield (
                ("events", index, "bearing"),
                f"{where}; allowed is one with a film: this is of depth linear",
            )


def record_size(scenario: Scenario, train: Train) -> float:
    """Bytes of the record of a run."""
    samples = scenario.end / max(scenario.record.interval, scenario.step)
    return samples * (len(train.bearings) * _BYTES_AT_BEARING + train.nodes * _BYTES_AT_NODE)


def _memory() -> float:
    """Bytes of the machine, or no limit where it does not tell."""
    try:
        return float(os.sysconf("SC_PAGE_SIZE")) * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        return math.inf


def file_problems(raw: Mapping[str, Any], folder: Path) -> Iterator[Problem]:
    """Yield FMUs of the user that are not there."""
    for name, depth in _table(raw, "depth_at").items():
        if isinstance(depth, str) and is_fmu(depth) and not (folder / depth).is_file():
            yield ("depth_at", name), f"depth_at.{name} = {depth!r}: no such file"


def _literals(path: list[str]) -> tuple[str, ...]:
    """What is allowed where a literal is expected."""
    model, key = _owner(path)
    if model is not None and issubclass(model, Event) and key == "kind":
        return tuple(KINDS)
    return typing.get_args(model.model_fields[key].annotation) if model else ()


def _description(path: list[str]) -> str | None:
    """Unit and usual slip of a key."""
    model, key = _owner(path)
    return model.model_fields[key].description if model and key == path[-1] else None


def _table(raw: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    value = raw.get(key)
    return value if isinstance(value, dict) else {}


def _keys_at(path: list[str]) -> list[str]:
    models: tuple[type[BaseModel], ...] = (Scenario,)
    if path:
        owner, key = _owner(path)
        models = _models_of(owner.model_fields[key].annotation) if owner else ()
    return list(dict.fromkeys(k for m in models for k, field in m.model_fields.items() if not field.exclude))


def _owner(path: list[str]) -> tuple[type[BaseModel] | None, str]:
    """Return the model that holds the last key of `path` that is a field, and that key."""
    models: tuple[type[BaseModel], ...] = (Scenario,)
    owner: type[BaseModel] | None = Scenario
    last = path[0]
    for key in path:
        holder = next((model for model in models if key in model.model_fields), None)
        if holder is None:
            continue  # the name of an entry of a table, or its place in a list
        owner, last = holder, key
        models = _models_of(holder.model_fields[key].annotation)
    return owner, last


def _models_of(annotation: Any) -> tuple[type[BaseModel], ...]:
    """The models that a value of this annotation may be of, or have as its entries."""
    if isinstance(annotation, type) and issubclass(annotation, Event):
        return tuple(KINDS.values())
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return (annotation,)
    found = (_models_of(argument) for argument in typing.get_args(annotation))
    return next((models for models in found if models), ())
