"""Unbalance of the wheels, before and after the blade fracture."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rotor_fmu.train.train import Train
from rotor_fmu.vibration.modal_shaft import ModalShaft

Array = NDArray[np.float64]


class Loss(NamedTuple):
    """Unbalance that appears at an instant [s], or when told: amount [kg m] and phase [rad], (n_w,) each."""

    time: float
    amount: Array
    phase: Array


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
    later : tuple of Loss
        What is lost besides; without an instant, that is at infinity, when `come` says so.
    come : set of int
        Numbers of losses, from 1, that have come without an instant; changed from outside, between two steps.
    """

    amount: Array
    phase: Array
    blade_amount: Array
    blade_phase: Array
    fracture_time: float
    later: tuple[Loss, ...] = ()
    come: set[int] = field(default_factory=set)

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
        later: tuple[Loss, ...] = (),
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
            later=later,
        )
        if unbalance.amount.shape != nothing.shape:
            raise ValueError(f"unbalance: {unbalance.amount.shape} values, train has {len(nothing)} wheels")
        return unbalance

    def nominal_force(self, shaft: ModalShaft, speed: float) -> Array:
        """Modal force of the nominal unbalance, factors of (cos theta, sin theta), (m, 2)."""
        return _force(shaft, self.amount, self.phase, speed)

    @cached_property
    def losses(self) -> tuple[Loss, ...]:
        """All that appears during the run."""
        return Loss(self.fracture_time, self.blade_amount, self.blade_phase), *self.later

    def forces(self, shaft: ModalShaft, speed: float) -> Array:
        """Modal forces of the nominal unbalance and of each loss, a pair of columns each, (m, 2 + 2 l)."""
        lost = (_force(shaft, loss.amount, loss.phase, speed) for loss in self.losses)
        return np.hstack([self.nominal_force(shaft, speed), *lost])

    def appeared(self, time: float) -> Array:
        """1 for the nominal unbalance and each loss that has come by an instant, else 0, (1 + l,)."""
        return np.array(
            [1.0, *(float(self._has_come(k, loss, time)) for k, loss in enumerate(self.losses, 1))]
        )

    def _has_come(self, number: int, loss: Loss, time: float) -> bool:
        return loss.time <= time or number in self.come

    def turned(self, time: float, pull: complex) -> Array:
        """Factors of the columns of `forces`: the pull of all that has appeared by now, (2 + 2 l,)."""
        found = [pull.real, pull.imag]
        for number, loss in enumerate(self.losses, 1):
            found += (pull.real, pull.imag) if self._has_come(number, loss, time) else (0.0, 0.0)
        return np.array(found)

    def lose(self, code: int) -> None:
        """Say which losses without an instant have come: the sum of 2^k of them, k from 0."""
        if not (code or self.come):
            return
        waiting = [index for index, loss in enumerate(self.later, 2) if math.isinf(loss.time)]
        self.come.clear()
        self.come.update(index for k, index in enumerate(waiting) if code >> k & 1)

    def inside(self, start: float, end: float) -> Iterator[tuple[int, float]]:
        """Yield number, from 1, and instant of the losses between two instants, both excluded."""
        for index, loss in enumerate(self.losses, 1):
            if start < loss.time < end:
                yield index, loss.time


def losses_of(text: str, wheels: int) -> tuple[Loss, ...]:
    """Losses in a text, ``[[2.0, 1, 0.5, 0.0]]``: instant [s] or null, number of the wheel from 1, kg m, rad.

    Raises
    ------
    ValueError
        Saying what is allowed.
    """
    if not text:
        return ()
    found = []
    try:
        for time, wheel, amount, phase in json.loads(text):
            values = np.zeros((2, wheels))
            values[:, range(wheels)[int(wheel) - 1]] = float(amount), float(phase)
            time = math.inf if time is None else float(time)
            if math.isnan(time) or not np.isfinite(values).all() or int(wheel) < 1:
                raise ValueError
            found.append(Loss(time, *values))
    except (TypeError, ValueError, IndexError):
        allowed = f"rows of an instant in s or null, a wheel from 1 to {wheels}, kg m and rad"
        raise ValueError(f"losses = {text!r}; allowed are {allowed}") from None
    return tuple(found)


def _force(shaft: ModalShaft, amount: Array, phase: Array, speed: float) -> Array:
    pull = amount * speed**2
    cosine = np.stack([pull * np.cos(phase), pull * np.sin(phase)], axis=-1).ravel()
    sine = np.stack([-pull * np.sin(phase), pull * np.cos(phase)], axis=-1).ravel()
    return shaft.wheels.T @ np.stack([cosine, sine], axis=-1)
