"""V1 on a soft layer, as a solver: with the layer where it gives way, with a rigid bore where it hardly does.

A layer matters where c p is not small against the gap.  By and large, with h the least gap of the rigid bore
and f the film's force there over its unit, over a pressed arc of some 2 sqrt(2 h) ::

    c p / h = soft f / (4 sqrt(2) h^(3/2))

which is half of the largest c p / h over the states of a turbine's run.  Below the lower of `_MATTERS` the
bore is rigid, and the layer would change the force by half a per cent; above the upper one it gives way; in
between the wrench goes smoothly from one to the other.  Near the asperities' reach it always gives way.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import least_gap
from bearing_fmu.contact.contact import sliding_sense
from bearing_fmu.contact.edge import edge_table
from bearing_fmu.contact.layer import layer_table
from bearing_fmu.contact.slice import AREA, CONTACT_RESULTS, FORCE, PRESSURE, WIPED
from bearing_fmu.evaluate import one_kernel
from bearing_fmu.film import Solver
from bearing_fmu.film_with_memory import FilmWithMemory
from bearing_fmu.films.corners import LAYERED_AWAY, LAYERED_SPREAD, leaving, mix, rise
from bearing_fmu.films.tilted.corner_films import GRIDS, PLACE, SHARE, USUAL, tilted_films
from bearing_fmu.films.tilted.deformation import OF_RIGID, ON_LAYER, SPREAD_OUT, forget, remember
from bearing_fmu.films.tilted.layered import CELLS, CLUSTERING, GRADING, STEP, LayeredFilm, layered_film
from bearing_fmu.films.tilted.layered_search import solve_layered
from bearing_fmu.films.tilted.layered_tangent import add_layered_tangent
from bearing_fmu.films.tilted.solve import solve_one, solve_tilted
from bearing_fmu.films.tilted.workspace import STOCK, tilted_film
from bearing_fmu.kernels.axial import axial_basis
from bearing_fmu.kernels.cells import NEAR, axial_cells
from bearing_fmu.kernels.compiled import inner_kernel, stage
from bearing_fmu.kernels.copied import copy
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.result import DAMPING, RESULTS, STIFFNESS
from bearing_fmu.scales import Scales
from bearing_fmu.status import OK

Floats = NDArray[np.float64]

_MATTERS = (0.008, 0.02)
#: Least gap in roughnesses from which on the layer need not give way, and to which it always does.
_CLOSE = (8.0, 16.0)


@inner_kernel
def _gives_way(layered: LayeredFilm, q: Floats, gap: float, result: Floats, change: Floats) -> float:
    """How far the layer takes part, 0 to 1, by the rigid film's `result`; its change by q (4) and v (4)."""
    sigma, soft = layered.constants[1], layered.constants[2]
    force = np.hypot(result[0], result[1])
    measure = soft * force / (4.0 * np.sqrt(2.0) * gap**1.5)
    matters, by_measure = rise(measure, _MATTERS)
    open_, by_gap = rise(gap / sigma, _CLOSE)
    if matters == 0.0 and open_ == 1.0:
        return 0.0
    for k in range(4):
        slope_q = result[0] * result[STIFFNESS + k] + result[1] * result[STIFFNESS + 4 + k]
        slope_v = result[0] * result[DAMPING + k] + result[1] * result[DAMPING + 4 + k]
        scale = measure / (force * force) if force > 0.0 else 0.0
        change[k], change[4 + k] = scale * slope_q, scale * slope_v
    z = 1.0 if np.hypot(q[0] + q[3], q[1] - q[2]) > np.hypot(q[0] - q[3], q[1] + q[2]) else -1.0
    ex, ey = q[0] + z * q[3], q[1] - z * q[2]
    e = max(np.hypot(ex, ey), 1e-12)  # in the middle no direction is the nearer one
    for k in range(8):
        turn = -(ex if k == 0 else ey if k == 1 else -z * ey if k == 2 else z * ex) / e if k < 4 else 0.0
        by_m = by_measure * (change[k] - 1.5 * measure / gap * turn)
        change[k] = by_m * open_ - (1.0 - matters) * by_gap / sigma * turn
    return 1.0 - (1.0 - matters) * open_


@inner_kernel
def _mix_contact(
    usual: Floats, share: float, change: Floats, force: float, half: float, result: Floats, contact: Floats
) -> None:
    """Mix two contacts as `corners.mix` does two films; the tangent of the share goes into the film's."""
    for i in range(CONTACT_RESULTS):
        step = contact[i] - usual[i]
        contact[i] = usual[i] + share * step
        usual[i] = step
    for i in range(4):
        step = usual[FORCE + i] / (force * (1.0 if i < 2 else half))
        for k in range(4):
            result[STIFFNESS + 4 * i + k] += step * change[k]
            result[DAMPING + 4 * i + k] += step * change[4 + k]


@stage
def _solve_soft(
    film: LayeredFilm, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats, contact: Floats
) -> int:
    """Solve with the layer, on the grids that serve."""
    grip = scales.friction * sliding_sense(speed, scales.radius)
    half = 0.5 * scales.width
    change, usual = film.film.blend, film.usual
    share, status = leaving(q, v, speed, LAYERED_AWAY, change), OK
    for spread in range(0 if share < 1.0 else 1, 2 if share > 0.0 else 1):
        part, of = (LAYERED_SPREAD, SPREAD_OUT) if spread == 1 else (GRADING, ON_LAYER)
        status = solve_layered(film, q, v, speed, scales.ambient, scales.sigma, part, of, result)
        if status != OK:
            break
        remember(film, film.film, of, v, scales.ambient)
        contact[:] = 0.0
        add_layered_tangent(film, q, v, speed, scales.ambient, grip, scales.force, half, result, contact)
        if spread == 0 and share > 0.0:
            copy(result, usual[:RESULTS])
            copy(contact, usual[RESULTS:])
    if status == OK and 0.0 < share < 1.0:
        mix(usual[:RESULTS], share, change, result)
        _mix_contact(usual[RESULTS:], share, change, scales.force, half, result, contact)
    return status


@inner_kernel
def _remember_rigid(film: LayeredFilm, scales: Scales, q: Floats, v: Floats, speed: float) -> int:
    """Note how far the film on a rigid bore would press the wall back, on the usual grid."""
    films, status = film.rigid, OK
    if films.shares[USUAL, SHARE] == 0.0 and films.shares[int(films.shares[GRIDS, 0]), PLACE] >= 0.0:
        # only the film of a corner was solved, which keeps its own grid
        status = solve_one(films.usual, None, scales, q, v, speed, 1.0, USUAL, film.stiff)
    if status == OK:
        remember(film, films.usual, OF_RIGID, v, scales.ambient)
    return status


@stage
def _solve_on_layer(
    film: LayeredFilm, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats, contact: Floats
) -> int:
    gap, share = least_gap(None, q)[0], 1.0
    film.change[8] = share
    forget(film)
    if gap > _CLOSE[0] * scales.sigma:
        status = solve_tilted(film.rigid, None, scales, q, v, speed, result)
        if status != OK:
            return status
        share = _gives_way(film, q, gap, result, film.change)
        film.change[8] = share
        if share == 0.0:
            return _remember_rigid(film, scales, q, v, speed)
        copy(result, film.stiff)
    status = _solve_soft(film, scales, q, v, speed, result, contact)
    if status != OK:
        return status
    if share < 1.0:
        mix(film.stiff, share, film.change, result)
    half = 0.5 * scales.width
    contact[PRESSURE] *= scales.hardness
    contact[AREA] *= scales.radius * half
    contact[WIPED] *= scales.radius * half
    return OK


def _prepare(parameters: BearingParameters, space: dict[str, Any]) -> LayeredFilm:
    first, table = layer_table(parameters)
    unit = 6.0 * parameters.viscosity * (parameters.radius / parameters.clearance) ** 2
    aspect, columns, rows = parameters.diameter / parameters.width, parameters.columns, parameters.rows
    cells = axial_cells(max(CELLS * rows, NEAR), CLUSTERING)
    return layered_film(
        tilted_film(columns, rows, aspect, space),
        tilted_films(columns, rows, aspect, space),
        cells,
        aspect,
        cells.means(axial_basis(rows).interpolation),
        first,
        table,
        edge_table(parameters),
        sigma=parameters.roughness / parameters.clearance,
        compliance=parameters.layer_compliance * unit / parameters.clearance,
        hardness=parameters.layer_hardness / unit,
    )


class FilmOnLayer(FilmWithMemory):
    """Prepared evaluator of one bearing on a soft layer, see `bearing_fmu.depths.Film`.

    Its state is how far the wall has given way, see `deformation`; empty before the first evaluation, in
    which the wall is at rest.
    """

    def _advance(
        self, state: Floats, inputs: Floats, offset: Floats, dt: float, out: Floats
    ) -> tuple[int, Floats]:
        """A code of `FilmStatus`, and what is remembered after the step."""
        space, data = self.take()
        try:
            layered: LayeredFilm = data[3]
            layered.time[STEP] = dt if state.size else 0.0
            layered.counts[:] = 0.0
            if state.size:
                layered.then[:] = state.reshape(layered.then.shape)
            status = self._kernel(inputs, offset, out, *data)
            return status, layered.now.flatten()
        finally:
            self.bring_back(space)


LAYERED = Solver(
    name="tilted",
    kernel=one_kernel("layered", _solve_on_layer),
    prepare=_prepare,
    tilts=True,
    stock=STOCK,
)
"""On a soft layer, with the solid contact in its own solution."""
