"""The film of a bearing at the worst instants of a record."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bearing_fmu.film_map import FilmMap, film_map
from fmus import port
from orchestrator.results.quantities import FORCE, GAP, shown
from orchestrator.results.relative_motion import PARAMETERS, film_states, parameters_at
from orchestrator.results.statistics import contact_threshold
from orchestrator.results.windows import phases

if TYPE_CHECKING:
    import xarray as xr

LED = 1.0
"""Revolutions over which a film with memory is led to the instant, along the record."""


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
        found = _film(record, bearing, index, columns, rows)
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


def _film(record: xr.Dataset, bearing: str, index: int, columns: int, rows: int) -> FilmMap | None:
    time = np.asarray(record["time"].values, dtype=float)
    step = (time[-1] - time[0]) / max(time.size - 1, 1)
    turn = 2.0 * np.pi / abs(float(record.attrs["speed"]))
    first = max(0, index - round(LED * turn / step)) if step > 0.0 else index
    depth = str(record["depth"].sel(bearing=bearing).values)
    try:
        values = parameters_at(record, bearing, float(time[index]))
        states = film_states(record, bearing, first, index)
        tilts = None
        if "pad_tilt" in record and (pads := port.pads_in(str(values[port.BEARING_KEYS["bore"]]))):
            tilts = record["pad_tilt"].sel(bearing=bearing).transpose("time", "pad").values[index, :pads]
        return film_map(depth, values, *states, columns=columns, rows=rows, step=step, tilts=tilts)
    except (ArithmeticError, KeyError, ValueError):  # of another version, or beyond what a film answers
        return None
