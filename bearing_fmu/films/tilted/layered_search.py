"""Search for the pressure of a film on its layer.

Newton's method alone wanders where a whole region overlaps, since there almost nothing but the advection is
left. So it follows a wall that takes time to give way (pseudo-transient continuation; Kelley and Keyes 1998,
SIAM J. Numer. Anal. 35, 508): quickly, its rate falling with the residual (Mulder and van Leer 1985), and
where that does not end, with a rate that keeps each step to what its linear equations say.

Where the wall's deformation before a step is known, the wall does take time. There the start is where the
last two steps point to, the first factor mostly serves until the pressure stands, and one more is made for
the tangent; else Newton's method goes from where the wall was.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.edge import edge_pressure
from bearing_fmu.films.tilted.deformation import bring_over
from bearing_fmu.films.tilted.layered import RATE, LayeredFilm
from bearing_fmu.films.tilted.layered_equations import linearise, shape_across
from bearing_fmu.films.tilted.lines import SHARE, wrench_of
from bearing_fmu.films.tilted.reynolds import integrate, shape_gap, unfold
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.copied import copy
from bearing_fmu.kernels.grid import METRIC
from bearing_fmu.kernels.unsymmetric_solver import factorise_ring, solve_ring
from bearing_fmu.result import CONDUCTANCE, FLOW, GAP, OPEN, SHEAR
from bearing_fmu.status import NO_SOLUTION, NOT_CONVERGED, OK

Floats = NDArray[np.float64]

#: Of the search from the step before, of the quick one and of the careful one; of the first from where on
#: it takes half of each step.
_PLAIN, _QUICK, _CAREFUL, _HALF = 24, 30, 400, 10
#: Of a step with an old factor over the one before: what calls for a new one.
_SLOW = 0.35
#: Of a step of the pressure: one more would change it by about the square of that, and one more is made;
#: where the wall is followed, and there with an old factor.
_PRECISION, _NEWTON, _CHORD = 3e-5, 1e-3, 1e-3
#: Roughnesses by which a step presses the wall back at most, in either search.
_STEPS = (3.0, 300.0)
#: Rate at which the wall gives way at first, over the flow's, and where it is none.
_RATE, _NONE = 1.0, 1e-2
#: What a step may change the rate by: falls of the quick search and of the careful one, growth.
_FALLS, _GROWTH = (0.02, 0.2), 2.0
#: Of a careful step: misfit of its linear equations over the residual at which it is taken back, and that
#: at which the rate stays; what the rate rises by, and from where at least, if it is taken back.
_BACK, _WANTED, _RISE, _LEAST = 1.0, 0.25, 4.0, 0.03


@inner_kernel
def _resist(layered: LayeredFilm, rate: float) -> None:
    """Let the wall take time to give way."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    scale = 4.0 * np.pi / m * rate * layered.constants[2]
    for i in range(m):
        for j in range(n):
            layered.blocks[0, (i * n + j) * width + j] += scale * film.weights[j] * film.rings[0, METRIC, i]


@inner_kernel
def _advance(layered: LayeredFilm, ambient: float, most: float, part: float) -> float:
    """Take a `part` of the step in `sides`; its size, where there is a film, over the largest pressure.

    A step raises the pressure by `most` only: from a closed gap the linear film would overshoot.
    """
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    step, largest = 0.0, 0.0
    for j in range(n):
        for i in range(m):
            at = i * width + j
            before = layered.kept[at] = film.pressures[0, j, i]
            film.sides[at] = min(before + part * film.sides[at], max(before, 0.0) + most)
            after = max(film.sides[at] + ambient, 0.0)
            step = max(step, abs(after - max(before + ambient, 0.0)))
            largest = max(largest, after)
    return step / largest if largest > 0.0 else 0.0


@inner_kernel
def _misfit(layered: LayeredFilm, rate: float) -> float:
    """How far the residual in `sides` is from what the last step's linear equations said."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    scale, square = 4.0 * np.pi / m * rate * layered.constants[2], 0.0
    for j in range(n):
        for i in range(m):
            at = i * width + j
            held = scale * film.weights[j] * film.rings[0, METRIC, i]
            square += (film.sides[at] - held * (film.pressures[0, j, i] - layered.kept[at])) ** 2
    return np.sqrt(square)


@inner_kernel
def _begin(layered: LayeredFilm, ambient: float, guess: bool) -> None:
    """Put a pressure into `sides`: a guess, that before the step, or one with which nothing overlaps."""
    film, soft = layered.film, layered.constants[2]
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    for j in range(n):
        for i in range(m):
            if layered.time[RATE] == 0.0:
                film.sides[i * width + j] = max(-film.column[GAP, j, i], 0.0) / soft
            else:
                given = layered.ahead[j, i] if guess else layered.was[0, j, i]
                film.sides[i * width + j] = given / soft - ambient


@inner_kernel
def _follow(layered: LayeredFilm, v: Floats, speed: float, ambient: float) -> bool:
    """Find the pressure from that before the step, as `_search`; False where this does not end."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    b, w, y = layered.blocks[0], layered.blocks[1], layered.blocks[2]
    most = _STEPS[0] * layered.constants[1] / layered.constants[2]
    step, renew, found = np.inf, True, False
    for round_ in range(2 * _PLAIN):
        newton = round_ >= _PLAIN
        if round_ == 0 or round_ == _PLAIN:
            _begin(layered, ambient, not newton)
            step, renew, found = np.inf, True, False
        unfold(film, 0, 0, 1)
        linearise(layered, v, speed, ambient, renew)
        if renew:
            layered.counts[0] += 1.0
            if not factorise_ring(b, layered.lower, layered.upper, w, y, layered.work, m, n, width):
                return False
        layered.counts[1] += 1.0
        solve_ring(b, layered.lower, layered.upper, w, y, film.sides, layered.work, m, n, width, 1)
        part = 0.5 if newton and not found and round_ >= _PLAIN + _HALF else 1.0
        before, step = step, _advance(layered, ambient, most, part) / part
        if found and step < _NEWTON:
            return True
        found = step < (_NEWTON if renew else _CHORD)
        renew = found or newton or step > _SLOW * before
    return False


@inner_kernel
def _search(layered: LayeredFilm, v: Floats, speed: float, ambient: float) -> int:
    """Find the pressure; on return it lies in `sides`, and the factor is that of its Jacobian."""
    film, soft = layered.film, layered.constants[2]
    n, m = film.face.shape[1], film.circle.shape[2]
    width = film.coupling.shape[0] // m
    b, w, y = layered.blocks[0], layered.blocks[1], layered.blocks[2]
    flow = abs(speed) + 2.0 * np.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3])
    layered.counts[2] += 1.0
    _begin(layered, ambient, False)
    rate, before, found, fresh = _RATE, 0.0, False, True
    for round_ in range(_QUICK + _CAREFUL):
        careful = round_ >= _QUICK
        if round_ == _QUICK:
            _begin(layered, ambient, False)
            rate, found, fresh = _RATE, False, True
        unfold(film, 0, 0, 1)
        residual = linearise(layered, v, speed, ambient, True)
        if found:
            rate = 0.0
        elif careful and not fresh:
            misfit = _misfit(layered, rate * flow) / before
            if misfit > _BACK:
                rate, fresh = _RISE * max(rate, _LEAST), True
                copy(layered.kept, film.sides[: m * width])
                continue
            rate *= min(max(misfit / _WANTED, _FALLS[1]), _GROWTH)
        elif not fresh and before > 0.0:
            rate *= min(max(residual / before, _FALLS[0]), _GROWTH)
        before, fresh = max(residual, 1e-300), False
        _resist(layered, rate * flow)
        layered.counts[0] += 1.0
        if not factorise_ring(b, layered.lower, layered.upper, w, y, layered.work, m, n, width):
            return NO_SOLUTION
        solve_ring(b, layered.lower, layered.upper, w, y, film.sides, layered.work, m, n, width, 1)
        most = np.inf if found else _STEPS[1 if careful else 0] * layered.constants[1] / soft
        step = _advance(layered, ambient, most, 1.0)
        if found:
            return OK
        found = step < _PRECISION and rate <= _NONE
    return NOT_CONVERGED


@inner_kernel
def _side_flow(layered: LayeredFilm) -> float:
    """Flow out at both ends of the columns that let oil out, over `scales.flow`."""
    film, total = layered.film, 0.0
    n, m = film.face.shape[1], film.circle.shape[2]
    low, high = layered.across[CONDUCTANCE, 0], layered.across[CONDUCTANCE, n]
    for i in range(m):
        total += max(low[i] * film.pressures[0, 2 * n, i], 0.0)
        total += max(-high[i] * film.pressures[0, 3 * n, i], 0.0)
    return total


@inner_kernel
def _take_edges(layered: LayeredFilm, ambient: float, result: Floats) -> None:
    """Let the pressure fall over the outer halves of the last cells, in its bearing part and the wrench."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    sigma, soft, part = layered.constants[1], layered.constants[2], layered.constants[5]
    press = soft * max(ambient, 0.0)
    for end in range(2):
        row, face = (0, 0) if end == 0 else (n - 1, n)
        value, by_inside, by_end = layered.outer[0, end], layered.outer[1, end], layered.outer[2, end]
        nodal, own, ahead, behind = (
            film.nodal[0, row],
            film.nodal[1, row],
            film.nodal[2, row],
            film.nodal[3, row],
        )
        for i in range(m):
            s = film.column[GAP, row, i] + soft * max(film.pressures[0, row, i] + ambient, 0.0)
            mean, by_s, by_e = edge_pressure(
                s / sigma, (layered.across[GAP, face, i] + press) / sigma, layered.edge
            )
            value[i] = 1.0 + part * (mean - 1.0)
            by_inside[i], by_end[i] = (
                part * by_s / sigma * nodal[i],
                part * by_e / sigma * nodal[i],
            )
        for i in range(m):
            fore = i + 1 if i + 1 < m else 0
            given = soft if film.pressures[0, row, i] + ambient > 0.0 else 0.0
            nodal[i] *= value[i]
            own[i] = own[i] * value[i] + by_inside[i] * given
            ahead[i] *= value[i]
            behind[i] *= value[fore]
    wrench_of(layered.sums, film.nodal[0], result)


@inner_kernel
def _shear(film: TiltedFilm) -> float:
    """Integral of 1 over the open gap."""
    m, metric, shear = film.circle.shape[2], film.rings[0, METRIC], 0.0
    for j in range(film.face.shape[1]):
        t, total = film.column[OPEN, j], 0.0
        for i in range(m):
            total += metric[i] / t[i]
        shear += film.weights[j] * 2.0 * np.pi / m * total
    return shear


@stage
def solve_layered(
    layered: LayeredFilm, q: Floats, v: Floats, speed: float, ambient: float, sigma: float, part: float,
    of: float, result: Floats,
) -> int:  # fmt: skip
    """Solve for the pressure, `of` this kind of grid; otherwise as `reynolds.solve_pressure`.

    On return the factor is that of the Jacobian, for the adjoint.
    """
    film = layered.film
    shape_gap(film, None, q, sigma, part)
    shape_across(layered, q)
    film.mixed[SHARE] = 0.0
    bring_over(layered, of)
    status = OK
    if layered.time[RATE] == 0.0 or not _follow(layered, v, speed, ambient):
        status = _search(layered, v, speed, ambient)
    if status == OK:
        unfold(film, 0, 0, 1)
        integrate(layered.sums, None, ambient, result)
        _take_edges(layered, ambient, result)
        result[SHEAR] = _shear(film)
        result[FLOW] = _side_flow(layered)
    return status
