"""Whether the films of a run are laminar: Reynolds number of the clearance against Taylor's limit."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from bearing_fmu import depths
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.train import BearingSeat, Train

_UNLOADED = 1e-3
"""Static force over the largest force in motion; of loaded bearings some 0.1 at the least."""


@dataclass(frozen=True)
class FilmRegime:
    """How the oil of one bearing flows.

    Attributes
    ----------
    bearing : str
        Its name.
    reynolds : float
        rho U C / eta, of the clearance.
    taylor : float
        Where vortices set in, 41.1 sqrt(R / C) (Taylor 1923).
    laminar : bool
        Whether its film is taken as laminar.
    unloaded : bool
        Whether it carries next to nothing of the shaft at rest: a film then has no stiffness of its own.
    """

    bearing: str
    reynolds: float
    taylor: float
    laminar: bool
    unloaded: bool = False

    @property
    def beyond(self) -> bool:
        """Whether a film that is taken as laminar is not."""
        return self.laminar and self.reynolds > self.taylor


def reynolds_number(seat: BearingSeat, speed: float) -> float:
    """Reynolds number of the clearance."""
    return seat.density * abs(speed) * 0.5 * seat.diameter * seat.clearance / seat.viscosity


def taylor_limit(seat: BearingSeat) -> float:
    """Reynolds number of the clearance from which on Taylor's vortices fill it."""
    return 41.1 * (0.5 * seat.diameter / seat.clearance) ** 0.5


def regime_coordinates(scenario: Scenario, train: Train) -> dict[str, Any]:
    """Coordinates of the record from which `regimes` reads; NaN where there is no film of bladeloss."""
    seats = train.bearings
    films = [seat.has_film and scenario.depth_of(seat.name) in depths.films() for seat in seats]
    numbers = [
        reynolds_number(seat, train.speed) if film else math.nan
        for seat, film in zip(seats, films, strict=True)
    ]
    laminar = [scenario.film.turbulence == "laminar"] * len(seats)
    return {
        "reynolds": ("bearing", numbers, {"units": "1", "long_name": "Reynolds number of the clearance"}),
        "taylor_limit": (
            "bearing",
            [taylor_limit(seat) for seat in seats],
            {"units": "1", "long_name": "Reynolds number of Taylor's vortices"},
        ),
        "laminar": ("bearing", laminar, {"long_name": "whether the film is taken as laminar"}),
    }


def regimes(record: xr.Dataset) -> tuple[FilmRegime, ...]:
    """Of every bearing of a record that has a film; empty where it does not tell."""
    if not {"reynolds", "taylor_limit", "laminar"} <= set(record.coords):
        return ()
    columns = [record[name].values for name in ("bearing", "reynolds", "taylor_limit", "laminar")]
    return tuple(
        FilmRegime(str(name), float(number), float(limit), bool(laminar), bool(bare))
        for name, number, limit, laminar, bare in zip(*columns, _unloaded(record), strict=True)
        if math.isfinite(number)
    )


def _unloaded(record: xr.Dataset) -> NDArray[np.bool_]:
    """Whether the static force of each bearing is little beside its forces in motion."""
    if not {"static_force", "force"} <= set(record.data_vars) or not record.sizes["time"]:
        return np.zeros(record.sizes["bearing"], dtype=bool)
    static = np.linalg.norm(record["static_force"].values, axis=-1)
    force = np.linalg.norm(record["force"].transpose("time", "bearing", "axis").values, axis=-1)
    return np.asarray(static < _UNLOADED * force.max(axis=0))


def regime_text(films: tuple[FilmRegime, ...]) -> str:
    """Reynolds numbers and limits in one sentence, and a warning of films that are not laminar."""
    groups: dict[tuple[int, int], list[str]] = {}
    for film in films:
        groups.setdefault((round(film.reynolds), round(film.taylor)), []).append(film.bearing)
    text = "Reynolds number (Taylor's limit) " + "; ".join(
        f"{number} ({limit}) at {', '.join(names)}" for (number, limit), names in groups.items()
    )
    bare = [film.bearing for film in films if film.unloaded]
    if bare:
        text += (
            f". {', '.join(bare)}: next to no static load, so that the film has hardly any stiffness and the "
            "journal may whirl at half the speed"
        )
    count = sum(film.beyond for film in films)
    if count:
        text += (
            f". WARNING: {count} of {len(films)} films are beyond the limit, but taken as laminar; "
            'film.turbulence = "constantinescu" shows what that changes'
        )
    return text
