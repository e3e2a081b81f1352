"""The films of one bearing at depth V1: the usual one, and those of the corners of accuracy.

What comes to a kernel from Python costs time, an array a five hundredth of an evaluation.  So the films of
the corners come in one array, and are put together where they are needed.  Bearings of one resolution share
that array with their work space; but for the axial stiffness it is the same for all of them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.tilted.workspace import LINES, TiltedFilm, tilted_film, work_space
from bearing_fmu.kernels.compiled import stage
from bearing_fmu.kernels.grid import RING_ROWS
from bearing_fmu.kernels.store import block, line, plane, put_away, views
from bearing_fmu.kernels.vector import LANES
from bearing_fmu.result import FIELDS, RESULTS

Floats = NDArray[np.float64]

#: The films: the usual one, that of journals that leave the wall, that of journals whose drive turns round
#: between the ends, and that on which a peak is looked for that crowds at an end.
USUAL, SPREAD_OUT, TURNED, SHARP, GRIDS = range(5)
#: Least columns and rows of those beside the usual one; 0 for those of the latter.
CORNERS = {SPREAD_OUT: (64, 0), TURNED: (64, 10), SHARP: (64, 12)}
_SHARP_CLUSTERING = 2.0
_STORE = "corners"  #: in a work space
#: Columns of `TiltedFilms.shares`: share of each film, its change by q and v, where the film stands in the
#: store, -1 for the usual one, its columns and rows, and its result.
SHARE, CHANGE, PLACE, COLUMNS, ROWS, RESULT = 0, 1, 9, 10, 11, 12


class TiltedFilms(NamedTuple):
    """The films of one bearing."""

    usual: TiltedFilm
    store: Floats  #: the others, see `film_in`
    stiffness: Floats  #: (GRIDS, n + 2 and more) of each of them, see `TiltedFilm`
    shares: Floats  #: (GRIDS + 1, RESULT + RESULTS) of each; the last row begins with the film solved last


@stage
def film_in(store: Floats, stiffness: Floats, at: int, m: int, n: int) -> TiltedFilm:
    """The film of m columns and n rows that stands in a store from `at` on, field after field."""
    length, width = LANES * -(-m // LANES), LANES * -(-n // LANES)
    nodes, at = line(store, at, n + 2)
    weights, at = line(store, at, n + 2)
    _, at = line(store, at, n + 2)
    slopes, at = line(store, at, (n + 2) * n)
    products, at = line(store, at, (n + 2) * n * width)
    fine, at = plane(store, at, 4 * n, n)
    ends, at = plane(store, at, 2, n + 2)
    lines, at = plane(store, at, LINES * n, n)
    back, at = plane(store, at, LINES * n, n)
    circle, at = block(store, at, 2, 2, m)
    held, at = plane(store, at, n, length)
    rings, at = block(store, at, 2, RING_ROWS, m)
    grading, at = plane(store, at, 7, 4)
    column, at = block(store, at, FIELDS, n + 2, length)
    face, at = block(store, at, FIELDS, n, length)
    nodal, at = block(store, at, 4, n, length)
    cuts, at = block(store, at, LINES * n, 4, length)
    mixed, at = line(store, at, 1)
    pressures, at = block(store, at, 5, 3 * n + 2, length)
    forcing, at = block(store, at, 6, 3 * n + 2, length)
    blocks, at = plane(store, at, 3, m * n * width)
    coupling, at = line(store, at, m * width)
    sides, at = line(store, at, 4 * m * width)
    inner, at = line(store, at, n * width)
    row, at = line(store, at, 8 * width)
    blend, at = line(store, at, 8)
    return TiltedFilm(
        nodes,
        weights,
        stiffness[: n + 2],
        slopes,
        products,
        fine,
        ends,
        lines,
        back,
        circle,
        held,
        rings,
        grading,
        column,
        face,
        nodal,
        cuts,
        mixed,
        pressures,
        forcing,
        blocks,
        coupling,
        sides,
        inner,
        row,
        blend,
    )


def tilted_films(
    columns: int, rows: int, aspect: float, space: dict[str, Floats], *, corners: bool = True
) -> TiltedFilms:
    """Prepare the films of a bearing, see `tilted_film`; without `corners` the usual one is all of them."""
    shares, parts, at = np.zeros((GRIDS + 1, RESULT + RESULTS)), [np.zeros(0)], 0
    stiffness = np.zeros((GRIDS, max(rows, *(least for _, least in CORNERS.values())) + 2))
    shares[:GRIDS, PLACE] = -1.0
    for film, (least_columns, least_rows) in CORNERS.items():
        grid = max(columns, least_columns), max(rows, least_rows)
        if not corners or grid == (columns, rows) or (film == SHARP and grid[1] == rows):
            continue
        clustering = (_SHARP_CLUSTERING,) if film == SHARP else ()
        corner = tilted_film(*grid, aspect, work_space(*grid), *clustering)
        parts.append(put_away(corner))
        stiffness[film, : grid[1] + 2] = corner.stiffness
        shares[film, PLACE:RESULT] = at, *grid
        at += parts[-1].size
    usual = tilted_film(columns, rows, aspect, space)
    store = space.setdefault(_STORE, np.concatenate(parts)) if corners else parts[0]
    return TiltedFilms(usual, store, stiffness, shares)


def served(films: TiltedFilms) -> TiltedFilm:
    """The film that was solved last."""
    grid = int(films.shares[GRIDS, 0])
    at, columns, rows = (int(number) for number in films.shares[grid, PLACE:RESULT])
    if at < 0:
        return films.usual
    film = TiltedFilm(*views(films.store, at, tilted_film(columns, rows, 1.0, work_space(columns, rows))))
    return film._replace(stiffness=films.stiffness[grid, : rows + 2])
