"""Work space and layout of the mass-conserving film."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.jfo.network import CONTENT, FREE, PRESSURE, Network, network
from bearing_fmu.films.tilted.workspace import TiltedFilm, tilted_film
from bearing_fmu.kernels.axial import axial_basis
from bearing_fmu.kernels.vector import padded
from bearing_fmu.result import FIELDS

Floats = NDArray[np.float64]

#: What is remembered of a cell: its volume, the void in it, and what is owed to it, see `content`.
VOLUME, VOID, OWED, KEPT = range(4)

#: Before the cells stand the content of the grooves and the angles of the faces.
GROOVE, FACES = 0, 1

#: Length of the step in s, 0 for a film in balance; share paid back of what is owed; 2/dt.
STEP, PAID, RATE = range(3)

#: Flow over the ends, flow from the grooves, share of full cells; flows over C R b/4.
ENDS, FEED, FULL = range(3)


class JfoFilm(NamedTuple):
    """A film of n rows and m columns, and what it remembers."""

    film: TiltedFilm  #: grid, gap, conductances around
    net: Network
    heights: Floats  #: (n + 1,) z of the axial faces
    spans: Floats  #: (n + 1,) distances over which the pressure falls across them, over (2R/b)^2
    across: Floats  #: (FIELDS, n + 1, m') gap and conductance at the axial faces
    volumes: Floats  #: (n, m) of the cells now
    rates: Floats  #: (n, m) what a cell has of the rate of its gap, see `reynolds`
    share: Floats  #: (n, m) content that counts as squeezed, see `reynolds`
    before: Floats  #: (KEPT, n, m) what was remembered, on the grid of now
    dense: Floats  #: (2, KEPT, n, m) of it per angle at the faces behind and ahead of each column
    time: Floats  #: (3,) see `STEP`
    edges: Floats  #: (2, m + 1) angles of the faces, then and now
    then: Floats  #: (FACES + (1 + KEPT n) m,) what is remembered from before the step
    now: Floats  #: (FACES + (1 + KEPT n) m,) what is remembered after it
    supply: Floats  #: (2,) content of the grooves; flow into them where that is given, else 0
    flows: Floats  #: (3,) result: see `ENDS`
    changes: Floats  #: (4, n + 1, m') work space of the tangent


def axial_faces(rows: int) -> tuple[Floats, Floats]:
    """Axial faces between the rows, and the distances over which the pressure falls across them.

    The rows are those of `kernels.axial`: their weights are the widths of the cells.  The distances are
    such that a parabola, the pressure of a short bearing, is met exactly.

    Returns
    -------
    heights, spans : ndarray, shape (rows + 1,)
        Over half the width.
    """
    basis = axial_basis(rows)
    z = np.concatenate(([-1.0], basis.nodes[:rows], [1.0]))
    heights = -1.0 + basis.weights[rows] + np.concatenate(([0.0], np.cumsum(basis.weights[:rows])))
    heights = 0.5 * (heights - heights[::-1])
    rise = 0.5 * (z[1:] ** 2 - z[:-1] ** 2)
    middle = np.abs(heights) < 1e-9
    spans = np.where(middle, np.diff(z), rise / np.where(middle, 1.0, heights))
    return heights, spans


def work_space(columns: int, rows: int) -> dict[str, Any]:
    """The arrays of a new work space, in addition to those of the tilted film."""
    n, m, length = rows, columns, padded(columns)
    return {
        "net": network(columns, rows),
        "across": np.zeros((FIELDS, n + 1, length)),
        "volumes": np.zeros((n, m)),
        "rates": np.zeros((n, m)),
        "share": np.zeros((n, m)),
        "before": np.zeros((KEPT, n, m)),
        "dense": np.zeros((2, KEPT, n, m)),
        "time": np.zeros(3),
        "edges": np.zeros((2, m + 1)),
        "then": np.zeros(FACES + (1 + KEPT * n) * m),
        "now": np.zeros(FACES + (1 + KEPT * n) * m),
        "flows": np.zeros(3),
        "changes": np.zeros((4, n + 1, length)),
    }


def jfo_film(
    columns: int,
    rows: int,
    aspect: float,
    held: NDArray[np.int64],
    supply: tuple[float, float],
    space: dict[str, Any],
) -> JfoFilm:
    """Prepare a film.

    Parameters
    ----------
    columns, rows : int
        Resolution.
    aspect : float
        2R/b.
    held : ndarray of int
        Columns in grooves.
    supply : (float, float)
        Content of the grooves, 1 where they are full and hold the feed pressure, less where they are starved;
        flow into them over C R b/4 where that is given and their content follows, else 0.
    space : dict
        Work space of the tilted film.
    """
    own = work_space(columns, rows)
    heights, spans = axial_faces(rows)
    own["net"].held[:] = FREE
    own["net"].held[:, held] = PRESSURE if supply[0] >= 1.0 and supply[1] == 0.0 else CONTENT
    return JfoFilm(
        film=tilted_film(columns, rows, aspect, space),
        heights=heights,
        spans=spans / aspect**2,
        supply=np.array(supply),
        **own,
    )
