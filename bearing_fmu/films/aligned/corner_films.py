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
    values = store[at : at + r]
    at += r
    drive = store[at : at + r]
    at += r
    shapes = store[at : at + h * r].reshape((h, r))
    at += h * r
    fine = store[at : at + f * r].reshape((f, r))
    at += f * r
    outflow = store[at : at + (r + 1)]
    at += r + 1
    weights = store[at : at + h]
    at += h
    circle = store[at : at + 2 * 2 * m].reshape((2, 2, m))
    at += 2 * 2 * m
    rings = store[at : at + 2 * RING_ROWS * m].reshape((2, RING_ROWS, m))
    at += 2 * RING_ROWS * m
    grading = store[at : at + 7 * 4].reshape((7, 4))
    at += 7 * 4
    fields = store[at : at + 2 * FIELDS * m].reshape((2, FIELDS, m))
    at += 2 * FIELDS * m
    nodal = store[at : at + h * 4 * m].reshape((h, 4, m))
    at += h * 4 * m
    modal = store[at : at + 3 * m * r].reshape((3, m, r))
    at += 3 * m * r
    factor = store[at : at + m * 2 * r].reshape((m, 2, r))
    at += m * 2 * r
    forcing = store[at : at + 8 * m].reshape((8, m))
    at += 8 * m
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
    parts = [np.zeros(FILM)]
    if corners and columns < COLUMNS:
        parts += [field.ravel() for field in aligned_film(COLUMNS, rows, aspect)]
    return AlignedFilms(aligned_film(columns, rows, aspect), np.concatenate(parts))


def served(films: AlignedFilms) -> AlignedFilm:
    """The film that was solved last."""
    if films.store[SHARE] == 0.0 or films.store.size == FILM:
        return films.usual
    usual = films.usual
    unpack = film_in.py_func  # type: ignore[attr-defined]
    return unpack(films.store, COLUMNS, usual.values.size, usual.weights.size, usual.fine.shape[0])
