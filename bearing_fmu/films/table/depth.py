"""Table: the film of the aligned journal, looked up, as a depth."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.contact.contact import add_aligned
from bearing_fmu.evaluate import port_kernel
from bearing_fmu.film import Film, Solver
from bearing_fmu.films.table.store import built_now, table_of
from bearing_fmu.films.table.table import Table, solve_table
from bearing_fmu.kernels.compiled import stage
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.scales import Scales
from bearing_fmu.status import OK
from fmus.port.variable import Value

Floats = NDArray[np.float64]


@stage
def _solve(
    film: Table, _bore: Bore, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats
) -> int:
    solve_table(film, q, v, speed, scales.sigma, scales.slenderness, result)
    return OK


def _prepare(parameters: BearingParameters, _space: dict[str, Any]) -> Table:
    return table_of(parameters).table()


SOLVER = Solver(
    "table", port_kernel("table", _solve, add_aligned), _prepare, boundaries=("guembel", "reynolds")
)


def _parameters(values: Mapping[str, Value]) -> BearingParameters:
    """The bearing; ValueError for what would need another table at each pressure or speed."""
    parameters = BearingParameters.of(values)
    if parameters.boundary not in SOLVER.boundaries:
        raise ValueError(
            f"bearing parameter boundary = {parameters.boundary!r}: the table film has "
            f"{' and '.join(SOLVER.boundaries)} only; use depth v1"
        )
    if parameters.arcs:
        raise ValueError(
            "bearing parameter bore: the table film knows the plain bore only; use depth v2, which solves "
            "any bore in some tens of microseconds"
        )
    if parameters.ambient_pressure > 0.0:
        raise ValueError(
            f"bearing parameter ambient_pressure = {parameters.ambient_pressure!r}: the table film knows 0 "
            "only; use depth v2"
        )
    if parameters.has_layer:
        raise ValueError(
            f"bearing parameter layer_thickness = {parameters.layer_thickness!r}: the table film knows rigid "
            "bores only; use depth v2"
        )
    if parameters.temperature == "followed":
        raise ValueError(
            "bearing parameter temperature = 'followed': the table film holds its temperature; use depth v2"
        )
    if parameters.is_turbulent:
        raise ValueError(
            f"bearing parameter turbulence = {parameters.turbulence!r}: the table film is laminar; use "
            "depth v2"
        )
    return parameters


def make(values: Mapping[str, Value]) -> Film:
    """Make the film of these parameters, see `bearing_fmu.depths.Depth.film`."""
    _parameters(values)
    film = Film.of(SOLVER, values)
    table_of(film.parameters)
    return film


def ahead(values: Mapping[str, Value]) -> str:
    """Build the table, see `bearing_fmu.depths.Depth.ahead`."""
    return built_now(_parameters(values))
