"""From scenario and train to FMU parameters, and nowhere else; an event names those that it sets itself."""

from __future__ import annotations

import json
from dataclasses import replace

from bearing_fmu.depths import LINEAR
from fmus import port
from orchestrator.scenario.events import Values, loss_parameters
from orchestrator.scenario.scenario import FilmSettings, Scenario
from rotor_fmu.train.train import BearingSeat, Train


def needed_depths(scenario: Scenario, train: Train) -> set[str]:
    """Depths of which a scenario needs FMUs: those of its bearings, and films that are to be linearised."""
    needed = {scenario.depth_of(seat.name) for seat in train.bearings}
    return needed | ({scenario.linear_from} if any(linearised(scenario, train)) else set())


def linearised(scenario: Scenario, train: Train) -> list[BearingSeat]:
    """Bearings of depth linear whose stiffness and damping are to be those of a film."""
    return [
        seat for seat in train.bearings
        if scenario.depth_of(seat.name) == LINEAR.name and not seat.coefficients
    ]  # fmt: skip


def rotor_parameters(scenario: Scenario, train: Train) -> Values:
    """Parameters of the rotor: reduction, nominal unbalance, blade fracture.

    Parameters
    ----------
    scenario : Scenario
        Its balance grade scales the train's nominal unbalance, its overrides replace it wheel by wheel.
    train : Train
        Wheels in the order of the rotor's.

    Returns
    -------
    dict
        Values by variable name.
    """
    values: Values = {"reduction": scenario.reduction}
    if scenario.ledger:
        values["track_work"] = True
    values["fracture.time"] = scenario.end
    for index, (unbalance, phase) in enumerate(wheel_unbalances(scenario, train), 1):
        values[f"wheel[{index}].unbalance"] = unbalance
        values[f"wheel[{index}].unbalance_phase"] = phase
        values[f"wheel[{index}].blade_unbalance"] = 0.0
        values[f"wheel[{index}].blade_phase"] = 0.0
    rotation = scenario.rotation
    if rotation is not None:
        inertia = rotation.inertia if rotation.inertia is not None else train.polar_inertia
        values["drive.inertia"] = inertia / rotation.haste
        values |= {f"drive.{name}": getattr(rotation, name) for name in ("windage", "windage_broken")}
        values |= {port.COURSE: json.dumps(rotation.course)} if rotation.course else {}
        values |= {port.TORQUE: json.dumps(rotation.torque)} if rotation.torque else {}
    return values | loss_parameters(scenario.events, train)


def wheel_unbalances(scenario: Scenario, train: Train) -> list[tuple[float, float]]:
    """Nominal unbalance of each wheel in kg m and its phase in rad: the train's, the grade's, or its own."""
    settings = scenario.unbalance
    if settings.grade is not None:
        train = replace(train, balance_grade=settings.grade)
    own = [
        (nominal, wheel.unbalance_phase)
        for wheel, nominal in zip(train.wheels, train.nominal_unbalance, strict=True)
    ]
    given = {name: (at.unbalance, at.phase) for name, at in settings.at.items()}
    return [given.get(wheel.name, pair) for wheel, pair in zip(train.wheels, own, strict=True)]


def bearing_parameters(seat: BearingSeat, film: FilmSettings) -> Values:
    """Parameters of a bearing of any depth: geometry, oil, contact, resolution.

    Parameters
    ----------
    seat : BearingSeat
        The bearing in the train.
    film : FilmSettings
        How it is solved.

    Returns
    -------
    dict
        Values by variable name.
    """
    return {
        name: getattr(film if key in FilmSettings.model_fields else seat, key)
        for key, name in port.BEARING_KEYS.items()
    }


def offset_names() -> tuple[str, ...]:
    """Names of a bearing's offsets."""
    return tuple(f"offset.{name}" for name in port.POSITION)


def start_names(bearings: int, part: str) -> tuple[str, ...]:
    """Names of the rotor's start positions; `part` is empty, ``_cos`` or ``_sin``."""
    return tuple(
        port.at_bearing(index, f"start.{name}{part}")
        for index in range(1, bearings + 1)
        for name in port.POSITION
    )
