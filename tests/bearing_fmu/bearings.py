"""Bearings and reference tables of these tests."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from bearing_fmu.film import BearingResponse, Film, make_film
from bearing_fmu.parameters import BearingParameters

_REFERENCE = Path(__file__).parent / "reference"

TURBINE = BearingParameters(
    diameter=0.80,
    width=0.64,
    clearance=8.62e-4,
    viscosity=0.0242,
    ambient_pressure=0.0,
    roughness=3e-6,
    contact_modulus=1e9,
    friction=0.1,
)
SPEED = 50.0 * np.pi


def table(name: str) -> list[dict[str, str]]:
    """Rows of a reference file; its comment lines name the source."""
    with (_REFERENCE / name).open(newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def plain(aspect: float, **changes) -> BearingParameters:
    """A smooth bearing with b/d = `aspect`, radius 0.5 m, clearance 1 mm, viscosity 1 Pa s."""
    values = {"diameter": 1.0, "width": aspect, "clearance": 1e-3, "viscosity": 1.0} | changes
    return BearingParameters(**values)


def lever(parameters: BearingParameters) -> np.ndarray:
    """Units of position that move the bearing's edge by one clearance."""
    half = 0.5 * parameters.width
    return parameters.clearance * np.array([1.0, 1.0, 1.0 / half, 1.0 / half])


def respond(film: Film, q, v=(0.0, 0.0, 0.0, 0.0), speed: float = 1.0) -> BearingResponse:
    """Response at a position over the clearance and a velocity over clearance and speed."""
    units = lever(film.parameters)
    return film.respond(np.asarray(q) * units, np.asarray(v) * units * abs(speed), speed)


def force_unit(parameters: BearingParameters, speed: float = 1.0) -> np.ndarray:
    """Eta omega R (b/2) (R/C)^2, for moments times b/2."""
    force = parameters.viscosity * speed * parameters.radius * 0.5 * parameters.width
    force *= (parameters.radius / parameters.clearance) ** 2
    return force * np.array([1.0, 1.0, 0.5 * parameters.width, 0.5 * parameters.width])


def v(depth: str, parameters: BearingParameters = TURBINE) -> Film:
    """Film of a depth."""
    return make_film(depth, parameters)
