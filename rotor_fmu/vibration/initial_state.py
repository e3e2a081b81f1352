"""The state in which a run starts: static equilibrium plus steady unbalance response.

The weight bends the shaft through its unreduced matrices, which a reduced shaft
reproduces poorly between its masters; the reduced shaft then vibrates about this
shape.  With K q_s = g + B.T w_s for the unreduced shaft, any reduction is at rest
under the wrenches w_s, and g appears nowhere in the step.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.shaft.condensation import CondensedShaft
from rotor_fmu.vibration.state import RotorState

Array = NDArray[np.float64]
Harmonic = CondensedShaft[np.complex128]


def at_positions(
    static: CondensedShaft[np.float64],
    harmonic: Harmonic,
    speed: float,
    positions: tuple[Array, Array, Array],
    angle: float,
) -> RotorState:
    """State with the journals moving as q = mean + cosine cos(theta) + sine sin(theta).

    Parameters
    ----------
    static : CondensedShaft
        The unreduced shaft under its weight.
    harmonic : CondensedShaft
        The reduced shaft under its nominal unbalance at this speed.
    speed : float
        [rad/s].
    positions : tuple of ndarray, (n_b, 4) each
        mean, cosine, sine.
    angle : float
        theta at the start [rad].

    Returns
    -------
    RotorState
        The shaft between its journals is in equilibrium, at rest and at 1X.
    """
    mean, cosine, sine = (np.asarray(p, dtype=np.float64).reshape(-1) for p in positions)
    equilibrium = static.at_positions(mean)
    vibration = harmonic.at_positions(cosine - 1j * sine).shape
    return RotorState(_instant(vibration, speed, angle), angle, equilibrium)


def under_law(
    static: CondensedShaft[np.float64],
    harmonic: Harmonic,
    speed: float,
    law: tuple[Array, Array, Array],
    angle: float,
    orbit: bool,
) -> RotorState:
    """State in equilibrium with the wrenches w = F0 - K q - C v.

    Parameters
    ----------
    static, harmonic, speed, angle
        As for `at_positions`.
    law : tuple of ndarray, (n_b, 4), (n_b, 4, 4), (n_b, 4, 4)
        F0, K, C.
    orbit : bool
        With the linear unbalance response superposed.

    Returns
    -------
    RotorState
        Static equilibrium, at rest or vibrating at 1X.
    """
    F0, K, C = (np.asarray(a, dtype=np.float64) for a in law)
    equilibrium = static.under_law(F0.reshape(-1), K)
    vibration = np.zeros_like(harmonic.shape_load)
    if orbit:
        vibration = harmonic.under_law(np.zeros(F0.size, dtype=np.complex128), K + 1j * speed * C).shape
    return RotorState(_instant(vibration, speed, angle), angle, equilibrium)


def _instant(phasor: NDArray[np.complex128], speed: float, angle: float) -> Array:
    """(p, p') of p = Re(phasor e^{i theta})."""
    now = phasor * complex(math.cos(angle), math.sin(angle))
    return np.concatenate([now.real, (1j * speed * now).real])
