"""Compiled evaluation of a bearing with tilting pads: all pads one after another in one work space."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import least_gap
from bearing_fmu.bore.pads import Pads
from bearing_fmu.contact.contact import sliding_sense
from bearing_fmu.contact.slice import LOAD, PRESSURE, largest_pressure
from bearing_fmu.evaluate import CONTACT, DRAFT, RESULT
from bearing_fmu.kernels.compiled import inner_kernel, stage, variant
from bearing_fmu.kernels.copied import copy
from bearing_fmu.outputs import (
    HOTTEST,
    INPUTS,
    OUT_C,
    OUT_F0,
    OUT_GAP,
    OUT_K,
    OUTPUTS,
    relative_state,
    write_outputs,
)
from bearing_fmu.scales import Scales
from bearing_fmu.status import NO_SOLUTION, NOT_FINITE, OK
from bearing_fmu.tilting.condense import add_condensed
from bearing_fmu.tilting.pad import ACROSS, TOWARDS, Pivot
from bearing_fmu.tilting.search import GO_ON, SEARCH, SHARE, D, Seat, W, begin, proceed

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
Constants = NDArray[np.void]

_NOTHING = 1e-12
# Where the parts of the work space begin.
_SEEN = SEARCH
_PLACE = _SEEN + INPUTS
_ANCHOR = _PLACE + 4
_TOLD = _ANCHOR + 2
ROOM = _TOLD + OUTPUTS
# Among the outputs from `OUT_GAP` on: pressures, of which the largest counts, and what adds up.
_PRESSURES, _OVERLAP, _SUMS = (3, 12), 13, (4, 14, 15, 16)


@inner_kernel
def _begin(scales: Scales, inputs: Floats, offset: Floats, q: Floats, out: Floats) -> float:
    """Position of the journal in the bore; outputs to add to; the force that counts as none, N.

    Not finite where an input is not.
    """
    for i in range(4):
        q[i] = inputs[i] - inputs[8 + i] - offset[i] if scales.aligned == 0 or i < 2 else 0.0
    out[:] = 0.0
    out[OUT_GAP : OUT_GAP + 2] = np.inf
    creeping = max(abs(inputs[4] - inputs[12]), abs(inputs[5] - inputs[13])) / scales.clearance
    probe = 0.0
    for i in range(INPUTS):
        probe += inputs[i] * 0.0
    return _NOTHING * scales.force * max(abs(inputs[16]), creeping) + probe


@inner_kernel
def _moved(pivot: Pivot, inputs: Floats, search: Floats, rate: float, anchor: Floats, seen: Floats) -> None:
    """The inputs as a pad at its place sees them."""
    d, w = search[D], search[W]
    fast_d, fast_w = rate * (d - anchor[0]), rate * (w - anchor[1])
    copy(inputs, seen)
    for i in range(2):
        seen[i] += d * pivot[ACROSS + i] + w * pivot[TOWARDS + i]
        seen[4 + i] += fast_d * pivot[ACROSS + i] + fast_w * pivot[TOWARDS + i]


@stage
def _pad_of(pads: Pads, k: int) -> Pads:
    """The bore of one pad alone."""
    return Pads(
        pads.shift[k],
        pads.ends[k],
        pads.edges[k],
        pads.first[k],
        pads.cells[k],
        pads.centre[k],
        pads.inside[k],
        pads.deep[k],
        pads.reach[k],
        pads.fed[k],
        pads.held[k],
        pads.rest[k],
    )


@inner_kernel
def _add_told(one: Floats, grip: float, rubs: float, share: float, total: Floats) -> None:
    """Add to the bearing what a pad's film tells beside its law, and of which a share counts."""
    if one[0] < total[0]:
        total[0], total[2] = one[0], one[2]
    total[1] = min(total[1], one[1])
    total[_OVERLAP] = max(total[_OVERLAP], one[_OVERLAP])
    for i in _PRESSURES:
        total[i] = max(total[i], share * one[i])
    for i in _SUMS:
        total[i] += share * one[i]
    for i in range(4):
        other, sign = (i + 1, -1.0) if i % 2 == 0 else (i - 1, 1.0)
        total[5 + i] += share * (one[5 + i] + sign * grip * one[5 + other])
    total[9] += one[9] + share * rubs * one[4]  # oil in its gap is sheared whether it holds the pad or not


@inner_kernel
def _conclude(scales: Scales, inputs: Floats, q: Floats, out: Floats) -> int:
    """F0 of the law; eccentricity, Sommerfeld number and temperature of the whole bearing."""
    speed = abs(inputs[16])
    for i in range(4):
        constant = out[i]
        for j in range(4):
            constant += out[OUT_K + 4 * i + j] * (inputs[j] - inputs[8 + j])
            constant += out[OUT_C + 4 * i + j] * (inputs[4 + j] - inputs[12 + j])
        out[OUT_F0 + i] = constant
    told = out[OUT_GAP:OUTPUTS]
    told[10] = np.hypot(q[0], q[1]) / scales.clearance
    area = 2.0 * scales.radius * scales.width
    rate = scales.viscosity * speed * area * (scales.radius / scales.clearance) ** 2
    told[11] = np.hypot(out[0], out[1]) / rate if rate > 0.0 else 0.0
    power, carried = max(told[9], 0.0), 2.0 * scales.heat * told[16]
    rise = power / carried if power < HOTTEST * carried else (HOTTEST if power > 0.0 else 0.0)
    told[17] = scales.supply + rise
    probe = 0.0
    for i in range(OUTPUTS):
        probe += out[i] * 0.0
    return OK if probe == 0.0 else NO_SOLUTION


def pads_kernel(name: str, solve: Callable[..., int], touch: Callable[..., None]) -> Callable[..., int]:
    """Make the kernel of a bearing with tilting pads for one film.

    Parameters
    ----------
    name, solve, touch
        As of `bearing_fmu.evaluate.port_kernel`.

    Returns
    -------
    kernel
        ``(inputs, offset, state, rate, whirl, friction, pivots, pads, constants, table, film, work, room,
        matrices, now, out)``: the port's inputs and the bearing's offset; d, w and their velocities of each
        pad, shape (pads, 2, 2); 2/dt, or 0 at rest; frequency over the speed of the motions for which
        stiffness and damping at rest hold; friction coefficient; pivots and bores of the pads, see `pad`;
        constants, table, film and work as of `port_kernel`, of one pad; zeros to work in, shapes (ROOM,) and
        (5, 4, 4); results: the state after the step, and the port's outputs.
    """

    def evaluate_pads(
        inputs: Floats,
        offset: Floats,
        state: Floats,
        rate: float,
        whirl: float,
        friction: float,
        pivots: Floats,
        pads: Pads,
        constants: Constants,
        table: Floats,
        film: Any,
        work: Floats,
        room: Floats,
        matrices: Complex,
        now: Floats,
        out: Floats,
    ) -> int:
        scales = constants[0]
        own, result, contact, draft = work[:RESULT], work[RESULT:CONTACT], work[CONTACT:DRAFT], work[DRAFT:]
        search, seen, q = room[:_SEEN], room[_SEEN:_PLACE], room[_PLACE:_ANCHOR]
        anchor, told, speed = room[_ANCHOR:_TOLD], room[_TOLD:], inputs[16]
        sense, grip = 1.0 if speed >= 0.0 else -1.0, friction * sliding_sense(speed, scales.radius)
        nothing = _begin(scales, inputs, offset, q, out)
        if nothing != nothing:
            return NOT_FINITE
        for k in range(pivots.shape[0]):
            pivot, bore = pivots[k], _pad_of(pads, k)
            seat = Seat(pivot, scales, q, rate, sense, nothing)
            for i in range(2):
                anchor[i] = state[k, 0, i] + (state[k, 1, i] / rate if rate > 0.0 else 0.0)
                search[D + i] = 2.0 * anchor[i] - state[k, 0, i]  # as the velocity takes it on
            went = begin(search, seat)
            while went == GO_ON:
                _moved(pivot, inputs, search, rate, anchor, seen)
                status = relative_state(bore, scales, seen, offset, own)
                if status == OK:
                    status = solve(film, bore, scales, own[4:8], own[8:12], speed, result)
                if status == OK:
                    contact[:] = 0.0
                    touch(bore, scales, table, own[:4], 0.0, contact)
                    if contact[LOAD] > 0.0:
                        gap = scales.clearance * least_gap(bore, own[4:8])[0]
                        contact[PRESSURE] = largest_pressure(bore, scales, table, gap)
                    status = write_outputs(bore, scales, seen, own, result, contact, draft, told)
                went = proceed(search, status, told, seat)
            if went != OK:
                return went
            add_condensed(told, contact, pivot, search, rate, grip, whirl * abs(speed), matrices, out)
            rubs = friction * abs(speed) * scales.radius
            _add_told(told[OUT_GAP:], grip, rubs, search[SHARE], out[OUT_GAP:])
            for i in range(2):
                now[k, 0, i] = search[D + i]
                now[k, 1, i] = rate * (search[D + i] - anchor[i])
        return _conclude(scales, inputs, q, out)

    return variant(name, evaluate_pads)
