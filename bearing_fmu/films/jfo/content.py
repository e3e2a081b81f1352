"""What the film remembers, and how it comes to the grid of now.

The grid goes with the journal.  A cell remembers its volume V, the void in it, (1 - theta) V, and what is
owed to it; all are spread evenly over the angle between its faces of then, and what lies between the faces of
now is what a cell begins the step with.  So nothing is lost on the way, and a full film stays exactly full.

What is owed: the port gives the rate of the gap at the end of a step, with which the film squeezes; the
volume that this makes differs from the change of the volume by half the step times the change of the rate.
The difference is kept and paid back over a revolution, so that the oil is conserved to rounding,

    theta V + owed  (now)  =  theta V + owed  (then)  -  dt x outflow,

and a full film yet has the force that belongs to position and velocity, with stiffness and damping apart.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.jfo.workspace import FACES, KEPT, OWED, PAID, STEP, VOID, VOLUME, JfoFilm
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.copied import copy
from bearing_fmu.kernels.grid import COS, SIN

Floats = NDArray[np.float64]
_TURN = 2.0 * np.pi


@inner_kernel
def _wrapped(angle: float) -> float:
    """The angle from -pi to pi."""
    return angle - _TURN * np.floor(angle / _TURN + 0.5)


@stage
def face_angles(jfo: JfoFilm) -> None:
    """Angles of the faces of now, ascending, the first one again at the end."""
    ring, now = jfo.film.rings[1], jfo.edges[1]
    m = now.shape[0] - 1
    for i in range(m):
        angle = np.arctan2(ring[SIN, i], ring[COS, i])
        if i == 0:
            now[0] = angle
        else:
            turn = _wrapped(angle - now[i - 1])
            now[i] = now[i - 1] + max(turn, 0.0)
    now[m] = now[0] + _TURN


@stage
def begin_full(jfo: JfoFilm) -> None:
    """A full film on the grid of now, to which nothing is owed."""
    copy(jfo.edges[1], jfo.edges[0])
    jfo.before[:] = 0.0
    copy(jfo.volumes.reshape(-1), jfo.before[VOLUME].reshape(-1))
    jfo.dense[:] = 0.0


@stage
def bring_over(jfo: JfoFilm) -> None:
    """Bring what is remembered to the grid of now.

    Writes `before`, and `dense`, with which it changes as faces move.
    """
    n, m = jfo.volumes.shape
    old, new = jfo.edges[0], jfo.edges[1]
    then = jfo.then[FACES + m :].reshape((KEPT, n, m))
    copy(jfo.then[FACES:], old[:m])
    old[m] = old[0] + _TURN
    # the faces of now in the turn of those of then; the column between the faces k - 1 and k is k
    shift = _TURN * np.floor((new[0] - old[0]) / _TURN)
    jfo.before[:] = 0.0
    k = 0  # the old face at or before the present angle
    while k < m - 1 and old[k + 1] <= new[0] - shift:
        k += 1
    at = new[0] - shift  # from old[0] on, less than a turn
    turn = 0.0
    _note_density(jfo, then, k, 0)
    for i in range(1, m + 1):
        column = i if i < m else 0
        end = new[i] - shift
        for _ in range(2 * m + 2):
            edge = old[k + 1] + turn
            stop = min(edge, end)
            if stop > at:
                cell = k + 1 if k + 1 < m else 0
                part = (stop - at) / (old[k + 1] - old[k])
                for field in range(KEPT):
                    for j in range(n):
                        jfo.before[field, j, column] += part * then[field, j, cell]
                at = stop
            if edge > end or (edge == end and i == m):
                break
            k += 1
            if k == m:
                k, turn = 0, turn + _TURN
        if i < m:
            _note_density(jfo, then, k, i)


@inner_kernel
def _note_density(jfo: JfoFilm, then: Floats, k: int, face: int) -> None:
    """Note what lies per angle where a face is, between the old faces k and k + 1."""
    n, m = jfo.volumes.shape
    cell, ahead = (k + 1 if k + 1 < m else 0), (face + 1 if face + 1 < m else 0)
    width = jfo.edges[0, k + 1] - jfo.edges[0, k]
    for field in range(KEPT):
        for j in range(n):
            density = then[field, j, cell] / width if width > 0.0 else 0.0
            jfo.dense[1, field, j, face] = density
            jfo.dense[0, field, j, ahead] = density


@stage
def remember(jfo: JfoFilm) -> None:
    """Write what is remembered after the step."""
    n, m = jfo.volumes.shape
    now = jfo.now[FACES + m :].reshape((KEPT, n, m))
    dt, paid = jfo.time[STEP], jfo.time[PAID]
    copy(jfo.edges[1], jfo.now[FACES : FACES + m])
    for j in range(n):
        content, held = jfo.net.content[j], jfo.net.held[j]
        volume, void, owed = jfo.before[VOLUME, j], jfo.before[VOID, j], jfo.before[OWED, j]
        for i in range(m):
            now[VOLUME, j, i] = jfo.volumes[j, i]
            now[VOID, j, i] = (1.0 - content[i]) * jfo.volumes[j, i]
            grown = volume[i] - jfo.volumes[j, i] + dt * jfo.rates[j, i]
            if held[i] != 0.0 or dt == 0.0:
                now[OWED, j, i] = 0.0
            else:
                had = 1.0 - void[i] / volume[i]
                squeezed = dt * jfo.rates[j, i] * (jfo.share[j, i] - had)
                now[OWED, j, i] = (1.0 - paid) * owed[i] + had * grown + squeezed
