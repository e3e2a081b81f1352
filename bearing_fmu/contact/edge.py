"""The edge of a soft layer: what happens between the middle of a film's last cell and its end.

There the pressure falls to the ambient one, often within a small part of the cell, since the less the
film presses the wall back the less flows. Let s be the gap without asperities, which falls by G of the
rigid gap and by d of what the film presses back. The same flow all along, q = -K(s) dp/dz, makes ::

    dz = ds / (G + k / K(s)),   k = d K_eff

over the cell's half. Without G, K_eff is the mean of K over s (Kirchhoff's transform), without d the
harmonic one; between them a power of both, by the shares of d and G in the fall, is within some per cent
of the solution. All in roughnesses.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.layer import STEP, deflection, layer_table, rough_flow
from bearing_fmu.kernels.compiled import inner_kernel, kernel
from bearing_fmu.parameters import BearingParameters

Floats = NDArray[np.float64]

_LAST = 32.0  #: s from which on the flow is that of a smooth gap
_SOFT = 0.2  #: of G, where it goes over to none that is negative
_LEAST = 0.1  #: what the harmonic mean is taken as, over the plain one, where the film presses

# What is integrated over s: the flow K, 1 / K, how far asperities press back, this times K, and s K.
FLOW, RESISTANCE, BACK, BACK_FLOW, PLACE_FLOW, KINDS = 0, 1, 2, 3, 4, 5


@kernel
def _sample(s: Floats, first: float, table: Floats, out: Floats) -> None:
    """The integrands."""
    for i in range(s.size):
        back = deflection(s[i], first, table)[0]
        flow = rough_flow(s[i] + back)[0]
        out[FLOW, i], out[RESISTANCE, i], out[BACK, i] = flow, 1.0 / flow, back
        out[BACK_FLOW, i], out[PLACE_FLOW, i] = back * flow, s[i] * flow


@lru_cache(maxsize=16)
def edge_table(parameters: BearingParameters) -> Floats:
    """Integrals by s.

    Returns
    -------
    ndarray, shape (intervals + 1, 4 KINDS)
        Cubic Hermite polynomials over even intervals, ascending powers; the first row holds the least s.
    """
    first, table = layer_table(parameters)
    nodes, weights = np.polynomial.legendre.leggauss(5)
    count = int(np.ceil((_LAST - first) / STEP))
    s = _LAST - STEP * np.arange(count, -1, -1)
    inside = (s[:-1, None] + 0.5 * STEP * (nodes + 1.0)).ravel()
    between, at = np.empty((KINDS, inside.size)), np.empty((KINDS, s.size))
    _sample(np.asarray(inside, dtype=np.float64), first, table, between)
    _sample(np.asarray(s, dtype=np.float64), first, table, at)
    rows = np.zeros((count + 1, 4 * KINDS))
    rows[0, 0] = s[0]
    for kind in range(KINDS):
        rise, slope = 0.5 * STEP * between[kind].reshape(count, -1) @ weights, STEP * at[kind]
        # from the side where it is small, so that differences stay exact
        down = kind in (RESISTANCE, BACK)
        total = -np.append(np.cumsum(rise[::-1])[::-1], 0.0) if down else np.append(0.0, np.cumsum(rise))
        if kind == RESISTANCE:
            total -= 0.5 / _LAST**2
        here, there = slope[:-1], slope[1:]
        parts = total[:-1], here, 3.0 * rise - 2.0 * here - there, here + there - 2.0 * rise
        rows[1:, 4 * kind : 4 * kind + 4] = np.stack(parts, axis=-1)
    return rows


@inner_kernel
def _integral(s: float, kind: int, table: Floats) -> tuple[float, float, float]:
    """One of the integrals, with two derivatives."""
    place, at = (s - table[0, 0]) / STEP, 4 * kind
    i = min(max(int(place), 0), table.shape[0] - 2)
    a, b, c, d = table[i + 1, at], table[i + 1, at + 1], table[i + 1, at + 2], table[i + 1, at + 3]
    if s >= _LAST:
        last, x = a + b + c + d, s * s
        if kind == FLOW:
            return last + 0.25 * (x * x - _LAST**4), x * s, 3.0 * x
        if kind == RESISTANCE:
            return -0.5 / x, 1.0 / (x * s), -3.0 / (x * x)
        if kind == PLACE_FLOW:
            return last + 0.2 * (x * x * s - _LAST**5), x * x, 4.0 * x * s
        return last, 0.0, 0.0
    x = max(place, 0.0) - i
    slope, bend = b + x * (2.0 * c + 3.0 * x * d), 2.0 * c + 6.0 * x * d
    return a + x * (b + x * (c + x * d)), slope / STEP, bend / (STEP * STEP)


@inner_kernel
def _mean(inside: float, end: float, kind: int, table: Floats) -> tuple[float, float, float]:
    """Mean of an integrand over s, and its changes by both ends."""
    way = inside - end
    r0, f0, g0 = _integral(inside, kind, table)
    r2, f2, g2 = _integral(end, kind, table)
    if abs(way) < STEP:
        _, f1, g1 = _integral(0.5 * (inside + end), kind, table)
        return (f0 + 4.0 * f1 + f2) / 6.0, (g0 + 2.0 * g1) / 6.0, (g2 + 2.0 * g1) / 6.0
    mean = (r0 - r2) / way
    return mean, (f0 - mean) / way, (mean - f2) / way


@inner_kernel
def _share(inside: float, end: float, press: float) -> tuple[float, float, float]:
    """Share of the film in the fall, and its changes by G and by d."""
    fall = inside - end - press
    root = np.sqrt(fall * fall + _SOFT * _SOFT)
    rigid, slope = 0.5 * (fall + root), 0.5 * (1.0 + fall / root)
    whole = press + rigid
    return press / whole, -press * slope / (whole * whole), rigid / (whole * whole)


@inner_kernel
def edge_flow(inside: float, end: float, press: float, table: Floats) -> tuple[float, float, float, float]:
    """Effective flow from s `inside` to that at the `end`, of which the film makes `press`.

    With the changes of its logarithm by the three.
    """
    straight, s0, s2 = _mean(inside, end, FLOW, table)
    against, r0, r2 = _mean(inside, end, RESISTANCE, table)
    share, by_fall, by_press = _share(inside, end, press)
    s0, s2, r0, r2 = s0 / straight, s2 / straight, -r0 / against, -r2 / against
    ratio = 1.0 / (against * straight)
    least = ratio + _LEAST * share * share
    log, rest = np.log(least), 1.0 - share
    by_share = rest * 2.0 * _LEAST * share / least - log
    by_inside = s0 + rest * ratio / least * (r0 - s0) + by_share * by_fall
    by_end = s2 + rest * ratio / least * (r2 - s2) - by_share * by_fall
    return straight * np.exp(rest * log), by_inside, by_end, by_share * (by_press - by_fall)


@inner_kernel
def edge_back(inside: float, end: float, press: float, table: Floats) -> tuple[float, float, float, float]:
    """Mean over the cell's half of how far asperities press back, and its changes by the three."""
    flow, f0, f2, f3 = edge_flow(inside, end, press, table)
    carried, c0, c2 = _mean(inside, end, BACK_FLOW, table)
    plain, p0, p2 = _mean(inside, end, BACK, table)
    if not (carried > 0.0 and plain > 0.0):
        return 0.0, 0.0, 0.0, 0.0
    share, by_fall, by_press = _share(inside, end, press)
    first, second = flow / carried, 1.0 / plain
    mean = 1.0 / (share * first + (1.0 - share) * second)
    bend = (first - second) * by_fall
    by_inside = share * first * (f0 - c0 / carried) - (1.0 - share) * second * p0 / plain + bend
    by_end = share * first * (f2 - c2 / carried) - (1.0 - share) * second * p2 / plain - bend
    by_d = share * first * f3 + (first - second) * by_press - bend
    square = -mean * mean
    return mean, square * by_inside, square * by_end, square * by_d


@inner_kernel
def edge_pressure(inside: float, end: float, table: Floats) -> tuple[float, float, float]:
    """Mean pressure over the cell's half over that in the middle of the cell, and its changes by both."""
    way = inside - end
    _, f0, g0 = _integral(inside, FLOW, table)
    _, f2, g2 = _integral(end, FLOW, table)
    if abs(way) < STEP:
        _, f1, g1 = _integral(0.5 * (inside + end), FLOW, table)
        whole = f0 + 4.0 * f1 + f2
        part = (f0 + 2.0 * f1) / whole
        return part, (g0 + g1 - part * (g0 + 2.0 * g1)) / whole, (g1 - part * (g2 + 2.0 * g1)) / whole
    flow, a0, a2 = _mean(inside, end, FLOW, table)
    moment, m0, m2 = _mean(inside, end, PLACE_FLOW, table)
    place = moment / flow
    part = (place - end) / way
    by_inside, by_end = (m0 - place * a0) / flow, (m2 - place * a2) / flow
    return part, (by_inside - part) / way, (by_end - 1.0 + part) / way
