"""V2: the film of the aligned journal, as a depth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.contact.contact import add_aligned
from bearing_fmu.evaluate import port_kernel
from bearing_fmu.film import Film, Solver
from bearing_fmu.films.aligned.aligned import solve_aligned
from bearing_fmu.films.aligned.corner_films import (
    CHANGE,
    COLUMNS,
    FILM,
    SHARE,
    AlignedFilms,
    aligned_films,
    film_in,
)
from bearing_fmu.films.aligned.workspace import AlignedFilm
from bearing_fmu.films.corners import AWAY, SOON, SPREAD, leaving, mix, rise
from bearing_fmu.films.followed import film_of
from bearing_fmu.films.tilted.depth import SOLVER as TILTED
from bearing_fmu.films.tilted.on_layer import LAYERED, FilmOnLayer
from bearing_fmu.kernels.compiled import kernel, stage
from bearing_fmu.kernels.copied import copy
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.result import PEAK, RESULTS
from bearing_fmu.scales import Scales
from bearing_fmu.status import NO_SOLUTION, OK
from bearing_fmu.tilting.evaluate import pads_kernel
from bearing_fmu.tilting.film import TiltingFilm
from fmus.port.variable import Value

Floats = NDArray[np.float64]


@kernel
def _solve_one(
    film: AlignedFilm,
    bore: Bore,
    scales: Scales,
    q: Floats,
    v: Floats,
    speed: float,
    part: float,
    result: Floats,
) -> bool:
    """Solve one of the films; a function of its own, as in `films.tilted.solve`."""
    reynolds = scales.reynolds * abs(speed)
    return solve_aligned(
        film, bore, q, v, speed, scales.ambient, scales.feed, scales.sigma, reynolds, part, result
    )


@stage
def _solve(
    films: AlignedFilms, bore: Bore, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats
) -> int:
    usual, change = films.store[:RESULTS], films.store[CHANGE:FILM]
    share = leaving(q, v, speed, AWAY, change) if bore is None else 0.0
    films.store[SHARE] = share
    for spread in range(0 if share < 1.0 else 1, 2 if share > 0.0 else 1):
        part = SPREAD if spread == 1 else 1.0
        solved = False
        if spread == 1 and films.store.size > FILM:
            known = films.usual
            modes, half, fine = known.values.shape[0], known.weights.shape[0], known.fine.shape[0]
            film = film_in(films.store, COLUMNS, modes, half, fine)
            solved = _solve_one(film, bore, scales, q, v, speed, part, result)
        else:
            solved = _solve_one(films.usual, bore, scales, q, v, speed, part, result)
        if not solved:
            return NO_SOLUTION
        if spread == 0 and share > 0.0:
            copy(result, usual)
    if 0.0 < share < 1.0:
        peak = usual[PEAK] + rise(share, SOON)[0] * (result[PEAK] - usual[PEAK])
        mix(usual, share, change, result)
        result[PEAK] = peak
    return OK


def _prepare(parameters: BearingParameters, _space: dict[str, Any]) -> AlignedFilms:
    aspect = parameters.diameter / parameters.width
    return aligned_films(parameters.columns, parameters.rows, aspect, corners=not parameters.arcs)


SOLVER = Solver(
    name="aligned",
    kernel=port_kernel("aligned", _solve, add_aligned),
    prepare=_prepare,
    bores=True,
    pads=pads_kernel("aligned", _solve, add_aligned),
)

ON_LAYER = replace(LAYERED, name="aligned", tilts=False)
"""On a soft layer, which the pressure bends along the axis, too."""

RUPTURING = replace(TILTED, name="aligned", tilts=False, boundaries=("reynolds",))
"""With Reynolds' condition, which holds single nodes: the axial modes do not part, and V1's solver serves."""


POCKETED = replace(TILTED, name="aligned", tilts=False)
"""In a bore with pockets, which do not reach over the whole width: likewise."""


def make(values: Mapping[str, Value]) -> Film:
    """Make the film of these parameters, see `bearing_fmu.depths.Depth.film`."""
    if float(values.get("layer.thickness", 0.0)) > 0.0:
        return FilmOnLayer.of(ON_LAYER, values)
    parameters = BearingParameters.of(values)
    solver = SOLVER if parameters.boundary == "guembel" else RUPTURING
    if parameters.has_pockets:
        solver = POCKETED
    return TiltingFilm.of(solver, values) if parameters.tilts else film_of(solver, values)
