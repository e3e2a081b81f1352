"""Unbalance of the wheels, before and after the blade fracture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.modal_shaft import ModalShaft

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Unbalance:
    """Unbalance of n_w wheels.

    A wheel with unbalance U at phase phi pulls with U speed^2 (cos, sin)(theta + phi)
    in (x, y), theta being the angle of rotation.

    Attributes
    ----------
    amount, phase : ndarray, (n_w,)
        Nominal unbalance [kg m] and its angle at theta = 0 [rad].
    blade_amount, blade_phase : ndarray, (n_w,)
        Unbalance added by the fracture and its angle at theta = 0.
    fracture_time : float
        Instant of the fracture [s]; infinity for none.
    """

    amount: Array
    phase: Array
    blade_amount: Array
    blade_phase: Array
    fracture_time: float

    def __post_init__(self) -> None:
        for name in ("amount", "phase", "blade_amount", "blade_phase"):
            values = getattr(self, name)
            if values.shape != self.amount.shape or not np.all(np.isfinite(values)):
                raise ValueError(f"unbalance: {name} {values} must be finite, one value a wheel")
        if np.isnan(self.fracture_time):
            raise ValueError("unbalance: fracture_time is not a number; allowed are instants and infinity")

    def nominal_force(self, shaft: ModalShaft, speed: float) -> Array:
        """Modal force of the nominal unbalance, factors of (cos theta, sin theta), (m, 2)."""
        return _force(shaft, self.amount, self.phase, speed)

    def blade_force(self, shaft: ModalShaft, speed: float) -> Array:
        """Modal force of the lost blade's unbalance, likewise."""
        return _force(shaft, self.blade_amount, self.blade_phase, speed)


def _force(shaft: ModalShaft, amount: Array, phase: Array, speed: float) -> Array:
    pull = amount * speed**2
    cosine = np.stack([pull * np.cos(phase), pull * np.sin(phase)], axis=-1).ravel()
    sine = np.stack([-pull * np.sin(phase), pull * np.cos(phase)], axis=-1).ravel()
    return shaft.wheels.T @ np.stack([cosine, sine], axis=-1)
