"""V1 with a mass-conserving film: its solver, and the film with memory."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore, bore_of
from bearing_fmu.contact.contact import add_tilted
from bearing_fmu.evaluate import port_kernel
from bearing_fmu.film import Solver
from bearing_fmu.film_with_memory import FilmWithMemory
from bearing_fmu.films.jfo.network import balance
from bearing_fmu.films.jfo.reynolds import conclude, set_up
from bearing_fmu.films.jfo.tangent import add_jfo_tangent
from bearing_fmu.films.jfo.workspace import ENDS, FEED, FULL, GROOVE, STEP, JfoFilm, jfo_film
from bearing_fmu.films.tilted.workspace import STOCK
from bearing_fmu.kernels.compiled import stage
from bearing_fmu.outputs import OUTPUTS
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.result import FLOW
from bearing_fmu.scales import Scales
from bearing_fmu.status import NOT_CONVERGED, OK
from bearing_fmu.stock import bring_back

Floats = NDArray[np.float64]

_FILLINGS = 300
_EVEN = 1e-9


@stage
def _solve(
    film: JfoFilm, bore: Bore, scales: Scales, q: Floats, v: Floats, speed: float, result: Floats
) -> int:
    reynolds = scales.reynolds * abs(speed)
    set_up(film, bore, q, v, speed, scales.ambient, scales.feed, scales.sigma, reynolds)
    status, _ = balance(film.net)
    if status == OK:
        conclude(film, bore, reynolds, result)
        result[FLOW] = max(film.flows[ENDS], 0.0)
        add_jfo_tangent(film, bore, q, v, speed, result)
    return status


def _prepare(parameters: BearingParameters, space: dict[str, Any]) -> JfoFilm:
    bore = bore_of(parameters.arcs, parameters.columns)
    held = np.zeros(0, dtype=np.int64) if bore is None else bore.held
    aspect = parameters.diameter / parameters.width
    unit = 0.25 * parameters.clearance * parameters.radius * parameters.width
    supply = parameters.feed_content, parameters.feed_flow / unit
    return jfo_film(parameters.columns, parameters.rows, aspect, held, supply, space)


SOLVER = Solver(
    name="mass-conserving",
    kernel=port_kernel("jfo", _solve, add_tilted),
    prepare=_prepare,
    tilts=True,
    bores=True,
    boundaries=("jfo",),
    stock=STOCK,
)


class ConservingFilm(FilmWithMemory):
    """Prepared evaluator of one bearing with a mass-conserving film, see `bearing_fmu.depths.Film`.

    Its state is what `films.jfo.content` remembers; empty before the first evaluation.
    """

    told = 2  # share of full film, oil from the grooves

    def _advance(
        self, state: Floats, inputs: Floats, offset: Floats, dt: float, out: Floats
    ) -> tuple[int, Floats]:
        """A code of `FilmStatus`, and what is remembered after the step."""
        space, data = self.take()
        try:
            jfo: JfoFilm = data[3]
            jfo.time[STEP] = dt if state.size else 0.0
            jfo.supply[0] = self.parameters.feed_content
            if state.size and dt > 0.0:
                jfo.then[:] = state
                if jfo.supply[1] > 0.0:
                    jfo.supply[0] = state[GROOVE]
            status = self._kernel(inputs, offset, out, *data)
            if jfo.time[STEP] == 0.0 and jfo.supply[1] > 0.0:
                status = self._fill_grooves(status, inputs, offset, out, data)
            if out.size > OUTPUTS:
                p = self.parameters
                out[OUTPUTS:] = jfo.flows[FULL], 0.25 * p.clearance * p.radius * p.width * jfo.flows[FEED]
            return status, jfo.now.copy()
        finally:
            bring_back(self._free, space)

    def _fill_grooves(
        self, status: int, inputs: Floats, offset: Floats, out: Floats, data: tuple[Any, ...]
    ) -> int:
        """Repeat an evaluation in balance until the content of the grooves belongs to their feed."""
        jfo: JfoFilm = data[3]
        for _ in range(_FILLINGS):
            before, jfo.supply[0] = jfo.supply[0], jfo.now[GROOVE]
            if status != OK or abs(jfo.supply[0] - before) < _EVEN:
                return status
            status = self._kernel(inputs, offset, out, *data)
        return NOT_CONVERGED
