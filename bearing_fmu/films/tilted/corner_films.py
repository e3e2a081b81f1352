"""The films of one bearing at depth V1: the usual one, and those of the corners of accuracy.

What comes to a kernel from Python costs time, an array a five hundredth of an evaluation.  So the films of
the corners come in one array, and are put together where they are needed.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.tilted.workspace import LINES, TiltedFilm, tilted_film, work_space
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.grid import RING_ROWS
from bearing_fmu.kernels.vector import LANES
from bearing_fmu.result import FIELDS, RESULTS

Floats = NDArray[np.float64]

#: The films: the usual one, that of journals that leave the wall, that of journals whose drive turns round
#: between the ends, and that on which a peak is looked for that crowds at an end.
USUAL, SPREAD_OUT, TURNED, SHARP, GRIDS = range(5)
#: Least columns and rows of those beside the usual one; 0 for those of the latter.
CORNERS = {SPREAD_OUT: (64, 0), TURNED: (64, 10), SHARP: (64, 12)}
_SHARP_CLUSTERING = 2.0
#: Columns of `TiltedFilms.shares`: share of each film, its change by q and v, where the film stands in the
#: store, -1 for the usual one, its columns and rows, and its result.
SHARE, CHANGE, PLACE, COLUMNS, ROWS, RESULT = 0, 1, 9, 10, 11, 12


class TiltedFilms(NamedTuple):
    """The films of one bearing."""

    usual: TiltedFilm
    store: Floats  #: the others, see `film_in`
    shares: Floats  #: (GRIDS + 1, RESULT + RESULTS) of each; the last row begins with the film solved last


@inner_kernel
def _room(size: int) -> int:
    """What an array takes in the store."""
    return LANES * -(-size // LANES)


@stage
def film_in(store: Floats, at: int, m: int, n: int) -> TiltedFilm:
    """The film of m columns and n rows that stands in a store from `at` on, field after field."""
    length, width = _room(m), _room(n)
    nodes = store[at : at + (n + 2)]
    at += _room(n + 2)
    weights = store[at : at + (n + 2)]
    at += _room(n + 2)
    stiffness = store[at : at + (n + 2)]
    at += _room(n + 2)
    slopes = store[at : at + ((n + 2) * n)]
    at += _room((n + 2) * n)
    products = store[at : at + ((n + 2) * n * width)]
    at += _room((n + 2) * n * width)
    fine = store[at : at + (4 * n) * n].reshape((4 * n, n))
    at += _room((4 * n) * n)
    ends = store[at : at + 2 * (n + 2)].reshape((2, n + 2))
    at += _room(2 * (n + 2))
    lines = store[at : at + (LINES * n) * n].reshape((LINES * n, n))
    at += _room((LINES * n) * n)
    back = store[at : at + (LINES * n) * n].reshape((LINES * n, n))
    at += _room((LINES * n) * n)
    circle = store[at : at + 2 * 2 * m].reshape((2, 2, m))
    at += _room(2 * 2 * m)
    held = store[at : at + n * length].reshape((n, length))
    at += _room(n * length)
    rings = store[at : at + 2 * RING_ROWS * m].reshape((2, RING_ROWS, m))
    at += _room(2 * RING_ROWS * m)
    grading = store[at : at + 7 * 4].reshape((7, 4))
    at += _room(7 * 4)
    column = store[at : at + FIELDS * (n + 2) * length].reshape((FIELDS, n + 2, length))
    at += _room(FIELDS * (n + 2) * length)
    face = store[at : at + FIELDS * n * length].reshape((FIELDS, n, length))
    at += _room(FIELDS * n * length)
    nodal = store[at : at + 4 * n * length].reshape((4, n, length))
    at += _room(4 * n * length)
    cuts = store[at : at + (LINES * n) * 4 * length].reshape((LINES * n, 4, length))
    at += _room((LINES * n) * 4 * length)
    mixed = store[at : at + 1]
    at += _room(1)
    pressures = store[at : at + 5 * (3 * n + 2) * length].reshape((5, 3 * n + 2, length))
    at += _room(5 * (3 * n + 2) * length)
    forcing = store[at : at + 6 * (3 * n + 2) * length].reshape((6, 3 * n + 2, length))
    at += _room(6 * (3 * n + 2) * length)
    blocks = store[at : at + 3 * (m * n * width)].reshape((3, m * n * width))
    at += _room(3 * (m * n * width))
    coupling = store[at : at + m * width]
    at += _room(m * width)
    sides = store[at : at + 4 * m * width]
    at += _room(4 * m * width)
    block = store[at : at + n * width]
    at += _room(n * width)
    row = store[at : at + 8 * width]
    at += _room(8 * width)
    blend = store[at : at + 8]
    at += _room(8)
    return TiltedFilm(
        nodes,
        weights,
        stiffness,
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
        block,
        row,
        blend,
    )


def tilted_films(
    columns: int, rows: int, aspect: float, space: dict[str, Floats], *, corners: bool = True
) -> TiltedFilms:
    """Prepare the films of a bearing, see `tilted_film`; without `corners` the usual one is all of them."""
    shares, parts, at = np.zeros((GRIDS + 1, RESULT + RESULTS)), [np.zeros(0)], 0
    shares[:GRIDS, PLACE] = -1.0
    for film, (least_columns, least_rows) in CORNERS.items():
        grid = max(columns, least_columns), max(rows, least_rows)
        if not corners or grid == (columns, rows) or (film == SHARP and grid[1] == rows):
            continue
        clustering = (_SHARP_CLUSTERING,) if film == SHARP else ()
        for field in tilted_film(*grid, aspect, work_space(*grid), *clustering):
            parts.append(np.append(field, np.zeros(-field.size % LANES)))
        shares[film, PLACE:RESULT] = at, *grid
        at = sum(part.size for part in parts)
    usual = tilted_film(columns, rows, aspect, space)
    return TiltedFilms(usual, np.concatenate(parts), shares)


def served(films: TiltedFilms) -> TiltedFilm:
    """The film that was solved last."""
    at, columns, rows = (int(number) for number in films.shares[int(films.shares[GRIDS, 0]), PLACE:RESULT])
    unpack = film_in.py_func  # type: ignore[attr-defined]
    return films.usual if at < 0 else unpack(films.store, at, columns, rows)
