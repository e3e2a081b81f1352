"""Compiled evaluation of the port at each modelling depth."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from bearing_fmu.aligned import AlignedFilm, solve_aligned
from bearing_fmu.contact import add_slice, add_tilted, sliding_sense
from bearing_fmu.greenwood_tripp import SliceTable
from bearing_fmu.outputs import NO_SOLUTION, Scales, relative_state, write_outputs
from bearing_fmu.reynolds import solve_pressure
from bearing_fmu.short import solve_short
from bearing_fmu.tangent import add_tangent
from bearing_fmu.tilted_film import TiltedFilm

Floats = NDArray[np.float64]


@njit(cache=True, nogil=True)
def evaluate_v1(
    inputs: Floats,
    offset: Floats,
    out: Floats,
    scales: Scales,
    table: SliceTable,
    film: TiltedFilm,
    state: Floats,
    result: Floats,
    contact: Floats,
) -> int:
    """V1: Reynolds equation and contact over the tilted gap."""
    status = relative_state(scales, inputs, offset, state)
    if status != 0:
        return status
    speed = inputs[16]
    q, v = state[4:8], state[8:12]
    if not solve_pressure(film, q, v, speed, scales.ambient, scales.sigma, result):
        return NO_SOLUTION
    add_tangent(film, q, v, speed, result)
    contact[:] = 0.0
    grip = scales.friction * sliding_sense(speed, scales.radius)
    add_tilted(table, state[:4], scales.width, grip, contact)
    return write_outputs(scales, inputs, state, result, contact, out)


@njit(cache=True, nogil=True)
def evaluate_v2(
    inputs: Floats,
    offset: Floats,
    out: Floats,
    scales: Scales,
    table: SliceTable,
    film: AlignedFilm,
    state: Floats,
    result: Floats,
    contact: Floats,
) -> int:
    """V2: Reynolds equation and contact over the aligned gap."""
    status = relative_state(scales, inputs, offset, state)
    if status != 0:
        return status
    speed = inputs[16]
    if not solve_aligned(film, state[4:8], state[8:12], speed, scales.ambient, scales.sigma, result):
        return NO_SOLUTION
    contact[:] = 0.0
    grip = scales.friction * sliding_sense(speed, scales.radius)
    add_slice(table, state[0], state[1], 0.0, scales.width, grip, contact)
    return write_outputs(scales, inputs, state, result, contact, out)


@njit(cache=True, nogil=True)
def evaluate_v3(
    inputs: Floats,
    offset: Floats,
    out: Floats,
    scales: Scales,
    table: SliceTable,
    work: Floats,
    state: Floats,
    result: Floats,
    contact: Floats,
) -> int:
    """V3: short bearing and contact over the aligned gap."""
    status = relative_state(scales, inputs, offset, state)
    if status != 0:
        return status
    speed = inputs[16]
    ratio = (0.5 * scales.width / scales.radius) ** 2
    solve_short(state[4:8], state[8:12], speed, scales.sigma, ratio, work, result)
    contact[:] = 0.0
    grip = scales.friction * sliding_sense(speed, scales.radius)
    add_slice(table, state[0], state[1], 0.0, scales.width, grip, contact)
    return write_outputs(scales, inputs, state, result, contact, out)
