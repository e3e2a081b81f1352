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
from bearing_fmu.films.tilted.corner_films import (
    CHANGE,
    COLUMNS,
    GRIDS,
    PLACE,
    RESULT,
    ROWS,
    SHARE,
    SHARP,
    SPREAD_OUT,
    TURNED,
    USUAL,
    TiltedFilms,
    film_in,
)
from bearing_fmu.films.tilted.reynolds import solve_pressure
from bearing_fmu.films.tilted.tangent import add_tangent
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.compiled import inner_kernel, kernel, stage
from bearing_fmu.kernels.copied import copy
from bearing_fmu.result import PEAK
from bearing_fmu.scales import Scales
from bearing_fmu.status import OK

Floats = NDArray[np.float64]


@inner_kernel
def _share(films: TiltedFilms, bore: Bore, scales: Scales, q: Floats, v: Floats, speed: float) -> None:
    """Shares of the films; the later ones take theirs of what the earlier ones make together."""
    shares = films.shares
    shares[:GRIDS, SHARE] = 0.0
    shares[USUAL, SHARE] = 1.0
    if bore is None:
        shares[SPREAD_OUT, SHARE] = leaving(q, v, speed, AWAY, shares[SPREAD_OUT, CHANGE:PLACE])
        if scales.ruptures == 0:
            shares[TURNED, SHARE] = turning_round(q, v, speed, shares[TURNED, CHANGE:PLACE])
        if shares[SHARP, PLACE] >= 0.0:
            shares[SHARP, SHARE], shares[SHARP, CHANGE] = crowded(q, v, speed, scales.sigma)
    if max(shares[SPREAD_OUT, SHARE], shares[TURNED, SHARE]) == 1.0:
        shares[USUAL, SHARE] = 0.0
    if shares[TURNED, SHARE] == 1.0:
        shares[SPREAD_OUT, SHARE] = 0.0


@kernel
def solve_one(
    film: TiltedFilm,
    bore: Bore,
    scales: Scales,
    q: Floats,
    v: Floats,
    speed: float,
    part: float,
    grid: int,
    result: Floats,
) -> int:
    """Solve one of the films.

    A function of its own, which is compiled once for all of them.
    """
    reynolds, lines = scales.reynolds * abs(speed), 1.0 if grid == TURNED else 0.0
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
        lines,
        result,
    )
    if status == OK and grid != SHARP:
        add_tangent(film, bore, q, v, speed, result)
    return status


@inner_kernel
def _combine(films: TiltedFilms, result: Floats) -> None:
    """Mix what was solved."""
    begun, peak = False, 0.0
    for grid in range(GRIDS):
        share = films.shares[grid, SHARE]
        if share == 0.0:
            continue
        part = rise(share, SOON)[0] if grid == SPREAD_OUT else share
        peak += (part if begun else 1.0) * (films.shares[grid, RESULT + PEAK] - peak)
        if grid == SHARP:
            continue
        if begun and share < 1.0:
            mix(result, share, films.shares[grid, CHANGE:PLACE], films.shares[grid, RESULT:])
        copy(films.shares[grid, RESULT:], result)
        begun = True
    result[PEAK] = peak


@stage
def solve_tilted(
    films: TiltedFilms, bore: Bore, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats
) -> int:
    """Solve the film, see `bearing_fmu.evaluate.port_kernel`."""
    _share(films, bore, scales, q, v, speed)
    shares, status = films.shares, OK
    for grid in range(GRIDS):
        if shares[grid, SHARE] == 0.0:
            continue
        part = SPREAD if grid == SPREAD_OUT else (shares[SHARP, CHANGE] if grid == SHARP else 1.0)
        at, found = int(shares[grid, PLACE]), films.shares[grid, RESULT:]
        if at < 0:
            status = solve_one(films.usual, bore, scales, q, v, speed, part, grid, found)
        else:
            m, n = int(shares[grid, COLUMNS]), int(shares[grid, ROWS])
            film = film_in(films.store, films.stiffness[grid], at, m, n)
            status = solve_one(film, bore, scales, q, v, speed, part, grid, found)
        if grid == SHARP:
            if status != OK:  # the peak of the usual grid is an answer, too
                shares[SHARP, SHARE], status = 0.0, OK
            break
        if status != OK:
            break
        shares[GRIDS, 0] = grid
    if status == OK:
        _combine(films, result)
    return status
