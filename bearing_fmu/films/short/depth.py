"""V3: the short bearing, as a depth."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.contact.contact import add_aligned
from bearing_fmu.evaluate import port_kernel
from bearing_fmu.film import Film, Solver
from bearing_fmu.films.followed import film_of
from bearing_fmu.films.short.flooded import short_film
from bearing_fmu.films.short.short import solve_short
from bearing_fmu.kernels.compiled import stage
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.scales import Scales
from bearing_fmu.status import OK
from fmus.port.variable import Value

Floats = NDArray[np.float64]


@stage
def _solve(
    film: Floats, _bore: Bore, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats
) -> int:
    reynolds = scales.reynolds * abs(speed)
    solve_short(q, v, speed, scales.ambient, scales.sigma, reynolds, scales.slenderness, film, result)
    return OK


def _prepare(parameters: BearingParameters, _space: dict[str, Any]) -> Floats:
    return short_film(parameters.columns)


SOLVER = Solver("short", port_kernel("short", _solve, add_aligned), _prepare)


def make(values: Mapping[str, Value]) -> Film:
    """Make the film of these parameters, see `bearing_fmu.depths.Depth.film`."""
    return film_of(SOLVER, values)
