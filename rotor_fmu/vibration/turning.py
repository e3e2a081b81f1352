"""How the rotor turns during a step, and the pull of an unbalance that turns with it."""

from __future__ import annotations

import cmath
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.vibration.coordinates import Compliance, Maps
from rotor_fmu.vibration.detuning import Detuning, grid_speed

Array = NDArray[np.float64]


class Turning(NamedTuple):
    """A step in which the speed runs linearly.

    Attributes
    ----------
    angle : float
        At the start [rad].
    start, end : float
        Speeds at both ends [rad/s].
    step : float
        Its length [s].
    """

    angle: float
    start: float
    end: float
    step: float

    @property
    def acceleration(self) -> float:
        """[rad/s2]."""
        return (self.end - self.start) / self.step

    @property
    def mean(self) -> float:
        """Mean speed [rad/s]."""
        return 0.5 * (self.start + self.end)

    @property
    def reference(self) -> float:
        """Speed of the coordinates in which the step is taken [rad/s]."""
        return grid_speed(self.mean)

    def speed_at(self, after: float) -> float:
        """Speed so long after the start [rad/s]."""
        return self.start + self.acceleration * after

    def angle_at(self, after: float) -> float:
        """Angle so long after the start [rad]."""
        return self.angle + 0.5 * (self.start + self.speed_at(after)) * after

    def part(self, start: float) -> Turning:
        """What is left of the step so long after its start."""
        return Turning(self.angle_at(start), self.speed_at(start), self.end, self.step - start)

    def pull(self, reference: float | None = None) -> complex:
        """The unbalance's pull, (phi'^2 - i phi'') e^{i phi}, for inputs that turn with the reference speed.

        Mean square of the speed and phase in the middle of the step are right; the rest is of higher order in
        the change over a step.
        """
        square = (self.start**2 + self.start * self.end + self.end**2) / 3.0
        turns = self.reference if reference is None else reference
        middle = self.angle_at(0.5 * self.step) - 0.5 * turns * self.step
        return complex(square, -self.acceleration) * cmath.exp(1j * middle)

    def pull_at(self, after: float) -> complex:
        """The pull itself at an instant."""
        return complex(self.speed_at(after) ** 2, -self.acceleration) * cmath.exp(1j * self.angle_at(after))


@dataclass(eq=False)
class DetunedMaps:
    """Maps of a reference speed at another one, see `rotor_fmu.vibration.coordinates.Maps`.

    Attributes
    ----------
    base, half : Maps
        Of the reference speed, over the step and over half of it.
    detuning : Detuning
        Of both.
    difference, acceleration : float
        Of the mean speed from the reference [rad/s], and of the rotor [rad/s2].
    power : float
        Of the gyroscopic force in the step that was taken last [W].
    """

    base: Maps
    half: Maps
    detuning: Detuning
    difference: float
    acceleration: float
    power: float = 0.0

    @property
    def compliance(self) -> Compliance:
        """That of the reference speed: within a step the difference does next to nothing to it."""
        return self.base.compliance

    def coast(self, motion: Array, wrench: Array, rotation: Array) -> Array:
        """Motion at the end if the wrenches end with the step."""
        end = self.base.coast(motion, wrench, rotation)
        middle = self.half.coast(motion, wrench, rotation)
        self.half.add_end(wrench, middle)
        pushed, self.power = self.detuning.pushed(middle, self.difference, self.acceleration)
        end += pushed
        return end

    def add_start(self, wrench: Array, motion: Array) -> None:
        """Add what the wrenches at the start do."""
        self.base.add_start(wrench, motion)

    def add_end(self, wrench: Array, motion: Array) -> None:
        """Add what the wrenches at the end do."""
        self.base.add_end(wrench, motion)
