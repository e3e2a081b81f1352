"""V1 in a rigid bore: pressure and tangent, on the grids that serve.

The usual grid serves most states.  Others have a grid of their own, see `films.corners`: the less graded one
of a journal that leaves the wall, and the one on which the positive part is cut on lines.  A pressure that
crowds at an end is solved once more for its peak alone.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.films.corners import AWAY, SOON, SPREAD, crowded, leaving, mix, rise, turning_round
from bearing_fmu.films.tilted.reynolds import solve_pressure
from bearing_fmu.films.tilted.tangent import add_tangent
from bearing_fmu.films.tilted.workspace import GRIDS, SHARP, SPREAD_OUT, TURNED, USUAL, TiltedFilms
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.copied import copy
from bearing_fmu.result import PEAK
from bearing_fmu.scales import Scales
from bearing_fmu.status import OK

Floats = NDArray[np.float64]


@inner_kernel
def _share(films: TiltedFilms, bore: Bore, scales: Scales, q: Floats, v: Floats, speed: float) -> None:
    """Shares of the films; the later ones take theirs of what the earlier ones make together."""
    films.shares[:] = 0.0
    films.shares[USUAL, 0] = 1.0
    if bore is None:
        spread, turned = films.shares[SPREAD_OUT], films.shares[TURNED]
        spread[0] = leaving(q, v, speed, AWAY, spread[1:])
        if scales.ruptures == 0:
            turned[0] = turning_round(q, v, speed, turned[1:])
        if films.sharp.nodes.shape[0] > films.usual.nodes.shape[0]:
            sharp = films.shares[SHARP]
            sharp[0], sharp[1] = crowded(q, v, speed)
    if max(films.shares[SPREAD_OUT, 0], films.shares[TURNED, 0]) == 1.0:
        films.shares[USUAL, 0] = 0.0
    if films.shares[TURNED, 0] == 1.0:
        films.shares[SPREAD_OUT, 0] = 0.0


@inner_kernel
def _combine(films: TiltedFilms, result: Floats) -> None:
    """Mix what was solved."""
    begun, peak = False, 0.0
    for grid in range(GRIDS):
        share = films.shares[grid, 0]
        if share == 0.0:
            continue
        part = rise(share, SOON)[0] if grid == SPREAD_OUT else share
        peak += (part if begun else 1.0) * (films.results[grid, PEAK] - peak)
        if grid == SHARP:
            continue
        if begun and share < 1.0:
            mix(result, share, films.shares[grid, 1:], films.results[grid])
        copy(films.results[grid], result)
        begun = True
    result[PEAK] = peak


@stage
def solve_tilted(
    films: TiltedFilms, bore: Bore, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats
) -> int:
    """Solve the film, see `bearing_fmu.evaluate.port_kernel`."""
    reynolds = scales.reynolds * abs(speed)
    _share(films, bore, scales, q, v, speed)
    shares, status = films.shares, OK
    for grid in range(GRIDS):
        if shares[grid, 0] == 0.0:
            continue
        film, part = films.usual, 1.0
        if grid == SPREAD_OUT:
            film, part = films.spread, SPREAD
        elif grid == TURNED:
            film = films.turned
        elif grid == SHARP:
            film, part = films.sharp, shares[SHARP, 1]
        found = films.results[grid]
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
            1.0 if grid == TURNED else 0.0,
            found,
        )
        if grid == SHARP:
            if status != OK:  # the peak of the usual grid is an answer, too
                shares[SHARP, 0], status = 0.0, OK
            break
        if status != OK:
            break
        films.served[0] = grid
        add_tangent(film, bore, q, v, speed, found)
    if status == OK:
        _combine(films, result)
    return status
