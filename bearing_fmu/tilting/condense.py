"""What a pad in balance gives to the bearing: its force with stiffness and damping, its motion condensed.

With the axes A of the pad (d, w), Z = K + rate C of its film, S = 1/compliance of its pivot and the balance
A'F = S w ::

    dF = -(K dq + C dv + Z A dc),   dc = -(A'Z A + S)^-1 A'(K dq + C dv)

In a step the rate is that of the balance.  Of small motions at a frequency it is i times this (Lund 1964),
and K and C are the real part and, over the frequency, the imaginary one.  Solid friction adds to the force on
the journal and not to the balance.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.slice import FORCE_SLOPE
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.outputs import OUT_C, OUT_GAP, OUT_K, OUT_WRENCH
from bearing_fmu.tilting.pad import ACROSS, COMPLIANCE, Pivot
from bearing_fmu.tilting.search import SHARE, SLOPE, D, W

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

_NO_SPRING = 1e-300  # but a pivot that gives way


@inner_kernel
def _solved(
    held: Complex, axes: Floats, spring: float, first: complex, second: complex
) -> tuple[complex, complex]:
    """How a pad that `held` (4, 4) holds moves under forces along its axes."""
    a, b, c, d = 0.0j, 0.0j, 0.0j, 0.0j
    for i in range(2):
        for j in range(2):
            a += axes[0, i] * held[i, j] * axes[0, j]
            b += axes[0, i] * held[i, j] * axes[1, j]
            c += axes[1, i] * held[i, j] * axes[0, j]
            d += axes[1, i] * held[i, j] * axes[1, j]
    if a == 0.0:  # no film to hold it
        return 0.0j, 0.0j
    if spring == 0.0:  # no spring, but a rigid pivot
        return first / a, 0.0j
    d += spring
    whole = a * d - b * c
    if whole == 0.0:  # next to no film
        return first / a, 0.0j
    return (first * d - b * second) / whole, (a * second - c * first) / whole


@inner_kernel
def _freed(
    held: Complex, side: Complex, rubbing: Floats, more: float, axes: Floats, spring: float, result: Complex
) -> None:
    """Force (4, 4) for motions that give `side` to a pad that `held` holds; friction is `more` of it."""
    for j in range(4):
        first = axes[0, 0] * side[0, j] + axes[0, 1] * side[1, j]
        second = axes[1, 0] * side[0, j] + axes[1, 1] * side[1, j]
        d, w = _solved(held, axes, spring, first, second)
        x, y = d * axes[0, 0] + w * axes[1, 0], d * axes[0, 1] + w * axes[1, 1]
        for i in range(4):
            result[i, j] = side[i, j] + more * rubbing[i, j]
            result[i, j] -= (held[i, 0] + rubbing[i, 0]) * x + (held[i, 1] + rubbing[i, 1]) * y


@inner_kernel
def add_condensed(
    out: Floats,
    contact: Floats,
    pivot: Pivot,
    search: Floats,
    rate: float,
    grip: float,
    frequency: float,
    matrices: Complex,
    total: Floats,
) -> None:
    """Add a pad's wrench, stiffness and damping to those of the bearing; take away what was left of balance.

    Parameters
    ----------
    out : ndarray, shape (58,)
        What the film of the pad has written at its place, without solid friction.
    contact : ndarray, shape (CONTACT_RESULTS,)
        Its solid contact.
    pivot : ndarray, shape (PIVOT,)
        The pad.
    search : ndarray, shape (SEARCH,)
        As it has ended; its place is corrected.
    rate : float
        Of the balance.
    grip : float
        Friction coefficient times sense of sliding.
    frequency : float
        At rest, of the small motions for which stiffness and damping hold, rad/s; 0: of a position that
        changes slowly and a velocity that changes quickly.
    matrices : ndarray, shape (5, 4, 4)
        Work space.
    total : ndarray, shape (58,)
        In the order of the port; to which is added.
    """
    k, c, held, freed, rubbing = matrices[0], matrices[1], matrices[2], matrices[3], matrices[4].real
    axes = pivot[ACROSS:COMPLIANCE].reshape(2, 2)
    share = search[SHARE]
    spring = 1.0 / pivot[COMPLIANCE] if pivot[COMPLIANCE] > 0.0 else 0.0
    for i in range(4):
        other, sign = (i + 1, 1.0) if i % 2 == 0 else (i - 1, -1.0)
        for j in range(4):
            k[i, j], c[i, j] = out[OUT_K + 4 * i + j], out[OUT_C + 4 * i + j]
            held[i, j] = k[i, j] + rate * c[i, j]
            # friction is the pressure of the contact turned by a right angle from x to y
            rubbing[i, j] = sign * grip * contact[FORCE_SLOPE + 4 * other + j]
        total[OUT_WRENCH + i] += share * (out[OUT_WRENCH + i] - sign * grip * out[OUT_GAP + 5 + other])
    if share < 1.0 and frequency == 0.0:
        _add_left(out, pivot, share, search[SLOPE], total)
        return
    if share == 1.0:
        first = axes[0, 0] * out[0] + axes[0, 1] * out[1]
        second = axes[1, 0] * out[0] + axes[1, 1] * out[1] - spring * search[W]
        d, w = _solved(held, axes, spring, first + 0.0j, second + 0.0j)
        x, y = (d * axes[0, 0] + w * axes[1, 0]).real, (d * axes[0, 1] + w * axes[1, 1]).real
        search[D] += d.real
        search[W] += w.real
        for i in range(4):
            total[OUT_WRENCH + i] -= (held[i, 0].real + rubbing[i, 0]) * x + (
                held[i, 1].real + rubbing[i, 1]
            ) * y
    if rate == 0.0 and frequency > 0.0:
        for i in range(4):
            for j in range(4):
                held[i, j] = k[i, j] + 1j * frequency * c[i, j]
        _freed(held, held, rubbing, 1.0, axes, spring, freed)
        for i in range(16):
            total[OUT_K + i] += share * freed[i // 4, i % 4].real
            total[OUT_C + i] += share * freed[i // 4, i % 4].imag / frequency
        if share < 1.0:
            _add_shed(out, pivot, search[SLOPE], total)
    else:
        _freed(held, k, rubbing, 1.0, axes, spring, freed)
        for i in range(16):
            total[OUT_K + i] += freed[i // 4, i % 4].real
        if rate == 0.0:  # the pad follows at once, before its spring does
            for i in range(16):
                held[i // 4, i % 4] = c[i // 4, i % 4]
            rubbing[:] = 0.0
            spring = _NO_SPRING if spring > 0.0 else 0.0
        _freed(held, c, rubbing, 0.0, axes, spring, freed)
        for i in range(16):
            total[OUT_C + i] += freed[i // 4, i % 4].real


@inner_kernel
def _add_left(out: Floats, pivot: Pivot, share: float, slope: float, total: Floats) -> None:
    """Stiffness and damping of a pad that is left where it is, of which a share counts, see `search`."""
    for i in range(4):
        for j in range(4):
            total[OUT_K + 4 * i + j] += share * out[OUT_K + 4 * i + j]
            total[OUT_C + 4 * i + j] += share * out[OUT_C + 4 * i + j]
    _add_shed(out, pivot, slope, total)


@inner_kernel
def _add_shed(out: Floats, pivot: Pivot, slope: float, total: Floats) -> None:
    """Stiffness of the share that a displacement makes count less, whatever the whirl."""
    size = np.hypot(out[0], out[1])
    moment = pivot[ACROSS] * out[0] + pivot[ACROSS + 1] * out[1]
    sense = -1.0 if moment > 0.0 else 1.0
    for j in range(4):
        x, y = out[OUT_K + j], out[OUT_K + 4 + j]
        grows = moment * (out[0] * x + out[1] * y) / size**2 - (pivot[ACROSS] * x + pivot[ACROSS + 1] * y)
        shed = -slope * sense * grows / size
        for i in range(4):
            total[OUT_K + 4 * i + j] -= shed * out[OUT_WRENCH + i]
