"""The shaft in steady vibration, condensed onto its journals; see `rotor_fmu.shaft.condensation`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.shaft.condensation import (
    REFERENCE_FREQUENCY,
    CondensedShaft,
    condensed,
    reference_springs,
    solve_held,
)
from rotor_fmu.shaft.matrices import ShaftModel
from rotor_fmu.vibration.modal_shaft import ModalShaft

Array = NDArray[np.float64]


def condense_harmonic(
    model: ShaftModel, shaft: ModalShaft, speed: float, harmonic: Array
) -> CondensedShaft[np.complex128]:
    """The reduced shaft in steady vibration Re(. e^{i theta}) at a speed.

    Parameters
    ----------
    model, shaft : ShaftModel, ModalShaft
        The shaft, unreduced (for its mass and length) and reduced.
    speed : float
        [rad/s]; at 0 the shaft is condensed as if it crept, so that prescribed orbits are followed.
    harmonic : ndarray, (m, 2)
        Modal force, factors of (cos theta, sin theta).

    Returns
    -------
    CondensedShaft
        Of the m modal coordinates; a law enters with stiffness K + i speed C.
    """
    # Reference dampers: no vibration at any speed is resonant on them.
    reference = 1j * reference_springs(model, speed or REFERENCE_FREQUENCY)
    B = shaft.bearing
    Z = shaft.dynamic_stiffness(speed) + (B.T * reference) @ B
    loads = np.hstack([(harmonic[:, 0] - 1j * harmonic[:, 1])[:, None], B.T.astype(np.complex128)])
    shapes = solve_held(Z, loads, f"dynamic stiffness at {speed:g} rad/s")
    return condensed(shapes, B @ shapes, reference)
