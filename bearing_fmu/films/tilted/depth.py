"""V1: the film between a tilted journal and its bore, as a depth."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bearing_fmu.contact.contact import add_tilted
from bearing_fmu.evaluate import port_kernel
from bearing_fmu.film import Film, Solver
from bearing_fmu.films.followed import film_of
from bearing_fmu.films.jfo.film import SOLVER as CONSERVING
from bearing_fmu.films.jfo.film import ConservingFilm
from bearing_fmu.films.tilted.corner_films import TiltedFilms, tilted_films
from bearing_fmu.films.tilted.on_layer import LAYERED, FilmOnLayer
from bearing_fmu.films.tilted.solve import solve_tilted
from bearing_fmu.films.tilted.workspace import STOCK
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.tilting.evaluate import pads_kernel
from bearing_fmu.tilting.film import TiltingFilm
from fmus.port.variable import Value


def _prepare(parameters: BearingParameters, space: dict[str, Any]) -> TiltedFilms:
    aspect = parameters.diameter / parameters.width
    return tilted_films(parameters.columns, parameters.rows, aspect, space, corners=not parameters.arcs)


SOLVER = Solver(
    name="tilted",
    kernel=port_kernel("tilted", solve_tilted, add_tilted),
    prepare=_prepare,
    tilts=True,
    bores=True,
    boundaries=("guembel", "reynolds"),
    stock=STOCK,
    pads=pads_kernel("tilted", solve_tilted, add_tilted),
)


def make(values: Mapping[str, Value]) -> Film:
    """Make the film of these parameters, see `bearing_fmu.depths.Depth.film`."""
    if BearingParameters.of(values).tilts:
        return TiltingFilm.of(SOLVER, values)
    if values.get("film.boundary") == "jfo":
        return ConservingFilm.of(CONSERVING, values)
    if float(values.get("layer.thickness", 0.0)) > 0.0:
        return FilmOnLayer.of(LAYERED, values)
    return film_of(SOLVER, values)
