"""From the port's inputs to a relative state, and from film and contact to the port's outputs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore, least_gap, relative_eccentricity
from bearing_fmu.contact.slice import AREA, FORCE, FORCE_SLOPE, LOAD, PRESSURE, WIPED
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.result import DAMPING, DRAG, FLOW, PEAK, SHEAR, STIFFNESS, WRENCH
from bearing_fmu.scales import Scales
from bearing_fmu.status import NO_SOLUTION, NOT_FINITE, OK

Floats = NDArray[np.float64]

INPUTS, STATE = 17, 12
# Where the groups of the port's outputs begin.
OUT_WRENCH, OUT_F0, OUT_K, OUT_C, OUT_GAP, OUTPUTS = 0, 4, 8, 24, 40, 58
#: Largest rise of the temperature that is told, K: a centred journal lets no oil out.
HOTTEST = 1e3


@inner_kernel
def relative_state(bore: Bore, scales: Scales, inputs: Floats, offset: Floats, state: Floats) -> int:
    """Relative state of journal and bore, and whether it can be evaluated.

    Parameters
    ----------
    inputs : ndarray, shape (17,)
        Port order: journal (q, v), housing (q, v), speed.
    offset : ndarray, shape (4,)
        Bearing centre in the fixed frame.
    state : ndarray, shape (12,)
        Results: q in m and rad; q and v over the clearance, tilts times b/2 over the clearance.

    Returns
    -------
    int
        A code of `FilmStatus`.
    """
    probe = 0.0
    for i in range(INPUTS):
        probe += inputs[i] * 0.0
    for i in range(4):
        probe += offset[i] * 0.0
    if probe != 0.0:
        return NOT_FINITE
    half = 0.5 * scales.width
    for i in range(4):
        lever = 1.0 if i < 2 else half
        q = inputs[i] - inputs[8 + i] - offset[i]
        v = inputs[4 + i] - inputs[12 + i]
        if scales.aligned != 0 and i >= 2:
            q, v = 0.0, 0.0
        state[i] = q
        state[4 + i] = q * lever / scales.clearance
        state[8 + i] = v * lever / scales.clearance
    if not least_gap(bore, state[4:8])[0] > scales.deepest:
        return scales.closes
    return OK


@inner_kernel
def _turning(bore: Bore, scales: Scales, state: Floats, result: Floats) -> float:
    """Integral of h dp/dphi over the film, m: twice the drag of the pressure on the journal.

    In a plain bore it is the moment of the film force about the axis of the bore.
    """
    if bore is None:
        x, y, tx, ty = state[0], state[1], state[2], state[3]
        return x * result[1] - y * result[0] + 0.5 * scales.width * (tx * result[3] - ty * result[2])
    return scales.clearance * result[DRAG]


@inner_kernel
def _forget_tilts(result: Floats, contact: Floats) -> None:
    """Moments and what depends on tilts, where a solver of tilted films serves an aligned one."""
    for i in range(4):
        if i >= 2:
            result[WRENCH + i] = 0.0
            contact[FORCE + i] = 0.0
        for j in range(4):
            if i >= 2 or j >= 2:
                result[STIFFNESS + 4 * i + j] = 0.0
                result[DAMPING + 4 * i + j] = 0.0
                contact[FORCE_SLOPE + 4 * i + j] = 0.0


@inner_kernel
def write_outputs(
    bore: Bore,
    scales: Scales,
    inputs: Floats,
    state: Floats,
    result: Floats,
    contact: Floats,
    draft: Floats,
    out: Floats,
) -> int:
    """Write the port's outputs.

    Parameters
    ----------
    inputs, state
        As in `relative_state`.
    result : ndarray, shape (RESULTS,)
        Film, dimensionless.
    contact : ndarray, shape (CONTACT_RESULTS,)
        Solid contact, SI.
    draft : ndarray, shape (58,)
        Work space.
    out : ndarray, shape (58,)
        Port order; untouched where an output is not finite.

    Returns
    -------
    int
        A code of `FilmStatus`.
    """
    if scales.aligned != 0:
        _forget_tilts(result, contact)
    half = 0.5 * scales.width
    slope = scales.force / scales.clearance
    speed = inputs[16]
    for i in range(4):
        lever = scales.force if i < 2 else scales.force * half
        draft[OUT_WRENCH + i] = lever * result[WRENCH + i] + contact[FORCE + i]
        constant = draft[OUT_WRENCH + i]
        for j in range(4):
            scale = slope * (1.0 if i < 2 else half) * (1.0 if j < 2 else half)
            k = -(scale * result[STIFFNESS + 4 * i + j] + contact[FORCE_SLOPE + 4 * i + j])
            c = -scale * result[DAMPING + 4 * i + j]
            draft[OUT_K + 4 * i + j] = k
            draft[OUT_C + 4 * i + j] = c
            constant += k * (inputs[j] - inputs[8 + j]) + c * (inputs[4 + j] - inputs[12 + j])
        draft[OUT_F0 + i] = constant
    least, z, centre = least_gap(bore, state[4:8])
    turning = _turning(bore, scales, state, result)
    # Film shear on the journal: Couette and Poiseuille.
    couette = scales.viscosity * scales.radius**3 * half / scales.clearance * result[SHEAR] * speed * speed
    grip = scales.friction * abs(speed) * scales.radius * contact[LOAD]
    draft[OUT_GAP] = least * scales.clearance
    draft[OUT_GAP + 1] = centre * scales.clearance
    draft[OUT_GAP + 2] = z * half
    draft[OUT_GAP + 3] = result[PEAK] * scales.pressure
    draft[OUT_GAP + 4] = contact[LOAD]
    for i in range(4):
        draft[OUT_GAP + 5 + i] = contact[FORCE + i]
    draft[OUT_GAP + 9] = couette + 0.5 * speed * scales.force * turning + grip
    draft[OUT_GAP + 10] = relative_eccentricity(bore, state[4:8], centre)
    load = np.hypot(draft[0], draft[1])
    area = 2.0 * scales.radius * scales.width
    rate = scales.viscosity * abs(speed) * area * (scales.radius / scales.clearance) ** 2
    draft[OUT_GAP + 11] = load / rate if rate > 0.0 else 0.0
    draft[OUT_GAP + 12] = contact[PRESSURE]
    draft[OUT_GAP + 13] = max(-least, 0.0) * scales.clearance
    draft[OUT_GAP + 14] = contact[WIPED] / (np.pi * area)
    draft[OUT_GAP + 15] = contact[AREA] / (np.pi * area)
    draft[OUT_GAP + 16] = scales.flow * result[FLOW]
    power, carried = max(draft[OUT_GAP + 9], 0.0), 2.0 * scales.heat * draft[OUT_GAP + 16]
    rise = power / carried if power < HOTTEST * carried else (HOTTEST if power > 0.0 else 0.0)
    draft[OUT_GAP + 17] = scales.supply + rise
    probe = 0.0
    for i in range(OUTPUTS):
        probe += draft[i] * 0.0
    if probe != 0.0:
        return NO_SOLUTION
    for i in range(OUTPUTS):
        out[i] = draft[i]
    return OK
