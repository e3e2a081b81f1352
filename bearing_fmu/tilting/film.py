"""The film of a bearing with tilting pads: as many films as pads, each pad where its own holds it."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.pads import cells_of
from bearing_fmu.contact.contact import CREEP
from bearing_fmu.contact.slice import FORCE_SLOPE
from bearing_fmu.evaluate import CONTACT
from bearing_fmu.film import Film, Solver
from bearing_fmu.outputs import HOTTEST, OUT_C, OUT_F0, OUT_GAP, OUT_K, OUTPUTS
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.status import NO_SOLUTION, OK
from bearing_fmu.tilting.balance import Balance
from bearing_fmu.tilting.condense import add_condensed
from bearing_fmu.tilting.pad import Pad
from fmus import port
from fmus.port.variable import Value

Floats = NDArray[np.float64]

_NOTHING = 1e-12
_AT_ONCE = 1e-6  # of a radian of the rotation: in which pads come to their velocity at the start
_DETAILS = {v.name: OUTPUTS + i for i, v in enumerate(port.BEARING_DETAILS)}
_FIRST_TILT = _DETAILS["pad_tilt[1]"]
# Among the outputs from `OUT_GAP` on: what is the largest of all pads', and what their sum.
_LARGEST, _SUMS = (3, 12, 13), (4, 14, 15, 16)
_TOUCH = slice(CONTACT + FORCE_SLOPE, CONTACT + FORCE_SLOPE + 16)


class TiltingFilm(Film):
    """Prepared evaluator of one bearing with tilting pads, see `bearing_fmu.depths.Film`.

    Its state holds d and w of each pad, and their velocities; it is empty before the first evaluation.  Then
    the pads are in balance at rest, and get the velocities with which the journal's moves them.

    Parameters
    ----------
    solver, parameters, offset
        As of `Film`.
    whirl : float
        Frequency over the speed of the small motions for which stiffness and damping at the start hold, see
        `bearing_fmu.tilting.condense`.
    """

    def __init__(
        self,
        solver: Solver,
        parameters: BearingParameters,
        offset: Floats | tuple[float, ...] = (0.0,) * 4,
        whirl: float = 0.0,
    ) -> None:
        super().__init__(solver, parameters, offset)
        cells, _ = cells_of(parameters.arcs, parameters.columns)
        self.pads = [Pad(solver, parameters, a, n) for a, n in zip(parameters.arcs, cells, strict=True)]
        self.whirl = whirl
        self._axes = np.array([pad.axes for pad in self.pads])
        p = parameters
        self._unit = 6.0 * p.viscosity * (p.radius / p.clearance) ** 2 * p.radius * 0.5 * p.width

    @classmethod
    def of(cls, solver: Solver, values: Mapping[str, Value]) -> TiltingFilm:
        """The film of these parameters by the names of the port's variables."""
        offset = tuple(float(values.get(f"offset.{name}", 0.0)) for name in port.POSITION)
        return cls(solver, BearingParameters.of(values), offset, float(values.get(port.WHIRL.name, 0.0)))

    def evaluate(self, state: Floats, inputs: Floats, dt: float) -> tuple[Floats, Floats]:
        """Evaluate the port at the end of a step, see `bearing_fmu.depths.Film.evaluate`."""
        out = np.zeros(OUTPUTS + len(_DETAILS))
        status, now = self._advance(state, inputs, self.offset, dt, out)
        if status:
            raise self.failure(status, inputs, self.offset)
        return out, now

    def solve(self, inputs: Floats, offset: Floats, out: Floats) -> int:
        """Evaluate the port with the pads in balance, see `Film.solve`."""
        whole = np.zeros(OUTPUTS + len(_DETAILS))
        status, _ = self._advance(self.rest(), inputs, offset, 0.0, whole)
        if status == OK:
            out[:] = whole[: out.size]
        return status

    def places(self, q: Floats, speed: float) -> Floats:
        """D and w of the pads in balance at a position (4,) of the journal at rest, shape (pads, 2), m."""
        inputs = np.zeros(len(port.BEARING_INPUTS))
        inputs[:4], inputs[16] = np.asarray(q) + self.offset, speed
        _, state = self.evaluate(self.rest(), inputs, 0.0)
        return state.reshape(-1, 2, 2)[:, 0]

    def _advance(
        self, state: Floats, inputs: Floats, offset: Floats, dt: float, out: Floats
    ) -> tuple[int, Floats]:
        """A code of `FilmStatus`, and the state after the step."""
        if state.size and dt > 0.0:
            return self._balance(state, inputs, offset, 2.0 / dt, out)
        still = inputs.copy()
        still[4:8] = still[12:16] = 0.0
        status, now = self._balance(self.rest(), still, offset, 0.0, out)
        if status == OK and np.any(inputs[4:8] != inputs[12:16]):
            law = out[OUT_K:OUT_GAP].copy()
            rate = 2.0 * max(abs(float(inputs[16])), 1.0) / _AT_ONCE
            status, now = self._balance(now, inputs, offset, rate, out)
            out[OUT_K:OUT_GAP] = law
            self._set_constant(inputs, out)
        return status, now

    def _balance(
        self, state: Floats, inputs: Floats, offset: Floats, rate: float, out: Floats
    ) -> tuple[int, Floats]:
        """Bring all pads in balance and add up what they give; `rate` is 2/dt, or 0 at rest."""
        pads, p, speed = len(self.pads), self.parameters, float(inputs[16])
        then = state.reshape(pads, 2, 2) if state.size else np.zeros((pads, 2, 2))
        now = np.zeros((pads, 2, 2))
        creeping = float(np.abs(inputs[4:6] - inputs[12:14]).max()) / p.clearance
        nothing = _NOTHING * self._unit * max(abs(speed), creeping)
        slides = speed * p.radius
        grip = p.friction * slides / math.hypot(slides, CREEP)
        frequency = self.whirl * abs(speed)
        out[:] = 0.0
        out[OUT_GAP : OUT_GAP + 2] = np.inf
        for k, pad in enumerate(self.pads):
            anchor = then[k, 0] + then[k, 1] / rate if rate > 0.0 else then[k, 0]
            d, w = (2.0 * anchor - then[k, 0]).tolist()  # as the velocity takes it on
            balance = Balance(pad, inputs, offset, rate, (anchor[0], anchor[1]), nothing)
            space, data = pad.film.take()
            try:
                status, *place = balance.settle(d, w, data)
                if status != OK:
                    return status, state
                now[k, 0] = place
                axes, touch = self._axes[k], data[-1][_TOUCH]
                add_condensed(balance.out, touch, axes, pad.compliance, now[k, 0], rate, grip, frequency, out)
            finally:
                pad.film.bring_back(space)
            self._add(balance.out[OUT_GAP:], grip, abs(slides), out[OUT_GAP:OUTPUTS])
            now[k, 1] = rate * (now[k, 0] - anchor)
            out[_FIRST_TILT + k] = now[k, 0, 0] / p.radius
        self._set_constant(inputs, out)
        self._conclude(inputs, offset, out)
        if not np.isfinite(out).all():
            return NO_SOLUTION, state
        return OK, now.ravel()

    def _add(self, one: Floats, grip: float, slides: float, total: Floats) -> None:
        """Add to the bearing what a pad's film tells beside its law."""
        if one[0] < total[0]:
            total[0], total[2] = one[0], one[2]
        total[1] = min(total[1], one[1])
        for i in _LARGEST:
            total[i] = max(total[i], one[i])
        for i in _SUMS:
            total[i] += one[i]
        for i, (other, sign) in enumerate(((6, -grip), (5, grip), (8, -grip), (7, grip)), start=5):
            total[i] += one[i] + sign * one[other]
        total[9] += one[9] + self.parameters.friction * slides * one[4]

    def _set_constant(self, inputs: Floats, out: Floats) -> None:
        """F0 of the law."""
        relative = inputs[:8] - inputs[8:16]
        out[OUT_F0:OUT_K] = (
            out[:OUT_F0]
            + out[OUT_K:OUT_C].reshape(4, 4) @ relative[:4]
            + out[OUT_C:OUT_GAP].reshape(4, 4) @ relative[4:]
        )

    def _conclude(self, inputs: Floats, offset: Floats, out: Floats) -> None:
        """Eccentricity, Sommerfeld number and temperature of the whole bearing."""
        p, speed = self.parameters, abs(float(inputs[16]))
        told = out[OUT_GAP:OUTPUTS]
        told[10] = math.hypot(*(inputs[:2] - inputs[8:10] - offset[:2])) / p.clearance
        rate = p.viscosity * speed * p.width * p.diameter * (p.radius / p.clearance) ** 2
        told[11] = math.hypot(out[0], out[1]) / rate if rate > 0.0 else 0.0
        power, carried = max(told[9], 0.0), 2.0 * p.density * p.heat_capacity * told[16]
        rise = power / carried if power < HOTTEST * carried else (HOTTEST if power > 0.0 else 0.0)
        told[17] = p.supply_temperature + rise
