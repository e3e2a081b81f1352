"""V1: the film between a tilted journal and its bore, as a depth."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.contact.contact import add_tilted
from bearing_fmu.evaluate import port_kernel
from bearing_fmu.film import Film, Solver
from bearing_fmu.films.tilted.reynolds import solve_pressure
from bearing_fmu.films.tilted.tangent import add_tangent
from bearing_fmu.films.tilted.workspace import STOCK, TiltedFilm, tilted_film
from bearing_fmu.kernels.compiled import stage
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.scales import Scales
from bearing_fmu.status import OK
from fmus.port.variable import Value

Floats = NDArray[np.float64]


@stage
def _solve(
    film: TiltedFilm, bore: Bore, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats
) -> int:
    reynolds = scales.reynolds * abs(speed)
    status = solve_pressure(
        film,
        bore,
        q,
        v,
        speed,
        scales.ambient,
        scales.feed,
        scales.sigma,
        reynolds,
        scales.ruptures,
        result,
    )
    if status == OK:
        add_tangent(film, bore, q, v, speed, result)
    return status


def _prepare(parameters: BearingParameters, space: dict[str, Any]) -> TiltedFilm:
    aspect = parameters.diameter / parameters.width
    return tilted_film(parameters.columns, parameters.rows, aspect, space)


SOLVER = Solver(
    name="tilted",
    kernel=port_kernel("tilted", _solve, add_tilted),
    prepare=_prepare,
    tilts=True,
    bores=True,
    boundaries=("guembel", "reynolds"),
    stock=STOCK,
)


def make(values: Mapping[str, Value]) -> Film:
    """Make the film of these parameters, see `bearing_fmu.depths.Depth.film`."""
    return Film.of(SOLVER, values)
