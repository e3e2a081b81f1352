"""V1 in a rigid bore: pressure and tangent, on the grids that serve."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.films.corners import SPREAD, leaving, mix
from bearing_fmu.films.tilted.reynolds import solve_pressure
from bearing_fmu.films.tilted.tangent import add_tangent
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.compiled import stage
from bearing_fmu.kernels.copied import copy
from bearing_fmu.scales import Scales
from bearing_fmu.status import OK

Floats = NDArray[np.float64]


@stage
def solve_tilted(
    film: TiltedFilm, bore: Bore, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats
) -> int:
    """Solve the film, see `bearing_fmu.evaluate.port_kernel`."""
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
            copy(result, usual)
    if status == OK and 0.0 < share < 1.0:
        mix(usual, share, change, result)
    return status
