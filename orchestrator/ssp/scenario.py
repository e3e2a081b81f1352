"""An SSP as a scenario: for record, summary and figures, and to check its values as those of a scenario."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from bearing_fmu import depths
from bearing_fmu.recipe import PREFIX
from fmus import port
from orchestrator.errors import ScenarioError
from orchestrator.fmi.file import FmuFile
from orchestrator.master.coupling import SCHEMES
from orchestrator.master.system import Wiring
from orchestrator.scenario.file import replaced
from orchestrator.scenario.parameters import offset_names
from orchestrator.scenario.problems import event_problems, shape_problems, time_problems, unbalance_problems
from orchestrator.scenario.scenario import FilmSettings, Scenario
from orchestrator.ssp.contents import Contents, value_of
from orchestrator.ssp.happening import events_of, rotation_of, wheel_values
from orchestrator.ssp.structure import SspError
from rotor_fmu.train.checks import film_problems

DEFAULT_STEP, DEFAULT_END = 1e-4, 1.0
_FARTHEST = 2.0  # clearances from the centre of a bearing to its journal's start
_ALLOWED = ("end", "step", "coupling", "tolerance", "ledger")

_FILM = {key: name for key, name in port.BEARING_KEYS.items() if key not in FilmSettings.model_fields}
"""Variables of a bearing of bladeloss by the keys of a train file."""


def as_scenario(contents: Contents, overrides: Mapping[str, Any], path: Path) -> Scenario:
    """Describe an SSP as a scenario, for record and summary.

    Parameters
    ----------
    contents : Contents
        The SSP; where its parameters say more than a scenario can, they count and not this.
    overrides : mapping
        Values of ``end``, ``step``, ``coupling``, ``tolerance`` and ``ledger`` in place of those of the SSP,
        as in `orchestrator.scenario.file.load_scenario`.
    path : Path
        The archive.

    Raises
    ------
    SspError
        When something else is to be replaced, or the coupling does not fit the connections.
    ScenarioError
        When times or speeds contradict one another.
    """
    for key in overrides:
        if key not in _ALLOWED:
            raise SspError(
                f"{path}: --{key.replace('_', '-')} is for scenarios; an SSP holds its FMUs and parameters, "
                "allowed are --end, --step, --coupling, --tol, --ledger"
            )
    structure, train = contents.structure, contents.train
    usual = "linear-implicit" if contents.wiring is Wiring.LAW else "gauss-seidel"
    said = {"coupling": structure.coupling, "tolerance": structure.tolerance}
    own = replaced({key: value for key, value in said.items() if value is not None}, overrides)
    coupling = own.get("coupling") or usual
    if coupling not in SCHEMES or SCHEMES[coupling].wiring is not contents.wiring:
        allowed = [name for name, scheme in SCHEMES.items() if scheme.wiring is contents.wiring]
        raise SspError(
            f"{path}: coupling {coupling!r}: the connections carry: {contents.wiring.value}; "
            f"allowed is {' or '.join(allowed)}"
        )
    end = overrides.get("end") or structure.end or DEFAULT_END
    first = contents.bearings[0]
    found = {
        seat.name: _depth(contents.files[c.name])
        for seat, c in zip(train.bearings, contents.bearings, strict=True)
    }
    common = next((depth for depth in found.values() if depth in depths.names()), depths.names()[0])
    film = {
        key: _whole(value_of(contents, first, f"film.{key}"))
        for key in FilmSettings.model_fields
        if f"film.{key}" in contents.files[first.name].variables
    }
    values: dict[str, Any] = {
        "title": structure.title or structure.name,
        "train": train.name,
        "reduction": value_of(contents, contents.rotor, "reduction"),
        "depth": common,
        "depth_at": {name: depth for name, depth in found.items() if depth != common},
        "unbalance": _unbalance(contents),
        "events": events_of(contents, end, path),
        "rotation": rotation_of(contents),
        "end": end,
        "step": overrides.get("step") or structure.step or DEFAULT_STEP,
        "coupling": coupling,
        "tolerance": own.get("tolerance"),
        "ledger": bool(overrides.get("ledger", False)),
        "film": film,
        "record": {} if structure.record_interval is None else {"interval": structure.record_interval},
        "analysed_bearing": structure.analysed_bearing,
        "folder": path.parent,
    }
    try:
        scenario = Scenario(**values)
    except ValidationError as error:
        raise ScenarioError(str(path), [text for _, text in shape_problems(error)]) from None
    problems = [text for _, text in (*time_problems(scenario, train), *unbalance_problems(scenario, train))]
    problems += [text for _, text in event_problems(scenario)]
    problems += _speed_problems(contents)
    problems += _film_problems(contents)
    problems += _start_problems(contents)
    if problems:
        raise ScenarioError(str(path), problems)
    return scenario


def _speed_problems(contents: Contents) -> Iterator[str]:
    speed = float(value_of(contents, contents.rotor, port.SPEED))
    for component in contents.bearings:
        other = float(value_of(contents, component, port.SPEED))
        if other != speed:
            yield f"{component.name}: speed = {other!r}; allowed is that of the rotor, {speed!r} rad/s"


def _film_problems(contents: Contents) -> Iterator[str]:
    """Bearings of bladeloss whose values are no bearing's, such as a clearance in mm."""
    for component in contents.bearings:
        if contents.files[component.name].variables.keys() >= set(_FILM.values()):
            values = {
                key: str(value) if key == "bore" else float(value)
                for key, value in ((key, value_of(contents, component, name)) for key, name in _FILM.items())
            }
            warmed = values.get("viscosity_40") or values.get("viscosity_100")
            for key in ("viscosity",) if warmed else ("viscosity_40", "viscosity_100"):
                values.pop(key, None)  # a film has either a viscosity or the curve of its oil
            yield from (f"{component.name}: {text}" for text in film_problems(values))


def _start_problems(contents: Contents) -> Iterator[str]:
    """Journals that would start far outside of their bores."""
    for index, component in enumerate(contents.bearings, 1):
        if not contents.files[component.name].variables.keys() >= {"clearance", *offset_names()}:
            continue  # of somebody else
        names = [port.at_bearing(index, f"start.{axis}") for axis in "xy"]
        place = [float(value_of(contents, contents.rotor, name)) for name in names]
        centre = [float(value_of(contents, component, f"offset.{axis}")) for axis in "xy"]
        ratio = math.dist(place, centre) / float(value_of(contents, component, "clearance"))
        if ratio > _FARTHEST:
            yield (
                f"{contents.rotor.name}: {names[0]}, y = {place[0]:g}, {place[1]:g}: "
                f"{ratio:.3g} clearances from the centre of {component.name}; allowed are {_FARTHEST:g}, in m"
            )


def _depth(file: FmuFile) -> str:
    """Return the depth of a bearing of bladeloss; of others the file name."""
    depth = str(file.description.modelName).removeprefix(PREFIX)
    return depth if depth in depths.names() else file.path.name


def _whole(value: Any) -> float | str:
    """Return a number without its fraction of zero; one that has another is refused later, by its name."""
    try:
        number = float(value)
    except ValueError:
        return str(value)  # a word
    return int(number) if number.is_integer() else number


def _unbalance(contents: Contents) -> dict[str, Any]:
    train = contents.train
    values = zip(
        train.wheels,
        train.nominal_unbalance,
        wheel_values(contents, "unbalance"),
        wheel_values(contents, "unbalance_phase"),
        strict=True,
    )
    return {
        "at": {
            wheel.name: {"unbalance": value, "phase": phase}
            for wheel, nominal, value, phase in values
            if (value, phase) != (nominal, wheel.unbalance_phase)
        }
    }
