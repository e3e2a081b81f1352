"""The rotor as an FMU: values in, shaft, values out.  The one module here that knows FMI."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from fmus import port
from fmus.unit.failure import UnitError
from fmus.unit.layout import Layout
from fmus.unit.slave import UnitSlave
from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.train import Train
from rotor_fmu.vibration.drive import NOTHING, Braking, Drive, course_of, torque_of
from rotor_fmu.vibration.rotor import Rotor
from rotor_fmu.vibration.state import RotorState

_LAW = len(port.LAW)


@lru_cache(maxsize=4)
def _train_and_layout(train_text: str, starts_text: str) -> tuple[Train, Layout]:
    train = Train.from_json(train_text)
    names = [b.name for b in train.bearings], [w.name for w in train.wheels]
    return train, Layout(
        port.rotor(*names, train.nodes, json.loads(starts_text), moving=train.has_moving_housings)
    )


class RotorSlave(UnitSlave):
    """The shaft of a train; the train and its start values lie in the FMU's resources."""

    model_type = RotorState

    def __init__(self, **kwargs: Any) -> None:
        resources = Path(kwargs["resources"])
        files = (resources / "train.json").read_text(), (resources / "starts.json").read_text()
        self._train, layout = _train_and_layout(*files)
        super().__init__(layout, **kwargs)
        bearings = len(self._train.bearings)
        last = 1 + bearings * _LAW
        law = self.inputs[1:last].reshape(bearings, _LAW)
        switches = len(port.SWITCHES)
        self._switches, self._lost, self._friction = np.split(self.inputs[last:], [switches, switches + 1])
        self._law = (
            law[:, :4],
            law[:, 4:20].reshape(bearings, 4, 4),
            law[:, 20:].reshape(bearings, 4, 4),
        )
        # Journals, and behind them the housings where these move.
        outputs = self.values[layout.outputs]
        self._motion, self._rotation = outputs[:-1].reshape(-1, bearings, 8), outputs[-1:]
        self._built_for: dict[str, Any] | None = None

    def _value(self, name: str) -> float:
        return float(self.values[self.layout[name]])

    def _per_wheel(self, key: str) -> list[float]:
        return [self._value(f"wheel[{j}].{key}") for j in range(1, len(self._train.wheels) + 1)]

    def prepare(self) -> None:
        """Build the shaft of the parameters; loads and positions follow from train and gravity."""
        train, gravity = self._train, self._value("gravity")
        if gravity < 0.0:
            raise UnitError(f"gravity = {gravity} m/s2, allowed is >= 0; the train has its direction")
        loads = target_loads(train, gravity)
        for i, seat in enumerate(train.bearings, 1):
            self.values[self.layout[f"bearing[{i}].load"]] = loads[i - 1]
            self.values[self.layout[f"bearing[{i}].z"]] = train.z[seat.node]
        for j, wheel in enumerate(train.wheels, 1):
            self.values[self.layout[f"wheel[{j}].z"]] = train.z[wheel.node]
        self.values[self.layout.block("node[1].z", f"node[{train.nodes}].z")] = train.z
        self._parts = int(self._value(port.PARTS))
        if self._parts < 1:
            raise UnitError(f"{port.PARTS} = {self._parts}, allowed is >= 1")
        self._drive = Drive(
            course=course_of(self.strings[self.layout[port.COURSE]]),
            inertia=self._value("drive.inertia"),
            windage=self._value("drive.windage"),
            windage_broken=self._value("drive.windage_broken"),
            torque=torque_of(self.strings[self.layout[port.TORQUE]]),
        )
        self._build()

    def _build(self) -> None:
        """Make the rotor anew where something it is built of has changed."""
        built_for: dict[str, Any] = {
            "reduction": self.strings[self.layout["reduction"]],
            "gravity": self._value("gravity"),
            "speed": self._start_speed(),
            "fracture_time": self._value("fracture.time"),
            "losses": self.strings[self.layout[port.LOSSES]],
            "inertia": self._value("drive.inertia"),
            "track_work": bool(self._value("track_work")),
        }
        for key in ("unbalance", "unbalance_phase", "blade_unbalance", "blade_phase"):
            built_for[key] = self._per_wheel(key)
        if built_for != self._built_for:
            self._built_for = None
            self._rotor = Rotor.of_train(self._train, **built_for)
            self._built_for = built_for
            self.strings[self.layout["reduction.used"]] = self._rotor.reduction_used

    def start(self) -> None:
        """Start from the laws at the inputs or from the start parameters."""
        self._build()  # the speed is an input
        orbit = bool(self._value("start.orbit"))
        if self._value("start.from_law"):
            self._rotor.start_from_law(*self._law, orbit=orbit, time=self.start_time)
        else:
            parts = [self._start_positions(part) for part in ("", "_cos", "_sin")]
            if not orbit:
                parts[1:] = np.zeros_like(parts[0]), np.zeros_like(parts[0])
            self._rotor.start_from_positions(*parts, time=self.start_time)
        if not (self._drive.course or self._drive.torque):
            self._rotor.get_ready()
        self._show()

    def _start_speed(self) -> float:
        drive = self._drive
        return drive.on_course(self.start_time) if drive.course else float(self.inputs[0])

    def _braking(self) -> tuple[bool, Braking]:
        """Whether torques decide the speed, and what acts on the rotation now, where that is asked for."""
        values = self._switches.tolist()
        if not (any(values) or self._drive.torque or self._rotor.keeps_account):
            return False, NOTHING
        on = {name for name, value in zip(port.SWITCHES, values, strict=True) if value >= 0.5}
        free = self._drive.is_free(on)
        if not (free or self._rotor.keeps_account):
            return free, NOTHING
        friction = float(self._friction.sum())
        return free, self._drive.braking(self._rotor.speed, friction, on)

    def _show(self) -> None:
        """Write the motion of journals and housings, and the speed."""
        self._rotation[0] = self._rotor.speed
        self._motion[0] = self._rotor.kinematics()
        if len(self._motion) > 1:
            self._motion[1] = self._rotor.housings()

    def starts_on(self) -> int:
        """Return 1, for the speed, unless the start is asked for under the laws at the inputs."""
        return len(self.inputs) if self._value("start.from_law") else 1

    def _start_positions(self, part: str) -> np.ndarray:
        """Return the start parameters of one part, (n_b, 4)."""
        bearings = range(1, len(self._train.bearings) + 1)
        return np.array(
            [[self._value(f"bearing[{i}].start.{q}{part}") for q in port.POSITION] for i in bearings]
        )

    def advance(self, time: float, step: float) -> None:
        """Step the shaft under the laws at the inputs, in as many equal parts as are asked for."""
        rotor = self._rotor
        rotor.unbalance.lose(int(self._lost[0]))
        free, _ = self._braking()
        if free or not rotor.go(time, step, *self._law, self._speed_by(time + step, 1.0), self._parts):
            before, part = rotor.get_state(), step / self._parts
            try:
                for k in range(self._parts):
                    self._advance_part(time + k * part, part, 1.0 / (self._parts - k))
            except Exception:
                rotor.set_state(before)
                raise
        self._show()

    def _advance_part(self, time: float, step: float, share: float) -> None:
        """Step the shaft over a part, which has this share of what is left of the step."""
        free, now = self._braking()
        if free:
            self._rotor.freely(time, step, *self._law, now)
        else:
            self._rotor.step(time, step, *self._law, self._speed_by(time + step, share), now)

    def _speed_by(self, end: float, share: float) -> float:
        """Speed at an instant: that of the course, or this share of the way to that at the input."""
        if self._drive.course:
            return self._drive.on_course(end)
        given, now = float(self.inputs[0]), self._rotor.speed
        return given if share == 1.0 else now + share * (given - now)

    def observe(self, group: str) -> None:
        """Write extremes over the shaft, wrenches on the foundation, energies, works, or the fields."""
        if group == "extremes":
            self.values[self.layout.block("amplitude.max", "stress.max_z")] = self._rotor.extremes()
            return
        if group == "foundation":
            wrench = self._rotor.foundation_wrench()
            last = port.at_bearing(len(wrench), port.FOUNDATION[-1])
            block = self.layout.block(port.at_bearing(1, port.FOUNDATION[0]), last)
            self.values[block] = wrench.ravel()
            return
        if group == "energy":
            self.values[self.layout.block(port.ENERGY[0], port.ENERGY[-1])] = (
                *self._rotor.energy(),
                self._rotor.energy_of_rotation(),
            )
            return
        if group == "work":
            work = self._rotor.work() if self._value("track_work") else 0.0
            self.values[self.layout.block(port.WORK[0], port.WORK[-1])] = work
            return
        block = self.layout.block("node[1].x", f"node[{self._train.nodes}].stress")
        self.values[block] = self._rotor.fields().all.ravel()

    def model_state(self) -> RotorState:
        """Return the state of the shaft."""
        return self._rotor.get_state()

    def restore_model(self, state: RotorState) -> None:
        """Take back the state of the shaft."""
        self._rotor.set_state(state)
