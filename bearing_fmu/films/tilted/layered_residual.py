"""How the residual of the layered film changes with the journal's place and velocity, at a given pressure.

As `tangent.residual_tangent` and `tangent.contract`, with the fluxes of cells along the axis, but the other
way round: gap and squeezed volume are linear in z, so what the adjoint pressures make of their changes is
summed over z first, on each column, and then contracted with each of the four coordinates.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.films.tilted.layered import RATE, LayeredFilm
from bearing_fmu.films.tilted.layered_jacobian import BY_END, BY_GAP
from bearing_fmu.films.tilted.tangent import BY_GAP as NODES_AND_FACES
from bearing_fmu.films.tilted.tangent import BY_METRIC, prepare_rows, turn_faces
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.grid import COS, METRIC, MOTION, SIN, STRETCHING
from bearing_fmu.result import CONDUCTANCE, DAMPING, STIFFNESS

Floats = NDArray[np.float64]

#: Sums over z on a column, those of _Z with z: by the gap at the columns, by their metric, by the squeezed
#: volume; of this by how far the wall has given way in the step, and by the slope of what was given before;
#: by the gap at the faces, by their metric.
_GAP, _GAP_Z, _METRIC, _VOLUME, _VOLUME_Z, _GIVEN, _PASSED, _FACE, _FACE_Z, _FACE_METRIC = range(10)


@inner_kernel
def gap_change(q: Floats, k: int, cos: float, sin: float, motion: float) -> tuple[float, float]:
    """dH/dq_k at a point of the grid as it moves: in the middle, and by z."""
    middle = -cos if k == 0 else -sin if k == 1 else 0.0
    by_z = sin if k == 2 else -cos if k == 3 else 0.0
    return middle + (q[0] * sin - q[1] * cos) * motion, by_z + (q[3] * sin + q[2] * cos) * motion


@inner_kernel
def _sum_rows(layered: LayeredFilm, side: int, ambient: float) -> None:
    """Sum over what rows hold and what flows around in them."""
    film, sums, soft = layered.film, layered.over_z[side], layered.constants[2]
    n, m = film.face.shape[1], film.circle.shape[2]
    stack, by_gap = film.pressures[side + 1], film.forcing[NODES_AND_FACES]
    by_metric = film.forcing[BY_METRIC]
    for j in range(n):
        z, adjoint, ahead, pressure = film.nodes[j], stack[j], stack[n + j], film.pressures[0, j]
        by_node, volume, was, slope = by_gap[j], by_metric[j], layered.was[0, j], layered.was[1, j]
        by_face, metric = by_gap[n + j], by_metric[n + j]
        for i in range(m):
            part, out = adjoint[i] * by_node[i], adjoint[i] * volume[i]
            sums[_GAP, i] += part
            sums[_GAP_Z, i] += z * part
            sums[_VOLUME, i] += out
            sums[_VOLUME_Z, i] += z * out
            sums[_GIVEN, i] += out * (soft * max(pressure[i] + ambient, 0.0) - was[i])
            sums[_PASSED, i] += out * slope[i]
        for i in range(m):
            part = ahead[i] * by_face[i]
            sums[_FACE, i] += part
            sums[_FACE_Z, i] += z * part
            sums[_FACE_METRIC, i] += ahead[i] * metric[i]


@inner_kernel
def _sum_axial(layered: LayeredFilm, side: int) -> None:
    """Sum over what flows along the axis."""
    film, sums = layered.film, layered.over_z[side]
    n, m = film.face.shape[1], film.circle.shape[2]
    for face in range(n + 1):
        across, slope = film.pressures[side + 1, 2 * n + face], film.pressures[0, 2 * n + face]
        flow, by_near = layered.across[CONDUCTANCE, face], layered.across[BY_GAP, face]
        end = face == 0 or face == n
        z = layered.faces[face, 0] if not end else film.nodes[0 if face == 0 else n - 1]
        for i in range(m):
            out = -across[i] * flow[i] * slope[i]
            part = out * by_near[i]
            sums[_METRIC, i] += out
            sums[_GAP, i] += part
            sums[_GAP_Z, i] += z * part
        if end:
            by_end, z = layered.across[BY_END, face], layered.faces[face, 0]
            for i in range(m):
                part = across[i] * flow[i] * slope[i] * by_end[i]
                sums[_GAP, i] -= part
                sums[_GAP_Z, i] -= z * part


@inner_kernel
def _contract(layered: LayeredFilm, q: Floats, v: Floats, k: int, result: Floats) -> None:
    """Add what follows from the sums for q_k."""
    film = layered.film
    m = film.circle.shape[2]
    ring, faces, area = film.rings[0], film.rings[1], 2.0 * np.pi / m
    dcos, dsin, give = film.forcing[3, 1], film.forcing[3, 2], area * layered.time[RATE]
    middle, by_z, face_middle, face_by_z = layered.rows[0], layered.rows[1], layered.rows[2], layered.rows[3]
    turn_faces(film, k)
    for i in range(m):
        middle[i], by_z[i] = gap_change(q, k, ring[COS, i], ring[SIN, i], ring[MOTION + k, i])
        face_middle[i], face_by_z[i] = gap_change(q, k, faces[COS, i], faces[SIN, i], faces[MOTION + k, i])
    for side in range(4):
        sums, stiff, passed = layered.over_z[side], 0.0, 0.0
        for i in range(m):
            stiff += sums[_GAP, i] * middle[i] + sums[_GAP_Z, i] * by_z[i]
            stiff += sums[_FACE, i] * face_middle[i] + sums[_FACE_Z, i] * face_by_z[i]
        for i in range(m):
            stiff += (sums[_METRIC, i] + give * ring[METRIC, i] * sums[_GIVEN, i]) * ring[STRETCHING + k, i]
            stiff += sums[_FACE_METRIC, i] * faces[STRETCHING + k, i]
            passed += area * ring[METRIC, i] * sums[_PASSED, i] * ring[MOTION + k, i]
        for i in range(m):
            stiff += (v[1] * sums[_VOLUME, i] - v[2] * sums[_VOLUME_Z, i]) * dcos[i]
            stiff -= (v[0] * sums[_VOLUME, i] + v[3] * sums[_VOLUME_Z, i]) * dsin[i]
        result[STIFFNESS + 4 * side + k] += stiff
        if give > 0.0:
            result[DAMPING + 4 * side + k] -= passed


@inner_kernel
def _set_damping(layered: LayeredFilm, v: Floats, result: Floats) -> None:
    """Set dF/dv, for velocity enters by the squeezed volume alone; and the drift by the wall's rate."""
    film, rate = layered.film, layered.time[RATE]
    m = film.circle.shape[2]
    ring, cos, sin = film.rings[0], film.rings[1, COS], film.rings[1, SIN]
    for side in range(4):
        sums, row, drift = layered.over_z[side], DAMPING + 4 * side, 0.0
        c, s, cz, sz = 0.0, 0.0, 0.0, 0.0
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            dcos, dsin = cos[i] - cos[back], sin[i] - sin[back]
            c += sums[_VOLUME, i] * dcos
            s += sums[_VOLUME, i] * dsin
            cz += sums[_VOLUME_Z, i] * dcos
            sz += sums[_VOLUME_Z, i] * dsin
            passed = 0.0
            for k in range(4):
                passed += ring[MOTION + k, i] * v[k]
            drift += ring[METRIC, i] * (rate * sums[_GIVEN, i] + sums[_PASSED, i] * passed)
        result[row], result[row + 1], result[row + 2], result[row + 3] = -s, c, -cz, -sz
        layered.drift[side] = -2.0 * np.pi / m * drift


@inner_kernel
def add_residual_tangent(
    layered: LayeredFilm, q: Floats, v: Floats, speed: float, ambient: float, result: Floats
) -> None:
    """Add dF/dq through the pressure, and set dF/dv."""
    prepare_rows(layered.film, speed)
    layered.over_z[:] = 0.0
    for side in range(4):
        _sum_rows(layered, side, ambient)
        _sum_axial(layered, side)
    _set_damping(layered, v, result)
    for k in range(4):
        _contract(layered, q, v, k, result)
