"""Compiled evaluation of the port: one kernel, made for each film and its contact."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore, least_gap
from bearing_fmu.contact.contact import sliding_sense
from bearing_fmu.contact.slice import CONTACT_RESULTS, LOAD, PRESSURE, largest_pressure
from bearing_fmu.kernels.compiled import variant
from bearing_fmu.outputs import OUTPUTS, STATE, relative_state, write_outputs
from bearing_fmu.result import RESULTS
from bearing_fmu.status import OK

Floats = NDArray[np.float64]
Constants = NDArray[np.void]

# Where the parts of `work` begin.
RESULT = STATE
CONTACT = RESULT + RESULTS
DRAFT = CONTACT + CONTACT_RESULTS
WORK = DRAFT + OUTPUTS


def port_kernel(name: str, solve: Callable[..., int], touch: Callable[..., None]) -> Callable[..., int]:
    """Make the kernel of the port for one film.

    Parameters
    ----------
    name : str
        Of the film.
    solve : kernel
        ``solve(film, bore, scales, q, v, speed, result)`` writes wrench and tangent at the scaled state,
        see `bearing_fmu.result`, and returns a code of `FilmStatus`.
    touch : kernel
        ``touch(bore, scales, table, q, grip, contact)`` adds the solid contact at the position in m and rad.

    Returns
    -------
    kernel
        ``(inputs, offset, out, constants, table, bore, film, work)``: the port's arrays, see
        `Film.solve`; the bearing's constants, contact table and bore; the film's work space; and ``work``,
        which holds in turn the relative state, the results of film and contact, and the draft of the output.
    """

    def evaluate(
        inputs: Floats,
        offset: Floats,
        out: Floats,
        constants: Constants,
        table: Floats,
        bore: Bore,
        film: Any,
        work: Floats,
    ) -> int:
        scales = constants[0]
        state, result, contact, draft = work[:RESULT], work[RESULT:CONTACT], work[CONTACT:DRAFT], work[DRAFT:]
        status = relative_state(bore, scales, inputs, offset, state)
        if status != OK:
            return status
        speed, q, v = inputs[16], state[4:8], state[8:12]
        status = solve(film, bore, scales, q, v, speed, result)
        if status != OK:
            return status
        contact[:] = 0.0
        grip = scales.friction * sliding_sense(speed, scales.radius)
        touch(bore, scales, table, state[:4], grip, contact)
        if contact[LOAD] > 0.0:
            gap = scales.clearance * least_gap(bore, q)[0]
            contact[PRESSURE] = largest_pressure(bore, scales, table, gap)
        return write_outputs(bore, scales, inputs, state, result, contact, draft, out)

    return variant(name, evaluate)


def one_kernel(name: str, solve: Callable[..., int]) -> Callable[..., int]:
    """Make the kernel of the port for a film that solves its solid contact itself.

    Parameters
    ----------
    name : str
        Of the film.
    solve : kernel
        As in `port_kernel`, ``solve(film, scales, q, v, speed, result, contact)``.

    Returns
    -------
    kernel
        As that of `port_kernel`.
    """

    def evaluate(
        inputs: Floats,
        offset: Floats,
        out: Floats,
        constants: Constants,
        table: Floats,
        bore: Bore,
        film: Any,
        work: Floats,
    ) -> int:
        scales = constants[0]
        state, result, contact, draft = work[:RESULT], work[RESULT:CONTACT], work[CONTACT:DRAFT], work[DRAFT:]
        status = relative_state(bore, scales, inputs, offset, state)
        if status != OK:
            return status
        contact[:] = 0.0
        status = solve(film, scales, state[4:8], state[8:12], inputs[16], result, contact)
        if status != OK:
            return status
        return write_outputs(bore, scales, inputs, state, result, contact, draft, out)

    return variant(name, evaluate)
