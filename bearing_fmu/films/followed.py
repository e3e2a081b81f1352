"""A film whose oil warms and cools in time: one without memory, at the temperature of a first-order balance.

What friction makes and the oil does not carry away stays in it ::

    C_T dT/dt = P - 2 rho c Q (T - T_s)

with friction power P, side flow Q and the temperature T of the film, the mean of supply and outlet as in
ISO 7902-1: in steady state T = T_s + P / (2 rho c Q), the balance that is otherwise held.  C_T is what
warms with the film, without another figure the oil of the centred gap.  Over a step P and Q are those of its
beginning, with which the balance is solved exactly; the state is T, P and Q.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.film import Film, Solver
from bearing_fmu.outputs import OUT_GAP, OUTPUTS
from bearing_fmu.status import OK
from fmus.port import Oil
from fmus.port.variable import Value

Floats = NDArray[np.float64]

_POWER, _FLOW, _TEMPERATURE = OUT_GAP + 9, OUT_GAP + 16, OUT_GAP + 17
# Constants of the kernels by the power of the viscosity that goes with them.
_GROWING, _FALLING = ("viscosity", "pressure", "force"), ("ambient", "feed", "reynolds")


class FollowedFilm(Film):
    """Prepared evaluator of one bearing whose oil has a temperature of its own, see `Film`.

    The state is empty before the first evaluation, which takes the temperature of the viscosity given.
    """

    def evaluate(self, state: Floats, inputs: Floats, dt: float) -> tuple[Floats, Floats]:
        """Evaluate the port at the end of a step, see `bearing_fmu.depths.Film.evaluate`."""
        temperature = self._begin if not state.size else self._warmed(state, dt)
        out = np.empty(OUTPUTS)
        status = self._solve_at(temperature, inputs, self.offset, out)
        if status:
            raise self.failure(status, inputs, self.offset)
        return out, np.array([temperature, max(out[_POWER], 0.0), out[_FLOW]])

    def solve(self, inputs: Floats, offset: Floats, out: Floats) -> int:
        """Evaluate the port at the temperature of the viscosity given, see `Film.solve`."""
        return self._solve_at(self._begin, inputs, offset, out)

    @property
    def _oil(self) -> Oil:
        return Oil(self.parameters.viscosity_40, self.parameters.viscosity_100)

    @property
    def _begin(self) -> float:
        """Temperature at which the oil has the viscosity of the parameters, K."""
        return self._oil.temperature(self.parameters.viscosity / self.parameters.density)

    def _warmed(self, state: Floats, dt: float) -> float:
        """Temperature after a step, K."""
        temperature, power, flow = (float(number) for number in state)
        p = self.parameters
        carried, stored = 2.0 * p.density * p.heat_capacity * flow, p.stored_heat
        rate = carried * dt / stored
        # (1 - exp(-rate)) / rate, which is 1 where no oil leaves
        share = -math.expm1(-rate) / rate if rate > 0.0 else 1.0
        return temperature + share * dt / stored * (power - carried * (temperature - p.supply_temperature))

    def _solve_at(self, temperature: float, inputs: Floats, offset: Floats, out: Floats) -> int:
        """A code of `FilmStatus`; the constants are the call's own, the work space is nobody else's."""
        ratio = self._oil.dynamic(temperature, self.parameters.density) / self.parameters.viscosity
        space, (constants, *rest) = self.take()
        try:
            constants = constants.copy()
            for name in _GROWING:
                constants[name] *= ratio
            for name in _FALLING:
                constants[name] /= ratio
            status: int = self._kernel(inputs, offset, out, constants, *rest)
        finally:
            self.bring_back(space)
        if status == OK:
            out[_TEMPERATURE] = temperature
        return status


def film_of(solver: Solver, values: Mapping[str, Value]) -> Film:
    """The film of these parameters by the names of the port's variables, its oil held or followed."""
    followed = values.get("film.temperature", "held") == "followed"
    return (FollowedFilm if followed else Film).of(solver, values)
