"""What the asperities of the layered film bear: their wrench, and their part of its tangent.

Their force is summed on lines between the rows, on which the pressure is the axial polynomial: what they
bear changes over a few roughnesses, along the axis within a cell. On each column only moments of it over z
are summed, since gap and levers are linear in z; directions come in once, behind all lines.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.asperities import REACH
from bearing_fmu.contact.edge import edge_back
from bearing_fmu.contact.layer import YIELDING, deflection
from bearing_fmu.contact.slice import AREA, FORCE, LOAD, PRESSURE, WIPED
from bearing_fmu.films.tilted.layered import LayeredFilm
from bearing_fmu.films.tilted.layered_residual import gap_change
from bearing_fmu.kernels.cells import NEAR
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.grid import COS, METRIC, MOTION, SIN, STRETCHING
from bearing_fmu.result import GAP, STIFFNESS

Floats = NDArray[np.float64]

#: Moments on a column: of the force, alone and by its lever; of its slope by the gap, alone, by the lever, by
#: the z of that gap, and by both.
_PUSH, _LEVER, _SLOPE, _BY_LEVER, _BY_PLACE, _BY_BOTH = range(6)


@inner_kernel
def _press(layered: LayeredFilm, i: int, q: Floats, ambient: float, column: Floats, contact: Floats) -> None:
    """Sum what the asperities bear on the lines of column i.

    Parameters
    ----------
    column : ndarray, shape (3, n)
        Pressure in the cells; to the others are added the changes of the force by it, and of its moment.
    """
    film, moments = layered.film, layered.moments
    sigma, soft, hardness = layered.constants[1], layered.constants[2], layered.constants[3]
    cos, sin, near = film.rings[0, COS, i], film.rings[0, SIN, i], REACH * sigma
    middle, by_z = 1.0 - q[0] * cos - q[1] * sin, q[2] * sin - q[3] * cos
    scale, yields = film.rings[0, METRIC, i] * 2.0 * np.pi / film.circle.shape[2], YIELDING * soft * hardness
    force, lever, slope0, slope1, slope2, wiped, most = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for line in range(layered.places.shape[1]):
        z = layered.places[0, line]
        s = middle + by_z * z
        if s >= near:
            continue
        row, pressure = int(layered.lines[line, 0]), ambient
        for near_by in range(NEAR):
            pressure += layered.lines[line, 1 + near_by] * column[0, row + near_by]
        s += soft * max(pressure, 0.0)
        if s >= near:
            continue
        back, slope, _ = deflection(s / sigma, layered.constants[0], layered.table)
        area = scale * layered.places[1, line]
        push, slope = area * sigma * back / soft, area * slope
        force += push
        lever += push * z
        slope0 += slope
        slope1 += slope * z
        slope2 += slope * z * z
        most = max(most, sigma * back)
        wiped += area if sigma * back >= yields else 0.0
        if pressure > 0.0:
            for near_by in range(NEAR):
                push = slope * layered.lines[line, 1 + near_by]
                column[1, row + near_by] += push
                column[2, row + near_by] += push * z
    moments[_PUSH, i], moments[_LEVER, i] = force, lever
    moments[_SLOPE, i], moments[_BY_BOTH, i] = slope0 / soft, slope2 / soft
    moments[_BY_LEVER, i] = moments[_BY_PLACE, i] = slope1 / soft
    contact[WIPED] += wiped
    contact[PRESSURE] = max(contact[PRESSURE], most / (soft * hardness))


@inner_kernel
def _add_slope(layered: LayeredFilm, i: int, z: float, place: float, slope: float) -> None:
    """Add the slope of a force with lever z by the gap at a place."""
    moments = layered.moments
    moments[_SLOPE, i] += slope
    moments[_BY_LEVER, i] += slope * z
    moments[_BY_PLACE, i] += slope * place
    moments[_BY_BOTH, i] += slope * z * place


@inner_kernel
def _press_end(
    layered: LayeredFilm, end: int, i: int, ambient: float, column: Floats, contact: Floats
) -> None:
    """As `_press`, on the outer half of a last cell, where the pressure falls as `contact.edge` has it."""
    film, moments = layered.film, layered.moments
    n, m = film.face.shape[1], film.circle.shape[2]
    sigma, soft, hardness = layered.constants[1], layered.constants[2], layered.constants[3]
    row, face = (0, 0) if end == 0 else (n - 1, n)
    place, last = film.nodes[row], film.nodes[n + end]
    near, press, gap = REACH * sigma, soft * max(ambient, 0.0), film.column[GAP, row, i]
    s_end, pressure = layered.across[GAP, face, i] + press, ambient + column[0, row]
    s = gap + soft * max(pressure, 0.0)
    if s >= near and s_end >= near:
        return
    drop = max(s - gap - press, 0.0) / sigma
    back, by_inside, by_end, by_press = edge_back(s / sigma, s_end / sigma, drop, layered.edge)
    if not back > 0.0:
        return
    z, area = 0.5 * (place + last), np.pi / m * film.weights[row] * film.rings[0, METRIC, i]
    most = deflection(min(s, s_end) / sigma, layered.constants[0], layered.table)[0]
    contact[WIPED] += area if sigma * back >= YIELDING * soft * hardness else 0.0
    contact[PRESSURE] = max(contact[PRESSURE], sigma * most / (soft * hardness))
    moments[_PUSH, i] += area * sigma * back / soft
    moments[_LEVER, i] += area * sigma * back / soft * z
    _add_slope(layered, i, z, place, area * by_inside / soft)
    _add_slope(layered, i, z, last, area * by_end / soft)
    if pressure > 0.0:
        push = area * (by_inside + (by_press if drop > 0.0 else 0.0))
        column[1, row] += push
        column[2, row] += push * z


@inner_kernel
def _add_stiffness(layered: LayeredFilm, q: Floats, grip: float, result: Floats) -> None:
    """Add the tangent of the wrench of the moments, with the grid as it moves."""
    ring, moments = layered.film.rings[0], layered.moments
    m = layered.film.circle.shape[2]
    for k in range(4):
        along, across, across_lever, along_lever = 0.0, 0.0, 0.0, 0.0
        for i in range(m):
            cos, sin, motion = ring[COS, i], ring[SIN, i], ring[MOTION + k, i]
            pushed, levered = moments[_PUSH, i], moments[_LEVER, i]
            dx, dy = -(cos - grip * sin), -(sin + grip * cos)
            middle, by_z = gap_change(q, k, cos, sin, motion)
            grown = moments[_SLOPE, i] * middle + moments[_BY_PLACE, i] * by_z
            grown += pushed * ring[STRETCHING + k, i]
            turned = pushed * motion
            along += grown * dx - turned * dy
            across += grown * dy + turned * dx
            grown = moments[_BY_LEVER, i] * middle + moments[_BY_BOTH, i] * by_z
            grown += levered * ring[STRETCHING + k, i]
            turned = levered * motion
            along_lever += grown * dx - turned * dy
            across_lever += grown * dy + turned * dx
        result[STIFFNESS + k] += along
        result[STIFFNESS + 4 + k] += across
        result[STIFFNESS + 8 + k] -= across_lever
        result[STIFFNESS + 12 + k] += along_lever


@inner_kernel
def _add_halves(layered: LayeredFilm, q: Floats, result: Floats) -> None:
    """Add how the film's force on the outer halves of the last cells changes with the gap."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    metric = film.rings[0, METRIC]
    layered.moments[:] = 0.0
    for end in range(2):
        row = 0 if end == 0 else n - 1
        weight, lever = layered.sums.weights[row] * 2.0 * np.pi / m, layered.sums.nodes[row]
        for side in range(2):
            slope, place = layered.outer[1 + side, end], film.nodes[row if side == 0 else n + end]
            for i in range(m):
                _add_slope(layered, i, lever, place, weight * metric[i] * slope[i])
    _add_stiffness(layered, q, 0.0, result)


@stage
def touch(
    layered: LayeredFilm, q: Floats, ambient: float, grip: float, force: float, half: float, result: Floats,
    contact: Floats,
) -> None:  # fmt: skip
    """Add the asperities' wrench, SI, and complete the adjoint right-hand sides and the tangent by them.

    Parameters
    ----------
    grip : float
        Friction coefficient times sense of sliding.
    force, half : float
        Unit of the film's force, N, and of lengths along the axis, m.
    result, contact
        The film's and the contact's results; the tangent of both goes into that of the film.
    """
    film, moments = layered.film, layered.moments
    n, m = film.face.shape[1], film.circle.shape[2]
    width, near = film.coupling.shape[0] // m, REACH * layered.constants[1]
    column = film.row[: 3 * n].reshape(3, n)
    result[STIFFNESS : STIFFNESS + 16] = 0.0
    moments[:] = 0.0
    for i in range(m):
        cos, sin = film.rings[0, COS, i], film.rings[0, SIN, i]
        if 1.0 - q[0] * cos - q[1] * sin - abs(q[2] * sin - q[3] * cos) >= near:  # the least gap over z
            continue
        for j in range(n):
            column[0, j], column[1, j], column[2, j] = film.pressures[0, j, i], 0.0, 0.0
        _press(layered, i, q, ambient, column, contact)
        for end in range(2):
            _press_end(layered, end, i, ambient, column, contact)
        dx, dy = -(cos - grip * sin), -(sin + grip * cos)
        push, lever = moments[_PUSH, i] * force, moments[_LEVER, i] * force * half
        contact[LOAD] += push
        contact[AREA] += moments[_PUSH, i] / layered.constants[3]
        contact[FORCE] += push * dx
        contact[FORCE + 1] += push * dy
        contact[FORCE + 2] -= lever * dy
        contact[FORCE + 3] += lever * dx
        at = i * 4 * width
        for j in range(n):
            film.sides[at + j] += column[1, j] * dx
            film.sides[at + width + j] += column[1, j] * dy
            film.sides[at + 2 * width + j] -= column[2, j] * dy
            film.sides[at + 3 * width + j] += column[2, j] * dx
    _add_stiffness(layered, q, grip, result)
    _add_halves(layered, q, result)
