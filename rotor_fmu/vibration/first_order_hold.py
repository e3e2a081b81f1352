"""What decoupled first-order systems ``z' = rate z + input`` do over a step, for given inputs.

The phi functions of exponential integrators: phi1(z) = (e^z - 1) / z and phi2(z) = (phi1(z) - 1) / z
(Hochbruck and Ostermann 2010, Acta Numerica 19, 209-286, Eq. 2.10).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_SMALL = 0.5
"""Modulus below which phi2 is summed as a series, exact to rounding with the terms below."""

_TERMS = 16


def linear_hold(rates: Complex, step: float) -> tuple[Complex, Complex]:
    """End values from inputs that fall linearly from 1 to 0 and that rise from 0 to 1 within the step.

    Parameters
    ----------
    rates : ndarray of complex
        [1/s].
    step : float
        [s].

    Returns
    -------
    falling, rising : ndarray of complex
        Of the shape of rates [s].
    """
    z = rates * step
    rising = step * _phi2(z)
    return step * _phi1(z) - rising, rising


def harmonic_hold(rates: Complex, frequency: float, step: float) -> Complex:
    """End values from the input e^{i frequency t}, t from the start; exact at resonance, too.

    Parameters
    ----------
    rates : ndarray of complex
        Real parts not above 0 by more than a few 1/step [1/s].
    frequency : float
        [rad/s].
    step : float
        [s].
    """
    turn = complex(math.cos(frequency * step), math.sin(frequency * step))
    return turn * step * _phi1((rates - 1j * frequency) * step)


def _phi1(z: Complex) -> Complex:
    safe = np.where(z == 0.0, 1.0, z)
    return np.where(z == 0.0, 1.0, np.expm1(safe) / safe)


def _phi2(z: Complex) -> Complex:
    small = np.abs(z) < _SMALL
    series = np.zeros_like(z)
    near = np.where(small, z, 0.0)
    for k in range(_TERMS, -1, -1):
        series = series * near + 1.0 / math.factorial(k + 2)
    far = np.where(small, 1.0, z)
    return np.where(small, series, (_phi1(far) - 1.0) / far)
