"""V1: the film between a tilted journal and its bore, as a depth."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.contact.contact import add_tilted, sliding_sense
from bearing_fmu.contact.layer import layer_table
from bearing_fmu.contact.slice import AREA, PRESSURE, WIPED
from bearing_fmu.evaluate import one_kernel, port_kernel
from bearing_fmu.film import Film, Solver
from bearing_fmu.films.corners import SPREAD, leaving, mix
from bearing_fmu.films.followed import film_of
from bearing_fmu.films.jfo.film import SOLVER as CONSERVING
from bearing_fmu.films.jfo.film import ConservingFilm
from bearing_fmu.films.tilted.layered import LayeredFilm, layered_film, solve_layered
from bearing_fmu.films.tilted.layered_tangent import add_layered_tangent
from bearing_fmu.films.tilted.reynolds import solve_pressure
from bearing_fmu.films.tilted.tangent import add_tangent
from bearing_fmu.films.tilted.workspace import STOCK, TiltedFilm, tilted_film
from bearing_fmu.kernels.compiled import stage
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.scales import Scales
from bearing_fmu.status import NO_SOLUTION, OK
from bearing_fmu.tilting.evaluate import pads_kernel
from bearing_fmu.tilting.film import TiltingFilm
from fmus.port.variable import Value

Floats = NDArray[np.float64]


@stage
def _solve(
    film: TiltedFilm, bore: Bore, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats
) -> int:
    reynolds = scales.reynolds * abs(speed)
    change, usual = film.blend[:8], film.blend[8:]
    share = leaving(q, v, speed, change) if bore is None else 0.0
    status = OK
    for spread in range(0 if share < 1.0 else 1, 2 if share > 0.0 else 1):
        part = SPREAD if spread == 1 else 1.0
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
            part,
            result,
        )
        if status != OK:
            break
        add_tangent(film, bore, q, v, speed, result)
        if spread == 0 and share > 0.0:
            usual[:] = result
    if status == OK and 0.0 < share < 1.0:
        mix(usual, share, change, result)
    return status


def _prepare(parameters: BearingParameters, space: dict[str, Any]) -> TiltedFilm:
    aspect = parameters.diameter / parameters.width
    return tilted_film(parameters.columns, parameters.rows, aspect, space)


@stage
def _solve_on_layer(
    film: LayeredFilm, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats, contact: Floats
) -> int:
    status = solve_layered(film, q, v, speed, scales.ambient, scales.sigma, result)
    if status != OK:
        return status
    grip = scales.friction * sliding_sense(speed, scales.radius)
    half = 0.5 * scales.width
    if not add_layered_tangent(film, q, v, speed, scales.ambient, grip, scales.force, half, result, contact):
        return NO_SOLUTION
    contact[PRESSURE] *= scales.hardness
    contact[AREA] *= scales.radius * half
    contact[WIPED] *= scales.radius * half
    return OK


def _prepare_on_layer(parameters: BearingParameters, space: dict[str, Any]) -> LayeredFilm:
    first, table = layer_table(parameters)
    sigma = parameters.roughness / parameters.clearance
    unit = 6.0 * parameters.viscosity * (parameters.radius / parameters.clearance) ** 2
    soft = parameters.layer_compliance * unit / parameters.clearance
    hardness = parameters.layer_hardness / unit
    return layered_film(_prepare(parameters, space), first, table, sigma, soft, hardness)


SOLVER = Solver(
    name="tilted",
    kernel=port_kernel("tilted", _solve, add_tilted),
    prepare=_prepare,
    tilts=True,
    bores=True,
    boundaries=("guembel", "reynolds"),
    stock=STOCK,
    pads=pads_kernel("tilted", _solve, add_tilted),
)


LAYERED = Solver(
    name="tilted",
    kernel=one_kernel("layered", _solve_on_layer),
    prepare=_prepare_on_layer,
    tilts=True,
    stock=STOCK,
)
"""On a soft layer, with the solid contact in its own solution."""


def make(values: Mapping[str, Value]) -> Film:
    """Make the film of these parameters, see `bearing_fmu.depths.Depth.film`."""
    if BearingParameters.of(values).tilts:
        return TiltingFilm.of(SOLVER, values)
    if values.get("film.boundary") == "jfo":
        return ConservingFilm.of(CONSERVING, values)
    return film_of(LAYERED if float(values.get("layer.thickness", 0.0)) > 0.0 else SOLVER, values)
