"""Read a scenario: bundled or from a TOML file, every problem of the file reported at once."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import tomlkit
from pydantic import ValidationError

from bearing_fmu.depths import LINEAR
from orchestrator.errors import OrchestratorError, ScenarioError
from orchestrator.scenario.film_problems import depth_problems, film_problems
from orchestrator.scenario.problems import (
    event_problems,
    file_problems,
    name_problems,
    scale_problems,
    shape_problems,
    time_problems,
    unbalance_problems,
)
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.file import TrainFileError, bundled_file, load_train
from rotor_fmu.train.toml_source import Location, Problem, TomlError, TomlSource, read_toml
from rotor_fmu.train.train import Train
from rotor_fmu.train.wording import choice

_SCENARIOS = Path(__file__).parent / "bundled"


def bundled_scenarios() -> tuple[str, ...]:
    """Names of the scenarios that come with the package."""
    return tuple(sorted(path.stem for path in _SCENARIOS.glob("*.toml")))


def load_scenario(source: str | Path, overrides: Mapping[str, Any] | None = None) -> Scenario:
    """Read and check a scenario.

    Parameters
    ----------
    source : str or Path
        Name of a bundled scenario (see `bundled_scenarios`) or path of a TOML file.
    overrides : mapping, optional
        Values that replace those of the file, in the shape of the file: ``{"depth": "v2",
        "depth_at": {"LP1-rear": "v1"}, "end": 0.5}``. Tables are merged key by key, and None
        takes a key out: ``{"event": None}``.

    Returns
    -------
    Scenario

    Raises
    ------
    ScenarioError
        With one line for each problem of the file: file, key, value, what is allowed.
    """
    return load_with_train(source, overrides)[0]


def load_with_train(source: str | Path, overrides: Mapping[str, Any] | None = None) -> tuple[Scenario, Train]:
    """Read and check a scenario as `load_scenario`, and return its train with it."""
    path = Path(source)
    if str(source) in bundled_scenarios():
        path = _SCENARIOS / f"{source}.toml"
    elif not path.exists():
        known = choice(str(source), bundled_scenarios())
        raise ScenarioError(str(source), [f"no such scenario; {known}, or the path of a TOML file"])
    try:
        toml = read_toml(path)
    except TomlError as error:
        raise ScenarioError(str(source), [str(error)]) from None
    return _checked(toml, overrides or {}, path.parent, str(source))


def parse_scenario(text: str, folder: Path, source: str) -> Scenario:
    """Read a scenario from TOML text; relative paths count from `folder`, `source` names it in errors.

    Raises
    ------
    ScenarioError
        As in `load_scenario`.
    """
    return parse_with_train(text, folder, source)[0]


def parse_with_train(text: str, folder: Path, source: str) -> tuple[Scenario, Train]:
    """Read a scenario from TOML text as `parse_scenario`, and return its train with it."""
    try:
        toml = TomlSource(text)
    except TomlError as error:
        raise ScenarioError(source, [str(error)]) from None
    return _checked(toml, {}, folder, source)


def with_overrides(scenario: Scenario, overrides: Mapping[str, Any]) -> Scenario:
    """Return the scenario with values replaced and checked as in `load_scenario`.

    Raises
    ------
    ScenarioError
        When the values do not fit.
    """
    raw = scenario.model_dump(mode="json", exclude_defaults=True) | {"coupling": scenario.coupling}
    return check_with_train(replaced(raw, overrides), scenario.folder, scenario.title or "scenario")[0]


def check_with_train(
    raw: Mapping[str, Any], folder: Path, source: str, train: Train | None = None
) -> tuple[Scenario, Train]:
    """Check what a scenario's file may say as `load_with_train`; on `train` in place of the one named."""
    return _checked(TomlSource(""), raw, folder, source, train)  # the problems have no lines


def train_of(scenario: Scenario) -> Train:
    """Read the train of a scenario.

    Raises
    ------
    OrchestratorError
        When it cannot be read.
    """
    return read_train(_train_path(scenario.train, scenario.folder))


def train_folder(scenario: Scenario) -> Path:
    """Folder of the files of a scenario's train."""
    bundled = bundled_file(scenario.train)
    if bundled is not None:
        return bundled.parent
    path = scenario.folder / scenario.train
    return path if path.is_dir() else path.parent


def read_train(source: str | Path) -> Train:
    """Read a train by its name, folder or file.

    Raises
    ------
    OrchestratorError
        With one line for each problem.
    """
    try:
        return load_train(source)
    except TrainFileError as error:
        raise OrchestratorError(str(error)) from None


def scenario_toml(scenario: Scenario) -> str:
    """TOML text of a scenario, its defaults spelt out; reading it gives the scenario again."""
    return tomlkit.dumps(_without_empty(scenario.model_dump(mode="json", exclude_none=True)))


def _checked(
    toml: TomlSource,
    overrides: Mapping[str, Any],
    folder: Path,
    source: str,
    given: Train | None = None,
) -> tuple[Scenario, Train]:
    """Return scenario and train of a file with overrides in place of its values, or raise all problems."""
    raw = replaced(toml.raw, overrides)
    problems: list[Problem] = []
    alone = raw.pop("event", None)
    single = alone is not None and "events" not in raw
    if single:
        raw["events"] = [alone]
    elif alone is not None:
        problems.append((("event",), "event: given beside events; allowed is one of them"))
    scenario, train = None, given
    try:
        if "folder" in raw:
            problems.append((("folder",), "folder: unknown key"))
        scenario = Scenario.model_validate({**raw, "folder": folder})
    except ValidationError as error:
        problems += shape_problems(error)
    if given is None and isinstance(raw.get("train"), str):
        try:
            train = load_train(_train_path(raw["train"], folder))
        except TrainFileError as error:
            problems += ((("train",), f"train = {raw['train']!r}: {text}") for text in error.problems)
    if train is not None:
        problems += name_problems(raw, train)
    problems += file_problems(raw, folder)
    if train is not None and scenario is not None:
        problems += time_problems(scenario, train)
        problems += unbalance_problems(scenario, train)
        problems += event_problems(scenario)
        problems += scale_problems(scenario, train)
        problems += depth_problems(scenario, train)
        problems += film_problems(scenario, train)
    if scenario is None or train is None or problems:
        # An override stands on no line.
        written = map(_of_single, problems) if single else problems
        places = (((), text) if _holds(overrides, at) else (at, text) for at, text in written)
        raise ScenarioError(source, list(toml.located(places)))
    return on_train(scenario, train), train


def on_train(scenario: Scenario, train: Train) -> Scenario:
    """The scenario with depth linear at the bearings that have no bore, and everywhere if none has one."""
    bare = [seat.name for seat in train.bearings if not seat.has_film and seat.name not in scenario.depth_at]
    if len(bare) == len(train.bearings):
        return scenario.model_copy(update={"depth": LINEAR.name})
    there = {name: LINEAR.name for name in bare if scenario.depth != LINEAR.name}
    return scenario.model_copy(update={"depth_at": {**scenario.depth_at, **there}}) if there else scenario


def _of_single(problem: Problem) -> Problem:
    """A problem of the only event as the table ``[event]`` spells it."""
    location, text = problem
    if tuple(location[:2]) != ("events", 0):
        return problem
    return ("event", *location[2:]), "event" + text.removeprefix("events.0")


def _holds(overrides: Mapping[str, Any], location: Location) -> bool:
    """Whether the value at a location is an override, which stands on no line of the file."""
    value: Any = overrides
    for step in location:
        if not isinstance(value, Mapping):
            return True
        if step not in value:
            return False
        value = value[step]
    return True


def train_source(scenario: Scenario) -> str | Path:
    """The name of a scenario's train, or where it lies."""
    return _train_path(scenario.train, scenario.folder)


def _train_path(train: str, folder: Path) -> str | Path:
    return folder / train if bundled_file(train) is None else train


def replaced(raw: Mapping[str, Any], overrides: Mapping[str, Any]) -> dict[str, Any]:
    """Merge overrides into what a file says, table by table; None takes a key out.

    A tolerance belongs to the step and the coupling beside it, and goes where they are replaced.  A step
    alone is fixed, which a coupling of many rates has none of: it goes, see `Scenario.coupling`.
    """
    fixed = {} if overrides.keys().isdisjoint(("step", "coupling")) else {"tolerance": None}
    if "step" in overrides and "tolerance" not in overrides and raw.get("coupling") == "multirate":
        fixed["coupling"] = None
    return _merged(_one_form(raw, overrides), {**fixed, **overrides})


def _one_form(raw: Mapping[str, Any], overrides: Mapping[str, Any]) -> dict[str, Any]:
    """The file with its events in the form, ``event`` or ``events``, in which they are replaced."""
    base = dict(raw)
    if "events" in overrides:
        base.pop("event", None)
    elif "event" in overrides:
        listed = base.get("events")
        if overrides["event"] is None:
            base.pop("events", None)
        elif isinstance(listed, list) and len(listed) == 1:
            base["event"] = base.pop("events")[0]
    return base


def _merged(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Merge tables key by key; None takes a key out."""
    result = dict(base)
    for key, value in changes.items():
        if isinstance(value, Mapping):
            inner = result.get(key)
            result[key] = _merged(inner if isinstance(inner, Mapping) else {}, value)
        elif value is None:
            result.pop(key, None)
        else:
            result[key] = value
    return result


def _without_empty(table: Mapping[str, Any]) -> dict[str, Any]:
    """Leave out tables that hold nothing."""
    inner = {key: _without_empty(v) if isinstance(v, Mapping) else v for key, v in table.items()}
    return {key: value for key, value in inner.items() if value != {}}
