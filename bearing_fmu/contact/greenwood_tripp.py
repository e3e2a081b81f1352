"""Greenwood-Tripp contact of rough surfaces: pressure, and force of a whole bearing slice.

The asperity pressure over a gap h of surfaces with combined roughness sigma is ::

    p_c = K'E' F_5/2(h / sigma),   F_n(H) = 1/sqrt(2 pi) int_H^inf (s - H)^n exp(-s^2/2) ds

(Greenwood and Tripp 1970, Eq. 7-9).  The integral is evaluated, not fitted: the usual power law is off by
11 % at H = 0 and 74 % at H = 3.  It holds for H < 0 as it stands, there F_5/2 grows as (-H)^5/2, so
that overlapping mean lines stay stiff, smooth and finite.

At one axial position the gap C - e cos(psi) depends on the eccentricity e alone, and so do force and
normal load of the slice.  They are tabulated once for a bearing as cubic splines.  In a bore of arcs
it is the pressure times R along one normal.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.asperities import REACH, asperity_integral
from bearing_fmu.contact.cubic_spline import interpolate, spline_coefficients
from bearing_fmu.contact.layer import YIELDING, bounded_pressure, layered_pressure
from bearing_fmu.parameters import BearingParameters

Floats = NDArray[np.float64]

_STEP = 0.05


def contact_pressure(gap: Floats | float, roughness: float, modulus: float) -> Floats:
    """Greenwood-Tripp pressure, Pa, of a gap between mean lines, m."""
    return modulus * asperity_integral(2.5, np.asarray(gap) / roughness)


class SliceTable(NamedTuple):
    """Contact of one bearing slice over its eccentricity, as cubic splines over even intervals.

    Attributes
    ----------
    first, step : float
        First eccentricity of the table and its spacing, m.
    yields : float
        Eccentricity from which the largest pressure reaches the hardness, m.
    coefficients : ndarray, shape (intervals, 4, 4)
        Ascending powers of the place in the interval [0, 1] of the radial force R int p_c cos(psi) dpsi and
        of the normal load R int p_c dpsi, both per width, N/m; of the width that really touches, m; and of
        the largest pressure, Pa. In a bore of arcs R p_c along one normal alone.
    """

    first: float
    step: float
    yields: float
    coefficients: Floats


@lru_cache(maxsize=64)  # bearings of a train are often alike, and each is made several times
def slice_table(parameters: BearingParameters) -> SliceTable:
    """Tabulate the contact of one slice up to the deepest admissible overlap.

    A bearing without contact gets a table that begins beyond every admissible eccentricity.
    """
    sigma, clearance = parameters.roughness, parameters.clearance
    if not parameters.has_contact:
        return SliceTable(np.inf, 1.0, np.inf, np.zeros((1, 4, 4)))
    first = clearance - REACH * sigma
    step = _STEP * sigma
    e = first + step * np.arange(int(np.ceil((clearance - parameters.deepest_gap - first) / step)) + 2)
    largest = _pressure(parameters, np.asarray((clearance - e) / sigma, dtype=np.float64))
    yields = _yields(parameters, np.asarray(e, dtype=np.float64), largest)
    if parameters.arcs:  # over the gap along one normal: what an arc has of it is integrated as it comes
        pressure = parameters.radius * largest
        splines = spline_coefficients(
            np.arange(e.size, dtype=np.float64), pressure - pressure[0], first_slope=0.0
        )
        return SliceTable(float(first), float(step), yields, np.ascontiguousarray(splines.T[:, None]))
    # Gauss-Legendre over the arc of contact, in pieces that resolve the change from tail to overlap.
    node, weight = np.polynomial.legendre.leggauss(16)
    pieces = 8
    half = np.arccos(np.clip(first / e, -1.0, 1.0))[:, None]
    fraction = ((np.arange(pieces)[:, None] + 0.5 * (node + 1.0)) / pieces).ravel()
    psi = half * fraction
    quadrature = 2.0 * half * np.tile(0.5 * weight / pieces, pieces)
    reduced = (clearance - e[:, None] * np.cos(psi)) / sigma
    table = np.arange(float(reduced.min()) - 0.02, REACH + 0.02, 0.01)
    if parameters.has_layer:
        pressure = layered_pressure(parameters, reduced)
    else:
        pressure = parameters.contact_modulus * interpolate(table, asperity_integral(2.5, table), reduced)
    arc = parameters.radius * pressure * quadrature
    touching = parameters.radius * real_area(parameters, pressure) * quadrature
    values = np.stack(
        ((arc * np.cos(psi)).sum(axis=1), arc.sum(axis=1), touching.sum(axis=1), largest), axis=1
    )
    splines = spline_coefficients(np.arange(e.size, dtype=np.float64), values - values[0], first_slope=0.0)
    coefficients = np.moveaxis(splines, 0, -1)
    return SliceTable(float(first), float(step), yields, np.ascontiguousarray(coefficients))


def _pressure(parameters: BearingParameters, gap: Floats) -> Floats:
    """Asperity pressure of rigid gaps in roughnesses."""
    if parameters.has_layer:
        return layered_pressure(parameters, gap)
    return contact_pressure(gap * parameters.roughness, parameters.roughness, parameters.contact_modulus)


def real_area(parameters: BearingParameters, pressure: Floats) -> Floats:
    """Share in which solids really touch: there the pressure is the hardness (Bowden and Tabor 1950)."""
    hardness = parameters.layer_hardness
    return (pressure if parameters.has_layer else bounded_pressure(pressure, hardness)) / hardness


def _yields(parameters: BearingParameters, e: Floats, pressure: Floats) -> float:
    """Eccentricity at which the pressure, which grows with it, reaches where the softer metal yields."""
    limit = YIELDING * parameters.layer_hardness if parameters.has_layer else parameters.layer_hardness
    return float(np.interp(limit, pressure, e)) if pressure[-1] > limit else np.inf
