"""How a journal moves in its bore: less what the bore itself does, which sinks or stands on a housing."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fmus import port
from orchestrator.scenario.events import Change
from orchestrator.scenario.schedule import from_attributes

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]

PARAMETERS = "bearing_parameters"
"""Of a record: what the unit of each bearing was given, as JSON."""
_WIDEST = 3.0
"""Clearances up to which the room of a journal is drawn; beyond, a bore is open."""


def parameters_at(record: xr.Dataset, bearing: str, time: float) -> dict[str, Any]:
    """What the unit of a bearing was given, with what changed until an instant [s]; empty where not recorded.

    A followed temperature of the oil is taken from the record, and held.
    """
    if PARAMETERS not in record:
        return {}
    values: dict[str, Any] = json.loads(str(record[PARAMETERS].sel(bearing=bearing).values))
    for event in changes(record, bearing):
        if event.time <= time and event.variable in values:
            values[event.variable] = _changed(event, values[event.variable])
    if values.get("film.temperature") == "followed" and "oil_temperature" in record:
        oil = port.Oil(values["oil.viscosity_40"], values["oil.viscosity_100"])
        now = float(record["oil_temperature"].sel(bearing=bearing).sel(time=time, method="nearest"))
        values |= {"film.temperature": "held", "viscosity": oil.dynamic(now, values["density"])}
    return values


def changes(record: xr.Dataset, bearing: str) -> list[Change]:
    """What is changed of a bearing in a run, in order."""
    found = from_attributes(record.attrs).events
    return [event for event in found if isinstance(event, Change) and event.bearing == bearing]


def _changed(event: Change, value: float) -> float:
    return event.value if event.value is not None else value + (event.by or 0.0)


def bore_motion(record: xr.Dataset, bearing: str) -> Floats:
    """Where the bore of a bearing is, shape (n, 4): x, y in m and tilts in rad."""
    one = record.sel(bearing=bearing)
    places = np.zeros((record.sizes["time"], 4))
    time = np.asarray(record["time"].values, dtype=float)
    for k, name in enumerate(port.POSITION):
        kept, axis = ("offset", "offset_tilt")[k // 2], k % 2
        places[:, k] = float(one[kept].isel(axis=axis)) if kept in record else 0.0
        for event in changes(record, bearing):
            if event.parameter == f"offset.{name}":
                later = time >= event.time
                places[later, k] = _changed(event, float(places[later, k][0])) if later.any() else 0.0
    for part, kept in ((slice(0, 2), "housing_displacement"), (slice(2, 4), "housing_tilt")):
        if kept in record:
            places[:, part] += one[kept].transpose("time", "axis").values
    return places


def journal_motion(record: xr.Dataset, bearing: str) -> Floats:
    """Journal from the centre of its bore, shape (2, time), in m."""
    moved = record["displacement"].sel(bearing=bearing).transpose("axis", "time").values
    return np.asarray(moved - bore_motion(record, bearing).T[:2], dtype=float)


def film_states(record: xr.Dataset, bearing: str, first: int, last: int) -> tuple[Floats, Floats, Floats]:
    """What a film sees in the samples from `first` to `last`, both included.

    Returns
    -------
    position, velocity : ndarray, shape (n, 4)
        Of the journal in its bore: x, y and tilts, m and rad; their rates.
    speed : ndarray, shape (n,)
        Of rotation in rad/s.
    """
    one = record.sel(bearing=bearing)
    names = (("displacement", "tilt"), ("velocity", "tilt_rate"))
    position, velocity = (
        np.concatenate([one[name].transpose("time", "axis").values for name in pair], axis=1)
        for pair in names
    )
    bore = bore_motion(record, bearing)
    if "housing_velocity" in record:
        velocity[:, :2] -= one["housing_velocity"].transpose("time", "axis").values
        velocity[:, 2:] -= np.gradient(bore[:, 2:], one["time"].values, axis=0)
    changing = "rotation_speed" in record
    speed = one["rotation_speed"].values if changing else np.full(len(bore), float(one["rotor_speed"]))
    chosen = slice(first, last + 1)
    return (position - bore)[chosen], velocity[chosen], np.asarray(speed, dtype=float)[chosen]


def room_of(record: xr.Dataset, bearing: str, points: int = 181) -> Floats | None:
    """Contour within which the journal's centre can move without tilt, from the bore's centre.

    Of a plain bore the circle of the radial clearance, of lobes arcs of circles, of tilting pads on rigid
    pivots a polygon. Not-a-number where the bore is open.

    Returns
    -------
    ndarray, shape (2, points), or None
        In m; None of a bearing without a bore.
    """
    clearance = float(record["bearing_clearance"].sel(bearing=bearing))
    if not clearance > 0.0:
        return None
    text = ""
    if PARAMETERS in record:
        text = str(json.loads(str(record[PARAMETERS].sel(bearing=bearing).values)).get("bore", ""))
    angles = np.linspace(0.0, 2.0 * math.pi, points)
    reach = np.array([port.room_in(text, float(angle)) for angle in angles])
    reach[reach > _WIDEST] = math.nan
    return clearance * reach * np.array([np.cos(angles), np.sin(angles)])
