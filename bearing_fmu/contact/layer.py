"""The soft layer of a bearing: it gives way under the film and the asperities, and yields at its hardness.

Under a pressure p that is wide against its thickness t the surface of a layer on a stiff back recedes by ::

    c p,   c = (1 + nu) (1 - 2 nu) / (1 - nu) t / E

(a thin bonded layer; Johnson 1985, Contact Mechanics, Eq. 5.70), and so does the gap between the mean lines,
h = s + c p_a(h), with s the rigid gap plus c times the film's pressure.  The asperities press by Greenwood
and Tripp up to the hardness H of the softer metal, p_a = p_GT / (1 + (p_GT / H)^4)^(1/4).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.asperities import REACH, asperity_integral
from bearing_fmu.contact.cubic_spline import spline_coefficients
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.parameters import BearingParameters

Floats = NDArray[np.float64]

STEP = 0.05  #: of tables, in roughnesses
_SHARPNESS = 4.0
#: Bounded pressure over the hardness where the asperities alone would press with the hardness.
YIELDING = 2.0 ** (-1.0 / _SHARPNESS)

#: Gap in roughnesses down to which Patir and Cheng (1978) give their flow factor.
PUBLISHED = 0.5
_FACTOR, _DECAY = 0.90, 0.56
_OPEN = 32.0  # from here on the factor is 1 to 2e-8
_AT = 1.0 - _FACTOR * np.exp(-_DECAY * PUBLISHED)
_RATE = 3.0 / PUBLISHED + _DECAY * (1.0 - _AT) / _AT


def bounded_pressure(pressure: Floats, hardness: float) -> Floats:
    """Asperity pressure that stays below the hardness."""
    share = np.minimum(pressure / hardness, 1e60)
    return pressure / (1.0 + share**_SHARPNESS) ** (1.0 / _SHARPNESS)


@lru_cache(maxsize=16)
def layer_table(parameters: BearingParameters) -> tuple[float, Floats]:
    """How far asperities press the layer back, over the gap s without them, both in roughnesses.

    Returns
    -------
    first : float
        Least s.
    coefficients : ndarray, shape (intervals, 4)
        Cubic splines of the deflection over intervals of 0.05 up to `REACH`, ascending powers.
    """
    sigma, compliance = parameters.roughness, parameters.layer_compliance
    deepest = parameters.deepest_gap / sigma - 1.0
    h = np.arange(deepest, REACH + 0.01, 0.02)
    pressure = bounded_pressure(
        parameters.contact_modulus * asperity_integral(2.5, h), parameters.layer_hardness
    )
    deflection = compliance / sigma * (pressure - pressure[-1])
    count = int(np.ceil((REACH - deepest) / STEP))
    s = REACH - STEP * np.arange(count, -1, -1)
    values = np.interp(s, h - deflection, deflection)
    # one step of Newton's method each makes the interpolated inverse smooth
    for _ in range(3):
        at = s + values
        p = bounded_pressure(
            parameters.contact_modulus * asperity_integral(2.5, at), parameters.layer_hardness
        )
        slope = _slope(at, parameters)
        exact = compliance / sigma * (p - pressure[-1])
        values -= (values - exact) / (1.0 - compliance / sigma * slope)
    return float(s[0]), np.ascontiguousarray(
        np.moveaxis(
            spline_coefficients(np.arange(s.size, dtype=np.float64), np.asarray(values, dtype=np.float64)),
            0,
            -1,
        )
    )


def _slope(h: Floats, parameters: BearingParameters) -> Floats:
    """Derivative of the bounded asperity pressure by the gap in roughnesses."""
    modulus, hardness = parameters.contact_modulus, parameters.layer_hardness
    share = np.minimum(modulus * asperity_integral(2.5, h) / hardness, 1e60)
    return -2.5 * modulus * asperity_integral(1.5, h) * (1.0 + share**_SHARPNESS) ** (-1.0 - 1.0 / _SHARPNESS)


def layered_pressure(parameters: BearingParameters, gap: Floats) -> Floats:
    """Asperity pressure, Pa, where the film does not press the layer; of rigid gaps in roughnesses."""
    first, table = layer_table(parameters)
    at = np.clip((gap - first) / STEP, 0.0, table.shape[0] - 1e-9)
    c, x = table[at.astype(int)], at % 1.0
    back = c[..., 0] + x * (c[..., 1] + x * (c[..., 2] + x * c[..., 3]))
    return np.asarray(np.where(gap < REACH, back, 0.0) * parameters.roughness / parameters.layer_compliance)


@inner_kernel
def deflection(s: float, first: float, table: Floats) -> tuple[float, float, float]:
    """Deflection under the asperities, with two derivatives by s; all in roughnesses."""
    if s >= REACH:
        return 0.0, 0.0, 0.0
    place = max((s - first) / STEP, 0.0)
    i = min(int(place), table.shape[0] - 1)
    x = place - i
    a, b, c, d = table[i, 0], table[i, 1], table[i, 2], table[i, 3]
    slope, bend = b + x * (2.0 * c + 3.0 * x * d), 2.0 * c + 6.0 * x * d
    return a + x * (b + x * (c + x * d)), slope / STEP, bend / (STEP * STEP)


@inner_kernel
def rough_flow(u: float) -> tuple[float, float]:
    """Flow of an isotropic rough gap over the cube of the roughness, and its derivative by the gap u.

    phi(u) u^3 with Patir and Cheng's pressure flow factor phi = 1 - 0.90 exp(-0.56 u) of isotropic
    surfaces (1978, J. Lubr. Technol. 100, 12), u in roughnesses, from 0.5 on. Below, where they give
    none, the flow falls on exponentially from there with the same slope, as leakage past surfaces in
    contact does (Persson and Yang 2008, J. Phys.: Condens. Matter 20, 315011).
    """
    if u < PUBLISHED:
        flow = _AT * PUBLISHED**3 * np.exp(_RATE * (u - PUBLISHED))
        return flow, _RATE * flow
    closed = _FACTOR * np.exp(-_DECAY * u) if u < _OPEN else 0.0
    return (1.0 - closed) * u * u * u, u * u * (3.0 * (1.0 - closed) + _DECAY * closed * u)


@inner_kernel
def set_rough_flow(count: int, sigma: float, gap: Floats, flow: Floats, slope: Floats) -> None:
    """As `rough_flow` from `PUBLISHED` on, of many gaps: their flow, and the derivative of its logarithm.

    The exponential function is a power of one near 1, of which a compiler makes vectors; to 1e-11.
    """
    for i in range(count):
        u = gap[i] / sigma
        x = _DECAY / 256.0 * min(u, _OPEN)
        part = 1.0 - x / 4.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0))
        part = 1.0 - x * (1.0 - x / 2.0 * (1.0 - x / 3.0 * part))
        for _ in range(8):
            part *= part
        closed = _FACTOR * part if u < _OPEN else 0.0
        flow[i] = (1.0 - closed) * gap[i] * gap[i] * gap[i]
        slope[i] = (3.0 + _DECAY * u * closed / (1.0 - closed)) / gap[i]
