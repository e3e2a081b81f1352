"""How journals without mass move at the end of a step: as the slope of their wrench, extrapolated, has it.

Within a step wrenches run straight (`rotor_fmu.vibration.affine_step`), so that what follows a wrench at once
has the mean velocity over the step, which lags by half of it.  The slope of the step before gives the
curvature, as in the backward differentiation formula of second order (Curtiss and Hirschfelder 1952, PNAS 38,
235-243), here with steps of any length::

    v = following (s1 + (s1 - s0) H / (H + H0))          s: slopes of the wrench over both steps

It damps what is stiff, and starts, and goes over a kink, with one step of first order.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.vibration.modal_shaft import ModalShaft

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Trail:
    """What a step leaves behind for the next one; of shafts with massless journals.

    Attributes
    ----------
    slope : ndarray, (4 n_b,)
        Of the wrenches over the step, per s.
    lead : ndarray, (4 n_b,)
        Velocities of the journals at its end beyond those of wrenches that run straight.
    step : float
        Its length [s].
    """

    slope: Array
    lead: Array
    step: float


class Extrapolation:
    """The velocities of one step as they depend on its wrenches.

    Parameters
    ----------
    shaft : ModalShaft
        With massless modes.
    before : Trail or None
        Of the step before; None at a start, where nothing is extrapolated.
    step : float
        H [s].
    """

    def __init__(self, shaft: ModalShaft, before: Trail | None, step: float) -> None:
        self._step = step
        self._before = np.zeros(len(shaft.bearing)) if before is None else before.slope
        share = 0.0 if before is None else step / (step + before.step)
        self._matrix = share * lagging(shaft, step)

    def compliance(self, share: Array | float) -> Array:
        """Velocities from the wrenches at the end, (4 n_b, 4 n_b), which take this share of the change."""
        return self._matrix * (share / self._step)

    def trail(self, change: Array) -> Trail:
        """What the step leaves behind, of the change of the wrenches within it, (4 n_b,)."""
        slope = change / self._step
        return Trail(slope, self._matrix @ (slope - self._before), self._step)


def lagging(shaft: ModalShaft, step: float) -> Array:
    """Compliance of massless modes to what the velocity at the end misses, (4 n_b, 4 n_b).

    Of a mode whose damping lets it follow with the rate r it is the share
    1 + e^(-r H) - 2 (1 - e^(-r H)) / (r H): all of it where it follows at once, none where it creeps.
    """
    assert shaft.massless is not None
    moved, omega = shaft.bearing[:, shaft.massless], shaft.omega[shaft.massless]
    z = step * omega**2 / shaft.D.diagonal()[shaft.massless]
    share = np.where(z > 1e-3, 1.0 + np.exp(-z) + 2.0 * np.expm1(-z) / np.maximum(z, 1e-3), z * z / 6.0)
    return np.asarray(moved * (share / omega**2) @ moved.T)
