"""Reynolds' condition: the film ruptures where pressure and pressure gradient vanish together.

The pressure is non-negative, and where it is zero the film would pull.  This complementarity problem is
solved by its active set: nodes with negative pressure are held at the cavity's pressure, held nodes
that push are released, until nothing changes (a primal-dual active set; Hintermueller, Ito, Kunisch 2002).
The axial basis does not make an M-matrix, so single nodes at the rupture may alternate for ever.  A node
is therefore held only below a small negative pressure, a part of the largest one that grows with
each round; what remains negative is zeroed in the integration.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.compiled import inner_kernel

Floats = NDArray[np.float64]

ROUNDS = 60
_SLACK = 1e-6
# A held node is tied to its value by this multiple of its own stiffness.
TIE = 1e12


@inner_kernel
def hold(film: TiltedFilm, ambient: float) -> None:
    """Tie the held nodes in the assembled system."""
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    b = film.blocks[0]
    for j in range(n):
        for i in range(m):
            if film.held[j, i] != 0.0:
                at = (i * n + j) * width + j
                tie = TIE * b[at]
                b[at] += tie
                film.sides[i * width + j] -= tie * ambient


@inner_kernel
def release(film: TiltedFilm) -> None:
    """Forget the rupture of an earlier state."""
    for j in range(film.held.shape[0]):
        for i in range(film.held.shape[1]):
            if film.held[j, i] == 1.0:
                film.held[j, i] = 0.0


@inner_kernel
def move_rupture(film: TiltedFilm, ambient: float, attempt: int) -> bool:
    """Hold nodes that pull, release held nodes that push; True if any changed."""
    n, m = film.face.shape[1], film.circle.shape[2]
    largest = 0.0
    for j in range(n):
        for i in range(m):
            largest = max(largest, film.pressures[0, j, i] + ambient)
    limit = -_SLACK * 1.3**attempt * largest
    changed = False
    for j in range(n):
        for i in range(m):
            pressure = film.pressures[0, j, i] + ambient
            if film.held[j, i] == 0.0 and pressure < limit:
                film.held[j, i] = 1.0
                changed = True
            elif film.held[j, i] == 1.0 and pressure > 0.0:
                film.held[j, i] = 0.0
                changed = True
    return changed
