"""Unbalance of the wheels, before and after the blade fracture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rotor_fmu.train.train import Train
from rotor_fmu.vibration.modal_shaft import ModalShaft

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

    @classmethod
    def of_train(
        cls,
        train: Train,
        amount: ArrayLike | None,
        phase: ArrayLike | None,
        blade_amount: ArrayLike | None,
        blade_phase: ArrayLike | None,
        fracture_time: float,
    ) -> Unbalance:
        """Unbalance with the nominal one of the train, and no lost blade, where None is given."""

        def per_wheel(values: ArrayLike | None, default: ArrayLike) -> Array:
            return np.array(default if values is None else values, dtype=np.float64)

        nothing = np.zeros(len(train.wheels))
        unbalance = cls(
            amount=per_wheel(amount, train.nominal_unbalance),
            phase=per_wheel(phase, [w.unbalance_phase for w in train.wheels]),
            blade_amount=per_wheel(blade_amount, nothing),
            blade_phase=per_wheel(blade_phase, nothing),
            fracture_time=fracture_time,
        )
        if unbalance.amount.shape != nothing.shape:
            raise ValueError(f"unbalance: {unbalance.amount.shape} values, train has {len(nothing)} wheels")
        return unbalance

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
