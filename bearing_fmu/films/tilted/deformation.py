"""How far the wall of a soft layer had given way: what a step begins with, and its rate of deformation.

The layer does not turn, so c p belongs to places of the bore, whereas the grid goes with the journal. What is
remembered is c p at the nodes, over the clearance, and the parameter of the grid's map (`kernels.grid`).
Where a film is mixed of two grids both are remembered: what one takes from the other has the error of
interpolating it, so it is taken only where the film that takes it counts for nothing yet. The map
is inverted exactly: a column of now has its place on the uniform circle of then, where c p is interpolated by
the cubic convolution of Keys (1981, IEEE Trans. Acoust. Speech Signal Process. 29, 1153), which has a
continuous slope. Over a step, by implicit Euler, ::

    d(c p)/dt  ->  (c p - c p of then at the same place) / dt

A node that goes over the wall sees what was pressed there. Over the step this is the node's way times the
slope, over dt: it counts as one with the velocity, and its change stands in the damping, as that of moving
faces in a mass-conserving film does and for the same reason (`films.jfo.tangent`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.tilted.layered import KEPT, RATE, SOURCE, STEP, LayeredFilm
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.copied import copy
from bearing_fmu.kernels.grid import COS, SIN
from bearing_fmu.result import DAMPING, STIFFNESS

Floats = NDArray[np.float64]

#: What is remembered first: nothing, of the rigid film, of that on its layer, of that on a spread grid.
NOTHING, OF_RIGID, ON_LAYER, SPREAD_OUT = 0.0, 1.0, 2.0, 3.0
# Then the map's parameter (2), the velocity (4), and whether the rates of c p at the nodes stand behind c p.
_MAP, _VELOCITY, _RATES = 1, 3, 7
#: How many times stiffer than a wall that stands still K may become by what the wall goes on to give way.
_STIFFEST = 10.0


@inner_kernel
def _slot(of: float) -> int:
    return 1 if of == SPREAD_OUT else 0


@inner_kernel
def forget(layered: LayeredFilm) -> None:
    """Begin an evaluation, after which only what is solved in it is remembered."""
    layered.now[0, 0] = layered.now[1, 0] = NOTHING


@inner_kernel
def remember(layered: LayeredFilm, film: TiltedFilm, of: float, v: Floats, ambient: float) -> None:
    """Note how far the wall has given way; where the film is ruptured what the pressure would make of it."""
    n, m = layered.was.shape[1], layered.was.shape[2]
    slot = _slot(of)
    now, then, soft, rate = layered.now[slot], layered.then[slot], layered.constants[2], layered.time[RATE]
    now[0], now[_MAP], now[_MAP + 1] = of, film.grading[0, 0], film.grading[0, 1]
    copy(v, now[_VELOCITY : _VELOCITY + 4])
    follows = of != OF_RIGID and rate > 0.0 and then[0] == of
    now[_RATES] = 1.0 if follows else 0.0
    for j in range(film.face.shape[1]):
        pressure = film.pressures[0, j]
        for i in range(m):
            at = KEPT + j * m + i
            now[at] = soft * (pressure[i] + ambient)
            now[at + n * m] = rate * (now[at] - then[at]) if follows else 0.0


@inner_kernel
def bring_over(layered: LayeredFilm, of: float) -> None:
    """Bring what is remembered to the columns of now, and guess where the film goes `of` this grid."""
    n, m = layered.was.shape[1], layered.was.shape[2]
    slot = _slot(of)
    if layered.then[slot, 0] == NOTHING:
        slot = 1 - slot
    layered.time[SOURCE] = slot
    then, was, cos, sin = (
        layered.then[slot],
        layered.was,
        layered.film.rings[0, COS],
        layered.film.rings[0, SIN],
    )
    layered.time[RATE] = 1.0 / layered.time[STEP] if layered.time[STEP] > 0.0 and then[0] != NOTHING else 0.0
    was[:] = 0.0
    if layered.time[RATE] == 0.0:
        return
    rigid, ax, ay = then[0] == OF_RIGID, then[_MAP], then[_MAP + 1]
    goes_on = then[0] == of and then[_RATES] > 0.0
    for i in range(m):
        # (z - a) / (1 - conj(a) z) with z = exp(i phi) is exp(i t) on the uniform circle of then
        real, imaginary = 1.0 - ax * cos[i] - ay * sin[i], ay * cos[i] - ax * sin[i]
        dx, dy = cos[i] - ax, sin[i] - ay
        angle = np.arctan2(dy * real - dx * imaginary, dx * real + dy * imaginary)
        to_place = m / (2.0 * np.pi)
        place = angle * to_place
        steep = to_place * (1.0 - ax * ax - ay * ay) / (real * real + imaginary * imaginary)
        first = int(np.floor(place))
        x = place - first
        c0, c1 = x * (-0.5 + x * (1.0 - 0.5 * x)), 1.0 + x * x * (1.5 * x - 2.5)
        c2, c3 = x * (0.5 + x * (2.0 - 1.5 * x)), x * x * (0.5 * x - 0.5)
        d0, d1 = -0.5 + x * (2.0 - 1.5 * x), x * (4.5 * x - 5.0)
        d2, d3 = 0.5 + x * (4.0 - 4.5 * x), x * (1.5 * x - 1.0)
        k0, k1, k2, k3 = (first - 1) % m, first % m, (first + 1) % m, (first + 2) % m
        for j in range(n):
            value, slope = 0.0, 0.0
            for row in range(layered.from_rigid.shape[1] if rigid else 1):
                part = layered.from_rigid[j, row] if rigid else 1.0
                at = KEPT + (row if rigid else j) * m
                w0, w1, w2, w3 = then[at + k0], then[at + k1], then[at + k2], then[at + k3]
                value += part * (c0 * w0 + c1 * w1 + c2 * w2 + c3 * w3)
                slope += part * (d0 * w0 + d1 * w1 + d2 * w2 + d3 * w3)
            if value > 0.0:
                was[0, j, i], was[1, j, i] = value, slope * steep
            at = KEPT + j * m + i
            ahead = then[at] + layered.time[STEP] * then[at + n * m]
            layered.ahead[j, i] = ahead if goes_on else was[0, j, i]


@inner_kernel
def add_drift(layered: LayeredFilm, v: Floats, result: Floats) -> None:
    """Count by what the wrench changes, as the wall goes on giving way, as of the journal's way."""
    rate, drift = layered.time[RATE], layered.drift
    if rate == 0.0:
        return
    way, kick, way_kick = layered.way[0], layered.way[1], 0.0
    size, stiff, step = 0.0, 0.0, layered.time[STEP]
    for k in range(4):
        kick[k] = v[k] - layered.then[int(layered.time[SOURCE]), _VELOCITY + k]
        way[k] = step * (v[k] + 0.5 * kick[k])
        kick[k] *= step
        way_kick += way[k] * way[k] + kick[k] * kick[k]
        size += drift[k] * drift[k]
    for k in range(16):
        stiff += result[STIFFNESS + k] ** 2 + (rate * result[DAMPING + k]) ** 2
    if stiff == 0.0 or way_kick == 0.0:
        return
    scale = 1.0 / (way_kick + size / (_STIFFEST * _STIFFEST * stiff))
    for i in range(4):
        for k in range(4):
            result[STIFFNESS + 4 * i + k] += drift[i] * scale * way[k]
            result[DAMPING + 4 * i + k] += drift[i] * scale * step * kick[k]
