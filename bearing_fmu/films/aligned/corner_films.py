"""The films of one bearing at depth V2: the usual one, and that of journals that leave the wall.

The latter comes in one array, as those of V1, see `films.tilted.corner_films`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.aligned.workspace import AlignedFilm, aligned_film
from bearing_fmu.kernels.compiled import stage
from bearing_fmu.kernels.grid import RING_ROWS
from bearing_fmu.kernels.store import block, line, plane, put_away, views
from bearing_fmu.result import FIELDS, RESULTS

Floats = NDArray[np.float64]

#: Where the parts of the store begin.
SHARE, CHANGE, FILM = RESULTS, RESULTS + 1, RESULTS + 9
#: Least columns of the film of journals that leave the wall, see `films.corners`.
COLUMNS = 64


class AlignedFilms(NamedTuple):
    """The films of one bearing."""

    usual: AlignedFilm
    store: Floats  #: result of the usual film, share of the other one, its change by q and v; then the other
    # one, field after field, where it is not the usual one


@stage
def film_in(store: Floats, m: int, r: int, h: int, f: int) -> AlignedFilm:
    """The film of m columns in a store; r even modes, h rows with z >= 0, f lines between them."""
    at = FILM
    values, at = line(store, at, r)
    drive, at = line(store, at, r)
    shapes, at = plane(store, at, h, r)
    fine, at = plane(store, at, f, r)
    outflow, at = line(store, at, r + 1)
    weights, at = line(store, at, h)
    circle, at = block(store, at, 2, 2, m)
    rings, at = block(store, at, 2, RING_ROWS, m)
    grading, at = plane(store, at, 7, 4)
    fields, at = block(store, at, 2, FIELDS, m)
    nodal, at = block(store, at, h, 4, m)
    modal, at = block(store, at, 3, m, r)
    factor, at = block(store, at, m, 2, r)
    forcing, at = plane(store, at, 8, m)
    return AlignedFilm(
        values,
        drive,
        shapes,
        fine,
        outflow,
        weights,
        circle,
        rings,
        grading,
        fields,
        nodal,
        modal,
        factor,
        forcing,
    )


def aligned_films(columns: int, rows: int, aspect: float, *, corners: bool = True) -> AlignedFilms:
    """Prepare the films of a bearing, see `aligned_film`; without `corners` the usual one is both."""
    store = np.zeros(FILM)
    if corners and columns < COLUMNS:
        store = np.append(store, put_away(aligned_film(COLUMNS, rows, aspect)))
    return AlignedFilms(aligned_film(columns, rows, aspect), store)


def served(films: AlignedFilms) -> AlignedFilm:
    """The film that was solved last."""
    if films.store[SHARE] == 0.0 or films.store.size == FILM:
        return films.usual
    rows = films.usual.fine.shape[0] // 2
    return AlignedFilm(*views(films.store, FILM, aligned_film(COLUMNS, rows, 1.0)))
