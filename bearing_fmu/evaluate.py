"""Compiled evaluation of the port at each modelling depth.

All kernels take the port's arrays, the bearing's constants and contact table, the film's work space
and `work`, which holds in turn the relative state, the results of film and contact, and the draft of
the output.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.contact import CONTACT_RESULTS, add_slice, add_tilted, sliding_sense
from bearing_fmu.films.aligned.aligned import AlignedFilm, solve_aligned
from bearing_fmu.films.short.short import solve_short
from bearing_fmu.films.tilted.reynolds import solve_pressure
from bearing_fmu.films.tilted.tangent import add_tangent
from bearing_fmu.films.tilted.workspace import RESULTS, TiltedFilm
from bearing_fmu.kernels.compiled import kernel
from bearing_fmu.outputs import OUTPUTS, STATE, relative_state, write_outputs
from bearing_fmu.status import NO_SOLUTION, OK

Floats = NDArray[np.float64]
Constants = NDArray[np.void]

# Where the parts of `work` begin.
RESULT = STATE
CONTACT = RESULT + RESULTS
DRAFT = CONTACT + CONTACT_RESULTS
WORK = DRAFT + OUTPUTS


@kernel
def evaluate_v1(
    inputs: Floats,
    offset: Floats,
    out: Floats,
    constants: Constants,
    table: Floats,
    film: TiltedFilm,
    work: Floats,
) -> int:
    """V1: Reynolds equation and contact over the tilted gap."""
    scales = constants[0]
    state, result, contact, draft = work[:RESULT], work[RESULT:CONTACT], work[CONTACT:DRAFT], work[DRAFT:]
    status = relative_state(scales, inputs, offset, state)
    if status != OK:
        return status
    speed, q, v = inputs[16], state[4:8], state[8:12]
    status = solve_pressure(film, q, v, speed, scales.ambient, scales.sigma, scales.ruptures, result)
    if status != OK:
        return status
    add_tangent(film, q, v, speed, result)
    contact[:] = 0.0
    grip = scales.friction * sliding_sense(speed, scales.radius)
    add_tilted(scales, table, state[:4], grip, contact)
    return write_outputs(scales, inputs, state, result, contact, draft, out)


@kernel
def evaluate_v2(
    inputs: Floats,
    offset: Floats,
    out: Floats,
    constants: Constants,
    table: Floats,
    film: AlignedFilm,
    work: Floats,
) -> int:
    """V2: Reynolds equation and contact over the aligned gap."""
    scales = constants[0]
    state, result, contact, draft = work[:RESULT], work[RESULT:CONTACT], work[CONTACT:DRAFT], work[DRAFT:]
    status = relative_state(scales, inputs, offset, state)
    if status != OK:
        return status
    speed, q, v = inputs[16], state[4:8], state[8:12]
    if not solve_aligned(film, q, v, speed, scales.ambient, scales.sigma, result):
        return NO_SOLUTION
    contact[:] = 0.0
    grip = scales.friction * sliding_sense(speed, scales.radius)
    add_slice(scales, table, state[0], state[1], 0.0, scales.width, grip, contact)
    return write_outputs(scales, inputs, state, result, contact, draft, out)


@kernel
def evaluate_v3(
    inputs: Floats,
    offset: Floats,
    out: Floats,
    constants: Constants,
    table: Floats,
    film: Floats,
    work: Floats,
) -> int:
    """V3: short bearing and contact over the aligned gap."""
    scales = constants[0]
    state, result, contact, draft = work[:RESULT], work[RESULT:CONTACT], work[CONTACT:DRAFT], work[DRAFT:]
    status = relative_state(scales, inputs, offset, state)
    if status != OK:
        return status
    speed, q, v = inputs[16], state[4:8], state[8:12]
    solve_short(q, v, speed, scales.ambient, scales.sigma, scales.slenderness, film, result)
    contact[:] = 0.0
    grip = scales.friction * sliding_sense(speed, scales.radius)
    add_slice(scales, table, state[0], state[1], 0.0, scales.width, grip, contact)
    return write_outputs(scales, inputs, state, result, contact, draft, out)
