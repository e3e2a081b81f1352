"""The film of a bearing with tilting pads: as many films as pads, each pad where its own holds it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.pads import Pads
from bearing_fmu.film import Film, Solver
from bearing_fmu.film_with_memory import FilmWithMemory
from bearing_fmu.outputs import OUT_F0, OUT_GAP, OUT_K, OUTPUTS
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.status import OK
from bearing_fmu.tilting.evaluate import ROOM
from bearing_fmu.tilting.pad import ACROSS, COMPLIANCE, alone, pivots
from fmus import port
from fmus.port.variable import Value

Floats = NDArray[np.float64]

_ALL = slice(None)
_AT_ONCE = 1e-6  # of a radian of the rotation: in which pads come to their velocity at the start
_DETAILS = {v.name: OUTPUTS + i for i, v in enumerate(port.BEARING_DETAILS)}
_FIRST_TILT = _DETAILS["pad_tilt[1]"]


class TiltingFilm(FilmWithMemory):
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

    Attributes
    ----------
    pads : list of BearingParameters
        Each pad as a bearing of its own.
    axes : ndarray, shape (pads, 2, 2)
        How the journal moves as seen from a pad with d and with w.
    """

    told = len(_DETAILS)

    def __init__(
        self,
        solver: Solver,
        parameters: BearingParameters,
        offset: Floats | tuple[float, ...] = (0.0,) * 4,
        whirl: float = 0.0,
    ) -> None:
        super().__init__(solver, parameters, offset)
        if solver.pads is None:
            raise ValueError(f"bearing parameter bore: the {solver.name} film knows fixed arcs only")
        self.pads, self._bores = alone(parameters)
        self.whirl = whirl
        self._pivots = pivots(parameters.arcs)
        self.axes = self._pivots[:, ACROSS:COMPLIANCE].reshape(-1, 2, 2)
        self._one, self._kernel_of_pads = Film(solver, self.pads[0]), solver.pads

    @classmethod
    def of(cls, solver: Solver, values: Mapping[str, Value]) -> TiltingFilm:
        """The film of these parameters by the names of the port's variables."""
        offset = tuple(float(values.get(f"offset.{name}", 0.0)) for name in port.POSITION)
        return cls(solver, BearingParameters.of(values), offset, float(values.get(port.WHIRL.name, 0.0)))

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

    def looked_into(
        self, inputs: Floats, tilts: Floats | None
    ) -> Iterator[tuple[BearingParameters, Floats, tuple[Any, ...]]]:
        """The pads one after another, each film as it is solved.

        Parameters
        ----------
        inputs : ndarray, shape (17,)
            Of the port.
        tilts : ndarray, shape (pads,), optional
            Of the pads about their pivots, rad; by default as they stand at rest.  They have the velocities
            with which their films hold them.

        Yields
        ------
        pad, shift, data
            The pad as a bearing of its own; by what it sees the journal moved, m; what `Film.take` gives.
        """
        _, state = self.evaluate(self.rest(), inputs, 0.0)
        places = state.reshape(-1, 2, 2)
        places[:, 1] = 0.0
        if tilts is not None:
            places[:, 0, 0] = self.parameters.radius * tilts
        rate, out = 2.0 * max(abs(float(inputs[16])), 1.0) / _AT_ONCE, np.empty(OUTPUTS)
        for k, pad in enumerate(self.pads):
            space, data = self._one.take()
            try:
                now = np.zeros((1, 2, 2))
                chosen = slice(k, k + 1)
                status = self._evaluate(data, inputs, self.offset, places[chosen], rate, now, out, chosen)
                if status != OK:
                    raise self.failure(status, inputs, self.offset)
                yield pad, now[0, 0] @ self.axes[k], data
            finally:
                self._one.bring_back(space)

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
            moved = inputs[:8] - inputs[8:16]
            k, c = law[:16].reshape(4, 4), law[16:].reshape(4, 4)
            out[OUT_F0:OUT_K] = out[:OUT_F0] + k @ moved[:4] + c @ moved[4:]
        return status, now

    def _balance(
        self, state: Floats, inputs: Floats, offset: Floats, rate: float, out: Floats
    ) -> tuple[int, Floats]:
        """Bring all pads in balance and add up what they give; `rate` is 2/dt, or 0 at rest."""
        shape = len(self.pads), 2, 2
        # a copy, since to numba a state that was read from bytes and cannot be written is of another type
        then, now = np.array(state).reshape(shape) if state.size else np.zeros(shape), np.zeros(shape)
        space, data = self._one.take()
        try:
            status = self._evaluate(data, inputs, offset, then, rate, now, out[:OUTPUTS])
        finally:
            self._one.bring_back(space)
        if status != OK:
            return status, state
        out[_FIRST_TILT : _FIRST_TILT + shape[0]] = now[:, 0, 0] / self.parameters.radius
        return OK, now.ravel()

    def _evaluate(
        self,
        data: tuple[Any, ...],
        inputs: Floats,
        offset: Floats,
        then: Floats,
        rate: float,
        now: Floats,
        out: Floats,
        chosen: slice = _ALL,
    ) -> int:
        """Call the kernel for some of the pads; a code of `FilmStatus`."""
        constants, table, _, film, work = data
        pivots, bores = self._pivots[chosen], self._bores
        if chosen is not _ALL:
            bores = Pads._make(field[chosen] for field in bores)
        settings = rate, self.whirl, self.parameters.friction
        room = np.zeros(ROOM), np.zeros((5, 4, 4), np.complex128)
        return int(
            self._kernel_of_pads(
                inputs, offset, then, *settings, pivots, bores, constants, table, film, work, *room, now, out
            )
        )
