"""The motion of a rotor on its foundation: how it starts, and what is read of it at an instant."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rotor_fmu.shaft.condensation import Equilibrium, condense_static
from rotor_fmu.vibration import initial_state
from rotor_fmu.vibration.affine_step import journal_motion
from rotor_fmu.vibration.coordinates import Coordinates
from rotor_fmu.vibration.energy import Energy, EnergyMeter
from rotor_fmu.vibration.fields import Extremes, FieldMap, NodeFields
from rotor_fmu.vibration.map_cache import MapCache
from rotor_fmu.vibration.prepared import PreparedShaft
from rotor_fmu.vibration.state import RotorState
from rotor_fmu.vibration.supported import supported
from rotor_fmu.vibration.unbalance import Unbalance

Array = NDArray[np.float64]


class RotorMotion:
    """A shaft and what its bearings stand on, at an instant.

    Parameters are those of `rotor_fmu.vibration.rotor.Rotor`, which steps it.

    Attributes
    ----------
    foundation : Foundation or None
        What moves under the bearings.
    """

    _state: RotorState
    _modal: Array | None
    _displaced: Array | None
    _seen: Array | None

    def __init__(
        self,
        shaft: PreparedShaft,
        unbalance: Unbalance,
        *,
        gravity: float,
        speed: float,
    ) -> None:
        model = self.model = shaft.model
        self.reduction_used = shaft.reduced.carried_out
        self.shaft, self.unbalance, self._speed = supported(shaft.modal, shaft.foundation), unbalance, speed
        self.foundation = shaft.foundation
        self._maps = MapCache(shaft, self.shaft, unbalance)
        self._fields = FieldMap(self.shaft, shaft.bending, model.z, gravity)
        self._energy = EnergyMeter(model, self.shaft, gravity)
        self._condensed = condense_static(model, gravity)
        # At rest without wrenches until a start is given.
        nothing = np.zeros(len(self.shaft.bearing))
        rest = Equilibrium(np.zeros(model.size), nothing, nothing)
        self.set_state(RotorState(np.zeros(2 * self.shaft.size), 0.0, rest))

    def start_from_positions(
        self, static: ArrayLike, cos: ArrayLike, sin: ArrayLike, *, time: float = 0.0
    ) -> None:
        """Start with the journals moving as q(t) = static + cos cos(speed t) + sin sin(speed t).

        Parameters
        ----------
        static, cos, sin : array_like, (n_b, 4)
            [m], [rad]; static q at rest and the 1X orbit about it.
        time : float
            Instant of the start [s].
        """
        positions = (_array(static), _array(cos), _array(sin))
        harmonic = self._maps.harmonic(self._speed)
        angle = self._angle_at(time)
        found = initial_state.at_positions(self._condensed, harmonic, self._speed, positions, angle)
        self.set_state(replace(found, time=time))

    def start_from_law(
        self, F0: ArrayLike, K: ArrayLike, C: ArrayLike, *, orbit: bool, time: float = 0.0
    ) -> None:
        """Start in equilibrium with the affine laws w = F0 - K q - C v.

        Parameters
        ----------
        F0, K, C : array_like, (n_b, 4), (n_b, 4, 4), (n_b, 4, 4)
            The laws of the bearings.
        orbit : bool
            With the linear response to the nominal unbalance.
        time : float
            Instant of the start [s].

        Raises
        ------
        ValueError
            If K leaves a rigid-body motion of the shaft free.
        """
        law = (_array(F0), _array(K), _array(C))
        harmonic = self._maps.harmonic(self._speed)
        angle = self._angle_at(time)
        found = initial_state.under_law(self._condensed, harmonic, self._speed, law, angle, orbit)
        self.set_state(replace(found, time=time))

    def get_ready(self) -> None:
        """Make what steps at the speed of the start need, which takes a hundred times as long as one."""
        self._maps.coordinates(self._speed)

    def kinematics(self) -> Array:
        """Journal displacements q and velocities v now, (n_b, 8) in m, rad, m/s, rad/s."""
        housings = self.housings()
        return self._journals.copy() if housings is None else self._journals + housings

    @property
    def _journals(self) -> Array:
        """Motion of the journals in their housings."""
        assert self._state.journals is not None
        return self._state.journals

    def housings(self) -> Array | None:
        """Displacements and velocities of the housings now, (n_b, 8); None where they stand rigidly."""
        return None if self.foundation is None else self.foundation.housings(*self._foundation_motion())

    def foundation_wrench(self) -> Array:
        """Wrenches on the foundation now, (n_b, 4) in N, N m: what carries the housings, and their load."""
        static = -self.static_wrench()
        if self.foundation is None:
            return static
        return static + self.foundation.wrench(*self._foundation_motion())

    def _foundation_motion(self) -> Array:
        """Displacements and velocities of the foundation's modes, (2, k)."""
        assert self.foundation is not None
        k = self.foundation.size
        return self._state.motion[-2 * k :].reshape(2, k)

    @property
    def speed(self) -> float:
        """Speed of rotation now [rad/s]."""
        return self._speed if self._state.turning is None else self._state.turning

    def static_wrench(self) -> Array:
        """Wrenches that hold the shaft in the static equilibrium of the start, (n_b, 4) in N, N m."""
        return self._state.static.wrench.reshape(-1, 4).copy()

    def energy(self) -> Energy:
        """Kinetic energy of the vibration, strain energy and potential in gravity now [J]."""
        return self._energy(self.modal_state(), self._state.static)

    def fields(self) -> NodeFields:
        """Displacement, vibration amplitude and normal stress at all nodes now."""
        return self._fields.fields(self._displacements(), self._state.static)

    def extremes(self) -> Extremes:
        """Largest vibration amplitude and normal stress now, and where; cheap enough for every step."""
        return self._fields.extremes(self._displacements(), self._state.static)

    def modal_state(self) -> Array:
        """Modal displacements and velocities (p, p') of the vibration now, (2 m,); not to be changed."""
        if self._modal is None:
            self._modal = self._maps.coordinates(self._state.speed).to_modal(self._state.motion)
        return self._modal

    def _displacements(self) -> Array:
        """Modal displacements of the vibration now, (m,); not to be changed."""
        if self._displaced is None:
            self._displaced = self._maps.coordinates(self._state.speed).displacements(self._state.motion)
        return self._displaced

    def seen(self) -> Array:
        """The vibration now along the pulls of the unbalances, see `MapCache.reading`."""
        if self._seen is None:
            self._seen = self._maps.reading(self._state.speed)(self._state.motion)
        return self._seen

    def _motion_in(self, coordinates: Coordinates) -> Array:
        if coordinates.speed == self._state.speed:
            return self._state.motion
        return coordinates.from_modal(self.modal_state())

    def get_state(self) -> RotorState:
        """The state now; it is never changed in place and may be kept without copying."""
        return self._state

    def set_state(self, state: RotorState) -> None:
        """Go on from a state of this rotor or of another one of the same train and reduction."""
        sizes = (len(state.motion), len(state.static.shape), len(state.static.wrench))
        allowed = (2 * self.shaft.size, self.model.size, len(self.shaft.bearing))
        if sizes != allowed:
            raise ValueError(f"rotor: state with arrays of {sizes} numbers, allowed are {allowed}")
        coordinates = self._maps.coordinates(state.speed)
        if state.turning is None:
            state = replace(state, turning=self._speed)
        if not state.basis:
            state = replace(state, motion=coordinates.from_modal(state.motion), basis=coordinates.basis)
        elif state.basis != coordinates.basis:
            raise ValueError(
                "rotor: the state was saved by another build or kind of processor, on which the modes of the "
                "shaft come out in other vectors; go on there, or start anew"
            )
        if state.journals is None:
            moved = journal_motion(coordinates, state.motion, state.static, state.trail)
            state = replace(state, journals=moved)
        self._go_on(state, None)

    def _go_on(self, state: RotorState, seen: Array | None) -> None:
        """Take on a state in coordinates of this rotor."""
        self._state, self._modal, self._displaced, self._seen = state, None, None, seen

    def _angle_at(self, time: float) -> float:
        return math.fmod(self._speed * time, 2.0 * math.pi)


def _array(values: ArrayLike) -> Array:
    return np.asarray(values, dtype=np.float64)
