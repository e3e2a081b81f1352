"""V2: the Reynolds equation over the aligned gap.

The same discrete equations as V1 at zero tilt.  The gap does not depend on z, so the axial basis is
diagonalised once: K_z v = lambda M v, v' M v = 1.  Each mode is a cyclic tridiagonal system, and of the
modes only those even in z are excited.  Where the film carries pressure is decided on the nodes, so
the zeroing of negative pressure is that of V1.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore, fill_gap, gap_turn, land, least_gap, place_rings
from bearing_fmu.bore.gap import ROUGH_LIMIT, flow_gaps
from bearing_fmu.films.aligned.grooves import hold_grooves, links, pressure_drag, side_flow
from bearing_fmu.films.aligned.peak import largest_pressure
from bearing_fmu.films.aligned.workspace import AlignedFilm
from bearing_fmu.films.turbulence import ALONG, AROUND, LAMINAR_POWER, drag, slow_down
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.grid import COS, METRIC, MOTION, SIN, STRETCHING
from bearing_fmu.kernels.guembel import bearing_part
from bearing_fmu.result import (
    CONDUCTANCE,
    DAMPING,
    DRAG,
    FLOW,
    GAP,
    OPEN,
    OPEN_1,
    OPEN_2,
    PEAK,
    POWER,
    SHEAR,
    SQUEEZE,
    STIFFNESS,
)

Floats = NDArray[np.float64]


@inner_kernel
def _shape_gap(film: AlignedFilm, bore: Bore, q: Floats, v: Floats, sigma: float, part: float) -> None:
    """Grid, gap, conductances and squeezed volume."""
    m = film.circle.shape[2]
    cell = 2.0 * np.pi / m
    place_rings(bore, film.circle, q, 2, part, film.grading, film.rings)
    rough = least_gap(bore, q)[0] < ROUGH_LIMIT * sigma
    film.fields[:, POWER] = LAMINAR_POWER
    for side in range(2):
        ring, field = film.rings[side], film.fields[side]
        metric = ring[METRIC]
        gap, t, conductance = field[GAP], field[OPEN], field[CONDUCTANCE]
        fill_gap(bore, side, q[0], q[1], ring, gap)
        flow_gaps(gap, sigma, rough, t, field[OPEN_1], field[OPEN_2])
        for i in range(m):
            width = cell * metric[i] if side == 0 else 1.0 / (cell * metric[i])
            conductance[i] = width * (t[i] * t[i] * t[i])
    cos, sin = film.rings[1, COS], film.rings[1, SIN]
    squeeze = film.fields[0, SQUEEZE]
    for i in range(m):
        back = i - 1 if i > 0 else m - 1
        squeeze[i] = v[1] * (cos[i] - cos[back]) - v[0] * (sin[i] - sin[back])


@inner_kernel
def _turbulent_shear(film: AlignedFilm, bore: Bore, reynolds: float) -> float:
    """Integral of 1/T times the drag of turbulence."""
    m = film.circle.shape[2]
    shear, metric = 0.0, land(bore, film.rings[0])
    for i in range(m):
        t = film.fields[0, OPEN, i]
        shear += metric[i] / t * drag(reynolds * t)
    return 4.0 * np.pi / m * shear


@inner_kernel
def _factorise(film: AlignedFilm, bore: Bore) -> bool:
    """Eliminate each mode's columns as `ring.factorise` does, all modes abreast."""
    m, modes = film.circle.shape[2], film.values.shape[0]
    along, axial = film.fields[1, CONDUCTANCE], film.fields[0, CONDUCTANCE]
    link = links(film, bore)
    s, v, last = film.forcing[0], film.forcing[1], film.forcing[2]
    for r in range(modes):
        last[r] = film.values[r] * axial[m - 1] + along[m - 1] + along[m - 2]
        s[r] = film.values[r] * axial[0] + along[0] + along[m - 1]
        v[r] = -link[m - 1]
    for i in range(m - 1):
        for r in range(modes):
            if i == m - 2:
                v[r] -= link[i]
            if not s[r] > 0.0:
                return False
            inverse = 1.0 / s[r]
            fill = inverse * v[r]
            film.factor[i, 0, r] = inverse
            film.factor[i, 1, r] = fill
            last[r] -= fill * v[r]
            v[r] = link[i] * fill
            s[r] = film.values[r] * axial[i + 1] + along[i + 1] + along[i] - link[i] * link[i] * inverse
    for r in range(modes):
        if not last[r] > 0.0:
            return False
        film.factor[m - 1, 0, r] = 1.0 / last[r]
    return True


@inner_kernel
def _substitute(film: AlignedFilm, bore: Bore, first: int, sides: int) -> None:
    """Solve in place for the modal pressures from `first`, all modes and sides abreast."""
    m, modes = film.circle.shape[2], film.values.shape[0]
    link = links(film, bore)
    for i in range(m - 1):
        for k in range(first, first + sides):
            for r in range(modes):
                y = film.modal[k, i, r]
                if i > 0:
                    y += link[i - 1] * film.modal[k, i - 1, r]
                film.modal[k, i, r] = film.factor[i, 0, r] * y
                film.modal[k, m - 1, r] -= film.factor[i, 1, r] * y
    for k in range(first, first + sides):
        for r in range(modes):
            film.modal[k, m - 1, r] *= film.factor[m - 1, 0, r]
    for i in range(m - 2, -1, -1):
        for k in range(first, first + sides):
            for r in range(modes):
                x = film.modal[k, i, r] - film.factor[i, 1, r] * film.modal[k, m - 1, r]
                if i < m - 2:
                    x += film.factor[i, 0, r] * link[i] * film.modal[k, i + 1, r]
                film.modal[k, i, r] = x


@stage
def _solve_pressure(
    film: AlignedFilm, bore: Bore, speed: float, ambient: float, feed: float, result: Floats
) -> bool:
    """Pressure, wrench, largest pressure and shear integral."""
    m = film.circle.shape[2]
    cell = 2.0 * np.pi / m
    if not _factorise(film, bore):
        return False
    t, t1, squeeze = film.fields[1, OPEN], film.fields[0, OPEN_1], film.fields[0, SQUEEZE]
    for i in range(m):
        back = i - 1 if i > 0 else m - 1
        drive = -(speed * (t[i] - t[back]) + 2.0 * t1[i] * squeeze[i])
        for r in range(film.values.shape[0]):
            film.modal[0, i, r] = film.drive[r] * drive
    hold_grooves(film, bore, feed - ambient)
    _substitute(film, bore, 0, 1)
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    above = film.forcing[0]
    for j in range(film.weights.shape[0]):
        for i in range(m):
            above[i] = ambient
            for r in range(film.values.shape[0]):
                above[i] += film.shapes[j, r] * film.modal[0, i, r]
        part = film.nodal[j, 0]
        bearing_part(above, m, part, film.nodal[j, 1], film.nodal[j, 2], film.nodal[j, 3])
        along, across = 0.0, 0.0
        for i in range(m):
            along += part[i] * metric[i] * cos[i]
            across += part[i] * metric[i] * sin[i]
        result[0] -= along * film.weights[j] * cell
        result[1] -= across * film.weights[j] * cell
    result[DRAG] = pressure_drag(film, bore, ambient)
    result[FLOW] = side_flow(film, bore, speed)
    shear = 0.0
    metric = land(bore, film.rings[0])
    middle = film.fine[0]
    for i in range(m):
        above[i] = ambient
        for r in range(film.values.shape[0]):
            above[i] += middle[r] * film.modal[0, i, r]
        shear += metric[i] / film.fields[0, OPEN, i]
    result[PEAK] = largest_pressure(film, bore, above, ambient)
    result[SHEAR] = 2.0 * cell * shear
    return True


@inner_kernel
def _solve_adjoints(film: AlignedFilm, bore: Bore) -> None:
    """Modal adjoint pressures 1 and 2, for the two components of the force."""
    m = film.circle.shape[2]
    cell = 2.0 * np.pi / m
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    film.modal[1:] = 0.0
    for j in range(film.weights.shape[0]):
        own, ahead, behind = film.nodal[j, 1], film.nodal[j, 2], film.nodal[j, 3]
        weight = -film.weights[j] * cell
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            fore = i + 1 if i + 1 < m else 0
            w0 = weight * own[i] * metric[i]
            w1 = weight * ahead[back] * metric[back]
            w2 = weight * behind[i] * metric[fore]
            along = w0 * cos[i] + w1 * cos[back] + w2 * cos[fore]
            across = w0 * sin[i] + w1 * sin[back] + w2 * sin[fore]
            for r in range(film.values.shape[0]):
                film.modal[1, i, r] += film.shapes[j, r] * along
                film.modal[2, i, r] += film.shapes[j, r] * across
    if bore is not None:
        for i in bore.held:
            film.modal[1:, i] = 0.0
    _substitute(film, bore, 1, 2)


@inner_kernel
def _add_tangent(film: AlignedFilm, bore: Bore, q: Floats, v: Floats, speed: float, result: Floats) -> None:
    """dF/dq and dF/dv as in `tangent`, the sums over the rows being sums over the modes."""
    m = film.circle.shape[2]
    cell = 2.0 * np.pi / m
    _solve_adjoints(film, bore)
    columns, faces = film.rings[0], film.rings[1]
    column, face = film.fields[0], film.fields[1]
    force = film.forcing[1]
    force[:] = 0.0
    for j in range(film.weights.shape[0]):
        for i in range(m):
            force[i] += film.weights[j] * cell * film.nodal[j, 0, i] * columns[METRIC, i]
    for component in range(2):
        at = 4 * component
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            fore = i + 1 if i + 1 < m else 0
            axial, around, volume, wedge = 0.0, 0.0, 0.0, 0.0
            for r in range(film.values.shape[0]):
                adjoint, pressure = film.modal[1 + component, i, r], film.modal[0, i, r]
                step = film.modal[1 + component, fore, r] - adjoint
                axial += film.values[r] * adjoint * pressure
                around += step * (film.modal[0, fore, r] - pressure)
                volume += film.drive[r] * adjoint
                wedge += film.drive[r] * step
            axial *= column[CONDUCTANCE, i]
            around *= face[CONDUCTANCE, i]
            by_gap_c = -column[POWER, i] * column[OPEN_1, i] / column[OPEN, i] * axial
            by_gap_c -= 2.0 * volume * column[OPEN_2, i] * column[SQUEEZE, i]
            by_gap_f = face[OPEN_1, i] * (speed * wedge - face[POWER, i] * around / face[OPEN, i])
            squeezed = -2.0 * volume * column[OPEN_1, i]
            dcos = faces[COS, i] - faces[COS, back]
            dsin = faces[SIN, i] - faces[SIN, back]
            result[DAMPING + at] -= squeezed * dsin
            result[DAMPING + at + 1] += squeezed * dcos
            turn_c = gap_turn(bore, 0, q[0], q[1], columns, i)
            turn_f = gap_turn(bore, 1, q[0], q[1], faces, i)
            place_c = columns[COS, i] if component == 0 else columns[SIN, i]
            place_t = -columns[SIN, i] if component == 0 else columns[COS, i]
            for k in range(2):
                move, move_f, move_b = columns[MOTION + k, i], faces[MOTION + k, i], faces[MOTION + k, back]
                shift_c = (columns[COS, i] if k == 0 else columns[SIN, i]) - turn_c * move
                shift_f = (faces[COS, i] if k == 0 else faces[SIN, i]) - turn_f * move_f
                moved = v[1] * (faces[SIN, back] * move_b - faces[SIN, i] * move_f)
                moved -= v[0] * (faces[COS, i] * move_f - faces[COS, back] * move_b)
                change = squeezed * moved - by_gap_c * shift_c - by_gap_f * shift_f
                change += around * faces[STRETCHING + k, i] - axial * columns[STRETCHING + k, i]
                change -= force[i] * (place_c * columns[STRETCHING + k, i] + place_t * move)
                result[STIFFNESS + at + k] += change


@stage
def solve_aligned(
    film: AlignedFilm,
    bore: Bore,
    q: Floats,
    v: Floats,
    speed: float,
    ambient: float,
    feed: float,
    sigma: float,
    reynolds: float,
    part: float,
    result: Floats,
) -> bool:
    """Wrench and tangent of the aligned film; parameters and result as in `reynolds.solve_pressure`."""
    result[:] = 0.0
    _shape_gap(film, bore, q, v, sigma, part)
    if reynolds > 0.0:
        slow_down(reynolds, film.circle.shape[2], ALONG, film.fields[0])
        slow_down(reynolds, film.circle.shape[2], AROUND, film.fields[1])
    if not _solve_pressure(film, bore, speed, ambient, feed, result):
        return False
    if reynolds > 0.0:
        result[SHEAR] = _turbulent_shear(film, bore, reynolds)
    _add_tangent(film, bore, q, v, speed, result)
    return True
