"""The record of a run: a labelled, self-describing dataset after the CF conventions.

Dimensions are time, bearing (by name), axis (x, y), coordinate (x, y, tilt_x, tilt_y) and
node (with its axial position z).  Every variable carries its unit and a long name.
"""

from __future__ import annotations

import platform
from collections.abc import Mapping
from importlib.metadata import version
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from fmus import port
from orchestrator.master.start.equilibrium import Start
from orchestrator.observers.extremes import EXTREMES
from orchestrator.observers.recorder import Recorder
from orchestrator.outcome import Outcome
from orchestrator.results.geometry import train_coordinates, train_variables
from orchestrator.scenario.events import BladeLoss
from orchestrator.scenario.file import scenario_toml
from orchestrator.scenario.scenario import Scenario
from orchestrator.scenario.schedule import Schedule, schedule_of
from rotor_fmu.train.train import Train

Array = NDArray[np.float64]
Variable = tuple[tuple[str, ...], ArrayLike, dict[str, str]]

_BEARING = ("time", "bearing")
_BEARING_AXIS = ("time", "bearing", "axis")
_SCALARS = {
    "least_gap": ("h_min", "m", "least gap over the film, negative where asperities are flattened"),
    "centre_line_gap": ("h_min_centre", "m", "least gap on the centre line"),
    "least_gap_position": ("h_min_z", "m", "axial position of the least gap, from the mid-plane"),
    "film_pressure_max": ("p_max", "Pa", "largest film pressure"),
    "contact_force": ("contact_force", "N", "solid contact force"),
    "friction_power": ("friction_power", "W", "friction power"),
    "eccentricity": ("eccentricity", "1", "relative eccentricity"),
    "sommerfeld": ("sommerfeld", "1", "Sommerfeld number"),
    "contact_pressure": ("contact_pressure", "Pa", "largest solid contact pressure"),
    "overlap": ("overlap", "m", "how deep journal and bore would overlap unloaded"),
    "wiped": ("wiped", "1", "share of the bore in which the contact reaches the softer metal's hardness"),
    "contact_area": ("contact_area", "1", "share of the bore in which solids really touch"),
    "oil_flow": ("oil_flow", "m3/s", "oil that leaves at both ends of the bearing"),
    "oil_temperature": ("oil_temperature", "K", "supply temperature and half the rise by friction"),
}
_EXTREMES = {
    "force_magnitude": ("force_magnitude_max", "N", "largest bearing force"),
    "moment_magnitude": ("moment_magnitude_max", "N m", "largest bearing moment"),
    "least_gap": ("least_gap_min", "m", "least gap"),
    "centre_line_gap": ("centre_line_gap_min", "m", "least gap on the centre line"),
    "contact_force": ("contact_force_max", "N", "largest solid contact force"),
    "contact_pressure": ("contact_pressure_max", "Pa", "largest solid contact pressure"),
    "wiped": ("wiped_max", "1", "largest share of the bore in which the contact reaches the hardness"),
    "defect": ("defect_max", "N", "largest force that the coupling neglected"),
    "step_error": (
        "step_error_max",
        "N",
        "largest error of the force from the step's length, estimated",
    ),
}
_OF_A_BORE = (
    "least_gap", "centre_line_gap", "eccentricity", "sommerfeld", "least_gap_min", "centre_line_gap_min",
    "least_gap_min_of_run", "centre_line_gap_min_of_run",
)  # fmt: skip
_SHAFT = {
    "vibration_amplitude_max": ("amplitude.max", "m", "largest vibration amplitude of the shaft"),
    "vibration_amplitude_position": ("amplitude.max_z", "m", "axial position of the largest amplitude"),
    "normal_stress_max": ("stress.max", "Pa", "largest normal stress of the shaft"),
    "normal_stress_position": ("stress.max_z", "m", "axial position of the largest normal stress"),
}


def series_names() -> tuple[str, ...]:
    """Names of the series over time at the bearings."""
    vectors = ("force", "moment", "displacement", "tilt", "velocity", "tilt_rate")
    return (*vectors, *_SCALARS, *(label for label, _, _ in _EXTREMES.values()))


def make_record(
    recorder: Recorder,
    start: Start,
    scenario: Scenario,
    train: Train,
    outcome: Outcome,
    message: str,
    provenance: Mapping[str, str],
) -> xr.Dataset:
    """Assemble the record of a run from what the recorder kept.

    Parameters
    ----------
    recorder : Recorder
        With at least the start recorded.
    start : Start
        Offsets and static line.
    scenario, train : Scenario, Train
        What was run.
    outcome, message : Outcome, str
        How it ended.
    provenance : mapping
        Identity of each FMU by file name.

    Returns
    -------
    xarray.Dataset
        Copies, independent of the recorder.
    """
    variables: dict[str, Variable] = {
        **_bearing_variables(recorder),
        **_shaft_variables(recorder),
        **_foundation_variables(recorder),
        **_rotation_variables(recorder, scenario),
        **_detail_variables(recorder, train),
        **train_variables(scenario, train),
        "offset": (("bearing", "axis"), start.offsets[:, :2], _words("m", "bearing centre")),
        "offset_tilt": (
            ("bearing", "axis"),
            start.offsets[:, 2:],
            _words("rad", "tilts of the bearing's axis"),
        ),
        "static_force": (("bearing", "axis"), start.loads, _words("N", "static bearing force on the shaft")),
        "static_line": (("node", "axis"), start.static_line, _words("m", "static line of the shaft")),
    }
    attributes = {
        **base_attributes(scenario, train, outcome, message),
        "fmus": "; ".join(f"{name} {guid}" for name, guid in provenance.items()),
    }
    record = xr.Dataset(
        {name: (dims, np.array(values), attrs) for name, (dims, values, attrs) in variables.items()},
        coords={**_time(recorder.times.copy()), **train_coordinates(scenario, train)},
        attrs=attributes,
    )
    for index, seat in enumerate(train.bearings):
        for name in () if seat.has_film else _OF_A_BORE:
            record[name][{"bearing": index}] = np.nan  # stiffness and damping have no gap
    return record


def empty_record(scenario: Scenario, train: Train, outcome: Outcome, message: str) -> xr.Dataset:
    """Record of a run that ended before its first instant: names, attributes, no time."""
    return xr.Dataset(
        coords={**_time(np.empty(0)), **train_coordinates(scenario, train)},
        attrs=base_attributes(scenario, train, outcome, message),
    )


def _bearing_variables(recorder: Recorder) -> dict[str, Variable]:
    wrench = np.stack([recorder.response(name) for name in port.FORCE], axis=-1)
    journals = recorder.journals
    vectors = {
        "force": (wrench[..., :2], "N", "bearing force on the shaft"),
        "moment": (wrench[..., 2:], "N m", "bearing moment on the shaft"),
        "displacement": (journals[..., 0:2], "m", "journal displacement at the mid-plane"),
        "tilt": (journals[..., 2:4], "rad", "rotation of the journal"),
        "velocity": (journals[..., 4:6], "m/s", "journal velocity at the mid-plane"),
        "tilt_rate": (journals[..., 6:8], "rad/s", "rate of rotation of the journal"),
    }
    result: dict[str, Variable] = {
        name: (_BEARING_AXIS, values, _words(unit, text)) for name, (values, unit, text) in vectors.items()
    }
    for name, (output, unit, text) in _SCALARS.items():
        result[name] = (_BEARING, recorder.response(output), _words(unit, text))
    for name, (label, unit, text) in _EXTREMES.items():
        since = _words(unit, f"{text} in any macro step since the record before")
        result[label] = (_BEARING, recorder.extreme(name), since)
        column = EXTREMES.index(name)
        whole = _words(unit, f"{text} in any macro step of the run")
        result[f"{label}_of_run"] = (("bearing",), recorder.peaks[:, column], whole)
        when = _words("s", f"instant: {text} of the run")
        result[f"{label}_of_run_time"] = (("bearing",), recorder.peak_times[:, column], when)
    return result


def _shaft_variables(recorder: Recorder) -> dict[str, Variable]:
    result: dict[str, Variable] = {
        name: (("time",), recorder.shaft(output), _words(unit, text))
        for name, (output, unit, text) in _SHAFT.items()
    }
    line = np.stack([recorder.field("x"), recorder.field("y")], axis=-1)
    result["deflection"] = (("time", "node", "axis"), line, _words("m", "displacement of the shaft"))
    amplitude = _words("m", "vibration amplitude of the shaft")
    result["amplitude"] = (("time", "node"), recorder.field("amplitude"), amplitude)
    stress = _words("Pa", "normal stress from bending, both planes combined")
    result["stress"] = (("time", "node"), recorder.field("stress"), stress)
    return result


def _detail_variables(recorder: Recorder, train: Train) -> dict[str, Variable]:
    """What only some films tell, where a bearing does."""
    if not recorder.has_details:
        return {}
    pads = max(port.pads_in(seat.bore) for seat in train.bearings)
    result: dict[str, Variable] = {}
    if pads:
        tilts = np.stack([recorder.detail(f"pad_tilt[{k}]") for k in range(1, pads + 1)], axis=-1)
        words = _words("rad", "tilt of the pad about its pivot, from x to y")
        result["pad_tilt"] = (("time", "bearing", "pad"), tilts, words)
    else:
        for name, unit in (("full_film", "1"), ("oil_fed", "m3/s")):
            (text,) = (v.description for v in port.BEARING_DETAILS if v.name == name)
            result[name] = (_BEARING, recorder.detail(name), _words(unit, text))
    return result


def _rotation_variables(recorder: Recorder, scenario: Scenario) -> dict[str, Variable]:
    """The speed over time where it changes."""
    words = _words("rad/s", "speed of rotation")
    return {"rotation_speed": (("time",), recorder.speeds, words)} if scenario.turns else {}


def _foundation_variables(recorder: Recorder) -> dict[str, Variable]:
    """Motion of the housings and what acts on the foundation; nothing where they stand rigidly."""
    housings, wrench = recorder.housings, recorder.foundation
    if not housings.shape[1]:
        return {}
    vectors = {
        "housing_displacement": (housings[..., 0:2], "m", "displacement of the bearing's housing"),
        "housing_tilt": (housings[..., 2:4], "rad", "rotation of the bearing's housing"),
        "housing_velocity": (housings[..., 4:6], "m/s", "velocity of the bearing's housing"),
        "foundation_force": (wrench[..., :2], "N", "force on the foundation at the bearing"),
        "foundation_moment": (wrench[..., 2:], "N m", "moment on the foundation at the bearing"),
    }
    return {name: (_BEARING_AXIS, x, _words(unit, text)) for name, (x, unit, text) in vectors.items()}


def base_attributes(scenario: Scenario, train: Train, outcome: Outcome, message: str) -> dict[str, Any]:
    """Attributes of the record: what was run, how, with which programs, and how it ended."""
    schedule = schedule_of(scenario, train)
    attributes: dict[str, Any] = {
        "Conventions": "CF-1.11",
        "title": scenario.title,
        "train": train.name,
        **schedule.attributes(),
        "coupling": scenario.coupling,
        "macro_step": scenario.step,
        **({} if scenario.tolerance is None else {"tolerance": scenario.tolerance}),
        "end_time": scenario.end,
        "reduction": scenario.reduction,
        **outcome_attributes(outcome, message),
        "scenario": scenario_toml(scenario),
        "versions": "; ".join(
            [f"python {platform.python_version()}"]
            + [f"{name} {version(name)}" for name in ("bladeloss", "fmpy", "numpy", "scipy", "numba")]
        ),
    }
    if scenario.analysed_bearing is not None:
        attributes["analysed_bearing"] = scenario.analysed_bearing
    return attributes | loss_attributes(schedule)


def loss_attributes(schedule: Schedule) -> dict[str, Any]:
    """Attributes of the record that say when and where blades broke."""
    losses = [event for event in schedule.events if isinstance(event, BladeLoss)]
    if not losses:
        return {}
    return {"fracture_time": losses[0].time, "fracture_wheel": "; ".join(loss.wheel for loss in losses)}


def outcome_attributes(outcome: Outcome, message: str) -> dict[str, Any]:
    """Attributes of the record that say how a run ended."""
    return {
        "status": outcome.value,
        "exit_status": outcome.status,
        "message": message,
        "advice": outcome.advice,
    }


def _time(times: Array) -> dict[str, Any]:
    return {"time": ("time", times, _words("s", "time"))}


def _words(unit: str, text: str) -> dict[str, str]:
    return {"units": unit, "long_name": text}
