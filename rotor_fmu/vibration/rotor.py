"""The rotor of the FMU: a shaft that takes macro steps under affine bearing laws."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rotor_fmu.reduction.reduce import Method
from rotor_fmu.train.train import Train
from rotor_fmu.vibration import field_loops, law_loops, whirl_loops
from rotor_fmu.vibration.affine_step import AffineStep
from rotor_fmu.vibration.coordinates import Coordinates, Maps
from rotor_fmu.vibration.drive import NOTHING, Braking
from rotor_fmu.vibration.motion import RotorMotion
from rotor_fmu.vibration.prepared import PreparedShaft, prepare_shaft
from rotor_fmu.vibration.spin import Spin
from rotor_fmu.vibration.state import RotorState
from rotor_fmu.vibration.trail import Extrapolation
from rotor_fmu.vibration.turning import DetunedMaps, Turning
from rotor_fmu.vibration.unbalance import Unbalance, losses_of
from rotor_fmu.vibration.whirl_coordinates import WhirlMaps
from rotor_fmu.vibration.work import Work, WorkLedger

Array = NDArray[np.float64]


class Rotor(RotorMotion):
    """A shaft in its bearings, from a start state on.

    Parameters
    ----------
    shaft : PreparedShaft
        The shaft, see `of_train` for that of a train.
    unbalance : Unbalance
        Its excitation.
    gravity : float
        In the direction of the train's gravity [m/s2].
    speed : float
        Speed at the start [rad/s].
    inertia : float
        Of the shaft about its axis [kg m2], for a free rotation and the energy of any.
    track_work : bool
        Keep account of the works, for the cost that `fmus.port.balance.TRACK_WORK` says; the first step
        of each size takes some seconds (minutes for the unreduced shaft).

    Attributes
    ----------
    reduction_used : str
        How it was reduced, see `ReducedShaft.carried_out`.

    Notes
    -----
    The speed runs linearly through a step, from that at the end of the step before.  Its change acts on the
    unbalance, with the tangential force, and on the gyroscopic moments.  While it changes, steps are taken in
    modes of a grid of speeds (`rotor_fmu.vibration.detuning`); each new one takes a thousand times as
    long as a step.
    """

    holds_mean = False
    """Whether the last step held a part of some wrench at its mean, see `rotor_fmu.vibration.affine_step`."""

    def __init__(
        self,
        shaft: PreparedShaft,
        unbalance: Unbalance,
        *,
        gravity: float,
        speed: float,
        inertia: float = 0.0,
        track_work: bool = False,
    ) -> None:
        super().__init__(shaft, unbalance, gravity=gravity, speed=speed)
        for loops in (law_loops, whirl_loops, field_loops):
            loops.compile_now()  # here, for a step is expected to end soon
        self._stepper = AffineStep(self.shaft.bearings)
        self._spin = Spin(unbalance, inertia)
        self._ledger = WorkLedger(self.shaft, self._maps.work, unbalance) if track_work else None

    @classmethod
    def of_train(
        cls,
        train: Train,
        *,
        reduction: Method = "irs",
        gravity: float | None = None,
        speed: float | None = None,
        unbalance: ArrayLike | None = None,
        unbalance_phase: ArrayLike | None = None,
        blade_unbalance: ArrayLike | None = None,
        blade_phase: ArrayLike | None = None,
        fracture_time: float = math.inf,
        losses: str = "",
        inertia: float = 0.0,
        track_work: bool = False,
    ) -> Rotor:
        """The rotor of a train.

        Parameters
        ----------
        train : Train
            The train.
        reduction : str
            How the shaft is reduced: irs, irs-plain, guyan, craig-bampton or none; see `reduce`.
        gravity : float, optional
            [m/s2], in the direction of the train's; default that of the train.
        speed : float, optional
            Speed at the start [rad/s]; default that of the train.
        unbalance, unbalance_phase : array_like, (n_w,), optional
            Nominal unbalance of the wheels [kg m] and its angle at t = 0 [rad]; default that of the train.
        blade_unbalance, blade_phase : array_like, (n_w,), optional
            Unbalance added by the blade fracture and its angle at t = 0; default none.
        fracture_time : float
            Instant of the fracture [s].
        losses : str
            What is lost besides, see `rotor_fmu.vibration.unbalance.losses_of`.
        inertia, track_work : float, bool
            As for the class.
        """
        excitation = Unbalance.of_train(
            train,
            unbalance,
            unbalance_phase,
            blade_unbalance,
            blade_phase,
            fracture_time,
            losses_of(losses, len(train.wheels)),
        )
        return cls(
            prepare_shaft(train, reduction),
            excitation,
            gravity=train.weight if gravity is None else gravity,
            speed=train.speed if speed is None else speed,
            inertia=inertia,
            track_work=track_work,
        )

    def freely(self, t: float, H: float, F0: Array, K: Array, C: Array, now: Braking) -> None:
        """Take a macro step in which torques decide the speed; otherwise as `step`."""
        state = self._state
        along = self._spin.along(t + 0.5 * H, self.seen())
        speed = self._spin.speed_after((state.angle, self.speed), H, along, now, state.owed)
        self.step(t, H, F0, K, C, speed, now, free=True)

    def go(self, t: float, H: float, F0: Array, K: Array, C: Array, speed: float, parts: int = 1) -> bool:
        """Take a macro step in equal parts in one go, each as `step` takes one, in some half of the time.

        That is where nothing but the laws and the unbalances acts on a circular shaft at constant speed.
        Elsewhere nothing is done.

        Parameters
        ----------
        parts : int
            Within each, wrenches run straight.
        others
            As for `step`.

        Returns
        -------
        bool
            Whether the step was taken.

        Raises
        ------
        NoFiniteResult
            As `step`.
        """
        state, part = self._state, H / parts
        if not speed == self.speed == state.speed or self._ledger or self.shaft.massless is not None:
            return False
        if not 0.0 < H < math.inf or any(self.unbalance.inside(t, t + H)):
            return False
        maps = self._maps.step(speed, part, t + part)
        if not isinstance(maps, WhirlMaps):
            return False
        angles = [state.angle + speed * (k * part) for k in range(parts)]
        turned = [self.unbalance.turned(t, complex(math.cos(at), math.sin(at))) for at in angles]
        self._stepper.set_law(K, C)
        end, after, nearer, _ = self._stepper.advance_whirl(
            maps, state.motion, self._journals, F0, np.array(turned), state.static
        )
        self.holds_mean = nearer is not None
        angle = math.fmod(angles[-1] + speed * part, 2.0 * math.pi)
        where = state.static, state.speed, state.basis
        self._go_on(RotorState(end, angle, *where, state.work, speed, 0.0, t + H, None, after), None)
        return True

    def step(
        self,
        t: float,
        H: float,
        F0: Array,
        K: Array,
        C: Array,
        speed: float,
        now: Braking = NOTHING,
        *,
        free: bool = False,
    ) -> None:
        """Take a macro step.

        Parameters
        ----------
        t : float
            Instant at the start [s]; decides whether the blade breaks within the step.
        H : float
            Length of the step [s], positive.
        F0, K, C : ndarray, (n_b, 4), (n_b, 4, 4), (n_b, 4, 4)
            The law of each bearing, valid through the step.
        speed : float
            At the end of the step [rad/s].
        now : Braking
            What brakes the rotation, for the works.
        free : bool
            Whether the rotation pays for what it does; else the drive holds the speed.

        Raises
        ------
        NoFiniteResult
            If the step has no finite result, as under a law that is not finite; the state before it stands.
        ValueError
            If H is not positive and finite, or the speed is not finite.
        """
        if not (math.isfinite(H) and H > 0.0 and math.isfinite(speed)):
            raise ValueError(f"rotor: step H = {H} s at {speed} rad/s; allowed are H > 0 and finite numbers")
        turning = Turning(self._state.angle, self.speed, speed, H)
        coordinates, maps, rotation, kick = self._at(turning, t)
        self._stepper.set_law(K, C)
        state, journals, motion = self._state, self._journals, self._motion_in(coordinates)
        beyond = None if self.shaft.massless is None else Extrapolation(self.shaft, state.trail, H)
        end, after, nearer, trail = self._stepper.advance(
            coordinates, maps, motion, journals, F0, rotation, kick, state.static, beyond
        )
        self.holds_mean = nearer is not None
        work, owed, given = state.work, 0.0, 0.0
        seen = None
        if self._ledger is not None or free:
            seen = self._maps.reading(coordinates.speed)(end)
            ends = self._spin.along(t + 0.5 * H, self.seen()), self._spin.along(t + 0.5 * H, seen)
            given = self._spin.work(t, turning, (self.seen(), seen))
            given += H * maps.power if isinstance(maps, DetunedMaps) else 0.0
        if self._ledger is not None:
            held = self._stepper.held(nearer, F0, journals, after, state.static)
            before = self.modal_state()
            if turning.start == turning.end:
                turn = (state.angle, speed)
                done = self._ledger.over_step((t, H), turn, before, held, state.static)
            else:
                states = before, coordinates.to_modal(end)
                done = self._ledger.over_turned_step(H, states, held, state.static, given)
            account = self._spin.account(turning, ends, now, state.owed if free else None, done.unbalance)
            done = done._replace(drive=account.drive, friction=account.friction, windage=account.windage)
            work, owed = Work(*(a + b for a, b in zip(work, done, strict=True))), account.owed
        elif free:
            owed = self._spin.account(turning, ends, now, state.owed, given).owed
        turned = math.fmod(turning.angle_at(H), 2.0 * math.pi)
        where = coordinates.speed, coordinates.basis
        then = RotorState(end, turned, state.static, *where, work, speed, owed, t + H, trail, after)
        self._go_on(then, seen)

    def _at(self, turning: Turning, t: float) -> tuple[Coordinates, Maps, Array, Array | None]:
        """Coordinates and maps of a step, rotation of the unbalances, and the kick of what appears in it."""
        end, kicks = t + turning.step, []
        if turning.start == turning.end:
            speed, angle = turning.start, turning.angle
            pull = complex(math.cos(angle), math.sin(angle))
            for loss, at in self.unbalance.inside(t, end):
                kicks.append(self._maps.kick(speed, end - at, angle + speed * (at - t), loss))
            coordinates, maps = self._maps.coordinates(speed), self._maps.step(speed, turning.step, end)
        else:
            pull = turning.pull()
            for loss, at in self.unbalance.inside(t, end):
                kicks.append(self._maps.turned_kick(turning.part(at - t), turning.reference, loss))
            coordinates, maps = self._maps.coordinates(turning.reference), self._maps.turned(turning, end)
        return coordinates, maps, self.unbalance.turned(t, pull), sum(kicks[1:], kicks[0]) if kicks else None

    @property
    def keeps_account(self) -> bool:
        """Whether it keeps account of works."""
        return self._ledger is not None

    def energy_of_rotation(self) -> float:
        """Kinetic energy of the rotation now, and of unbalance and vibration together [J]."""
        along = self._spin.along(self._state.time, self.seen())
        return self._spin.energy((self._state.angle, self.speed), along)

    def work(self) -> Work:
        """Works since the start [J]; the rotor must keep account of them (`track_work`)."""
        if self._ledger is None:
            raise ValueError("rotor: it keeps no account of works; set track_work at its creation")
        return self._state.work
