"""The film of a bearing at the worst instants of a record."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bearing_fmu.film_map import FilmMap, film_map
from fmus import port
from orchestrator.results.quantities import FORCE, GAP, shown
from orchestrator.results.statistics import contact_threshold
from orchestrator.results.windows import phases

if TYPE_CHECKING:
    import xarray as xr

PARAMETERS = "bearing_parameters"
"""Of a record: what the unit of each bearing was given, as JSON."""


@dataclass(frozen=True)
class WorstFilm:
    """A film at one instant.

    Attributes
    ----------
    name : str
        Why this instant: least gap, largest force, largest contact force.
    text : str
        The figure that makes it the worst.
    time : float
        Instant in s.
    film : FilmMap
        Pressure and gap.
    """

    name: str
    text: str
    time: float
    film: FilmMap


def worst_films(
    record: xr.Dataset, bearing: str, *, columns: int = 121, rows: int = 25
) -> Iterator[WorstFilm]:
    """The film of a bearing where its gap is least, its force largest, its contact hardest.

    Of instants that were recorded; those that coincide come once. None of a record that does not hold the
    bearing's parameters, and of a bearing whose film cannot be drawn.
    """
    if PARAMETERS not in record or "tilt" not in record or "offset_tilt" not in record:
        return
    one = record.sel(bearing=bearing)
    told: set[int] = set()
    for name, text, index in _instants(record, one, bearing):
        if index in told:
            continue
        told.add(index)
        found = _film(one, index, columns, rows)
        if found is None:
            return
        yield WorstFilm(name, text, float(record["time"].values[index]), found)


def _instants(record: xr.Dataset, one: xr.Dataset, bearing: str) -> Iterator[tuple[str, str, int]]:
    gap = np.asarray(one["least_gap"].values, dtype=float)
    if np.isnan(gap).all():  # without a bore
        return
    at = int(np.nanargmin(gap))
    yield "least gap", GAP.text(float(gap[at])), at
    force = np.hypot(*one["force"].transpose("axis", "time").values)
    at = int(np.argmax(force))
    yield "largest force", shown(float(force[at]), FORCE), at
    contact = np.asarray(one["contact_force"].values, dtype=float)
    at = int(np.argmax(contact))
    if contact[at] > contact_threshold(record, bearing, phases(record)):
        yield "hardest contact", shown(float(contact[at]), FORCE), at


def _film(one: xr.Dataset, index: int, columns: int, rows: int) -> FilmMap | None:
    values = json.loads(str(one[PARAMETERS].values))
    now = one.isel(time=index)
    q = np.concatenate([now["displacement"] - now["offset"], now["tilt"] - now["offset_tilt"]])
    v = np.concatenate([now["velocity"], now["tilt_rate"]])
    speed = float(now["rotation_speed" if "rotation_speed" in now else "rotor_speed"])
    tilts = (
        now["pad_tilt"].values[: port.pads_in(str(values[port.BEARING_KEYS["bore"]]))]
        if "pad_tilt" in now
        else None
    )
    try:
        return film_map(
            str(one["depth"].values), values, q, v, speed, columns=columns, rows=rows, tilts=tilts
        )
    except (ArithmeticError, KeyError, ValueError):  # of another version, or beyond what a film answers
        return None
