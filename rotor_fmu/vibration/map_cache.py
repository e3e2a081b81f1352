"""Maps of the shaft kept for the speeds and step sizes in use."""

from __future__ import annotations

import math
from collections import OrderedDict
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.shaft.condensation import CondensedShaft
from rotor_fmu.vibration.coordinates import Coordinates, Maps, Reading
from rotor_fmu.vibration.detuning import Detuning
from rotor_fmu.vibration.harmonic_shaft import condense_harmonic
from rotor_fmu.vibration.modal_shaft import ModalShaft
from rotor_fmu.vibration.prepared import PreparedShaft
from rotor_fmu.vibration.state_space import ModalCoordinates
from rotor_fmu.vibration.supported import SupportedCoordinates
from rotor_fmu.vibration.turning import DetunedMaps, Turning
from rotor_fmu.vibration.unbalance import Unbalance
from rotor_fmu.vibration.whirl_coordinates import whirl_coordinates
from rotor_fmu.vibration.work import WorkMaps, work_maps

Array = NDArray[np.float64]
Item = TypeVar("Item")

CAPACITY = 8
"""Maps kept of each kind: a step size, its halves while a step is repeated, and a second speed."""

_ROUNDING = 4.0 * np.finfo(float).eps
"""Of a difference of instants, relative to the later one."""


class MapCache:
    """Everything that depends on speed and step size only, computed at first use.

    A master that takes its step as the difference of two instants varies it by their
    rounding and would ask for ever new maps: within that rounding a decimal of nine digits
    is taken, or else a step size already in use.

    Parameters
    ----------
    prepared : PreparedShaft
        The shaft, and what its bearings stand on.
    shaft : ModalShaft
        Both as one.
    unbalance : Unbalance
        Its excitation.
    """

    def __init__(self, prepared: PreparedShaft, shaft: ModalShaft, unbalance: Unbalance) -> None:
        self._model, self._bare, self._shaft = prepared.model, prepared.modal, shaft
        self._foundation, self._unbalance = prepared.foundation, unbalance
        self._modal = self._on_foundation(ModalCoordinates(self._bare))
        self._coordinates: OrderedDict[tuple[float], Coordinates] = OrderedDict()
        self._steps: OrderedDict[tuple[float, float], Maps] = OrderedDict()
        self._works: OrderedDict[tuple[float, float], WorkMaps] = OrderedDict()
        self._kicks: OrderedDict[tuple[float, float], Maps] = OrderedDict()
        self._unit_kicks: OrderedDict[tuple[float, float], Maps] = OrderedDict()
        self._detunings: OrderedDict[tuple[float, float], tuple[Maps, Maps, Detuning]] = OrderedDict()
        self._readings: OrderedDict[tuple[float | None], Reading] = OrderedDict()
        self._harmonics: OrderedDict[tuple[float], CondensedShaft[np.complex128]] = OrderedDict()

    def coordinates(self, speed: float | None) -> Coordinates:
        """The coordinates of a motion: modal for None, else those in which steps at a speed are taken."""
        if speed is None:
            return self._modal
        return _recall(self._coordinates, (speed,), self._new_coordinates)

    def step(self, speed: float, step: float, end: float = 0.0) -> Maps:
        """Maps over a step, for the nominal unbalance and the lost blade's.

        Parameters
        ----------
        speed, step : float
            [rad/s], [s].
        end : float
            Instant at the end of the step, for its rounding [s].
        """
        length = self._settled(speed, step, end)
        return _recall(self._steps, (speed, length), self._new_step)

    def turned(self, turning: Turning, end: float = 0.0) -> DetunedMaps:
        """Maps over a step in which the speed changes, for unbalances whose pull is `Turning.pull`."""
        speed = turning.reference
        length = self._settled(speed, turning.step, end)
        found = _recall(self._detunings, (speed, length), self._new_detuning)
        return DetunedMaps(*found, turning.mean - speed, turning.acceleration)

    def reading(self, speed: float | None) -> Reading:
        """What a motion in the coordinates of a speed is along the pulls of the unbalances, for each kg m."""
        return _recall(self._readings, (speed,), self._new_reading)

    def work(self, speed: float, step: float, end: float = 0.0) -> WorkMaps:
        """Works over a step of which `step` has been asked, or over a part of one."""
        length = self._settled(speed, step, end)
        return _recall(self._works, (speed, length), self._new_work)

    def kick(self, speed: float, duration: float, angle: float, loss: int = 1) -> Array:
        """Motion after `duration` from rest under the unbalance of a loss, from `angle` on, (2 m,)."""
        maps = _recall(self._kicks, (speed, duration), self._new_step)
        return self._pushed(maps, complex(math.cos(angle), math.sin(angle)), loss)

    def turned_kick(self, turning: Turning, speed: float, loss: int = 1) -> Array:
        """The same at changing speed, in the coordinates of a speed of the grid."""
        maps = _recall(self._unit_kicks, (speed, turning.step), self._unit_maps)
        return self._pushed(maps, turning.pull(speed), loss)

    def _pushed(self, maps: Maps, pull: complex, loss: int) -> Array:
        turn = np.zeros(2 + 2 * len(self._unbalance.losses))
        turn[2 * loss : 2 * loss + 2] = pull.real, pull.imag
        return maps.coast(np.zeros(2 * self._shaft.size), np.zeros(len(self._shaft.bearing)), turn)

    def harmonic(self, speed: float) -> CondensedShaft[np.complex128]:
        """Steady vibration under the nominal unbalance, condensed onto the journals."""
        return _recall(self._harmonics, (speed,), self._new_harmonic)

    def _settled(self, speed: float, step: float, end: float) -> float:
        if (speed, step) in self._steps or (speed, step) in self._detunings:
            return step
        noise = _ROUNDING * (abs(end) + step)
        known = (other for kept in (self._steps, self._detunings) for at, other in kept if at == speed)
        candidates = (float(f"{step:.8e}"), *known)
        return next((other for other in candidates if abs(other - step) <= noise), step)

    def _new_coordinates(self, speed: float) -> Coordinates:
        whirl = whirl_coordinates(self._bare, speed)
        return self._modal if whirl is None else self._on_foundation(whirl)

    def _on_foundation(self, shaft: Coordinates) -> Coordinates:
        foundation = self._foundation
        return SupportedCoordinates(shaft, foundation, 2 * self._bare.size) if foundation else shaft

    def _new_step(self, speed: float, step: float) -> Maps:
        return self.coordinates(speed).maps(speed, step, self._unbalance.forces(self._bare, speed))

    def _new_detuning(self, speed: float, step: float) -> tuple[Maps, Maps, Detuning]:
        whole, half = (self._unit_maps(speed, length) for length in (step, 0.5 * step))
        return whole, half, self.coordinates(speed).detuning(speed, step)

    def _new_reading(self, speed: float | None) -> Reading:
        return self.coordinates(speed).reading(self._unbalance.forces(self._bare, 1.0))

    def _unit_maps(self, speed: float, step: float) -> Maps:
        """Maps for unbalances whose pull per kg m is given with each step."""
        return self.coordinates(speed).maps(speed, step, self._unbalance.forces(self._bare, 1.0))

    def _new_work(self, speed: float, step: float) -> WorkMaps:
        return work_maps(self._shaft, speed, step, self._unbalance.forces(self._shaft, speed))

    def _new_harmonic(self, speed: float) -> CondensedShaft[np.complex128]:
        nominal = self._unbalance.nominal_force(self._shaft, speed)
        return condense_harmonic(self._model, self._shaft, speed, nominal)


def _recall(items: OrderedDict[Any, Item], key: tuple[Any, ...], make: Callable[..., Item]) -> Item:
    """The item of a key, made of it if new; the least recently used one gives way."""
    found = items.get(key)
    if found is not None:
        items.move_to_end(key)
        return found
    made = items[key] = make(*key)
    if len(items) > CAPACITY:
        items.popitem(last=False)
    return made
