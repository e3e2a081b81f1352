"""Energy of the vibrating shaft and the work done on it.

With the static shape q_s, K q_s = g + B.T w_s, and the vibration T p about it, the energies are

    kinetic  1/2 |p'|^2
    strain   1/2 q_s K q_s + (g T + w_s B) p + 1/2 sum(omega^2 p^2)
    gravity  -g q_s - g T p

without that of the rotation.  Their sum changes by the work of the wrenches on the
journals and of the unbalance, less what damping takes; gyroscopic moments do no work.
The speed is kept by a drive, which supplies the work of the unbalance; see `work`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.shaft.condensation import Equilibrium
from rotor_fmu.shaft.matrices import ShaftModel
from rotor_fmu.vibration.modal_shaft import ModalShaft

Array = NDArray[np.float64]


class Energy(NamedTuple):
    """Energies [J]; gravity's potential is 0 in the undeformed shaft."""

    kinetic: float
    strain: float
    gravity: float


class EnergyMeter:
    """Energies of a state; see the module.

    Parameters
    ----------
    model, shaft : ShaftModel, ModalShaft
        The shaft, unreduced and reduced.
    gravity : float
        [m/s2].
    """

    def __init__(self, model: ShaftModel, shaft: ModalShaft, gravity: float) -> None:
        self._shaft, self._stiffness = shaft, model.K
        self._weight = gravity * model.gravity
        self._modal_weight = self._weight @ shaft.T

    def __call__(self, state: Array, static: Equilibrium[np.float64]) -> Energy:
        """Energies at modal displacements and velocities (p, p'), (2 m,), about a static equilibrium."""
        p, v = np.split(state, 2)
        weight_work = float(self._modal_weight @ p)
        bearing_work = float(static.wrench @ (self._shaft.bearing @ p))
        rest = 0.5 * float(static.shape @ (self._stiffness @ static.shape))
        vibration = 0.5 * float(np.sum((self._shaft.omega * p) ** 2))
        return Energy(
            kinetic=0.5 * float(v @ v),
            strain=rest + weight_work + bearing_work + vibration,
            gravity=-float(self._weight @ static.shape) - weight_work,
        )
