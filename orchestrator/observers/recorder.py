"""Watches every macro step and keeps what is recorded, in memory set aside beforehand.

Between two records nothing is lost of the extremes: the largest forces and the least
gaps of every macro step enter the next record.  The largest values of the whole run are
kept besides, with their instants.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmus import port
from orchestrator.fmi.block import Block
from orchestrator.fmi.unit import Unit
from orchestrator.master.coupling import Advance
from orchestrator.master.observer import Observer
from orchestrator.master.start.pads import tilts
from orchestrator.master.stepping import Stepper
from orchestrator.master.system import RESPONSE, System

Array = NDArray[np.float64]

EXTREMES = (
    "force_magnitude",
    "moment_magnitude",
    "least_gap",
    "centre_line_gap",
    "contact_force",
    "contact_pressure",
    "wiped",
    "defect",
    "step_error",
)
"""Quantities whose extremes are kept; the gaps' least, the others' largest."""

_FORCE, _MOMENT, _DEFECT, _STEP_ERROR = (
    EXTREMES.index(name) for name in ("force_magnitude", "moment_magnitude", "defect", "step_error")
)
_SCALARS = slice(EXTREMES.index("least_gap"), EXTREMES.index("wiped") + 1)
_OUTPUTS = [
    RESPONSE[name] for name in ("h_min", "h_min_centre", "contact_force", "contact_pressure", "wiped")
]
"""Bearing outputs of which the extremes in `_SCALARS` are taken."""
_SIGN = np.array([-1.0 if name.endswith("gap") else 1.0 for name in EXTREMES])
_KEPT = [index for name, index in RESPONSE.items() if not name.startswith(("F0.", "K[", "C["))]
KEPT = tuple(name for name, index in RESPONSE.items() if index in _KEPT)
"""Bearing outputs in the record: all but the affine law."""

SHAFT = ("amplitude.max", "amplitude.max_z", "stress.max", "stress.max_z")
FIELDS = ("x", "y", "amplitude", "stress")
_KEPT_ARRAYS = (
    "times",
    "journals",
    "responses",
    "extremes",
    "shaft",
    "fields",
    "housings",
    "foundation",
    "speeds",
    "details",
)


DETAILS = tuple(variable.name for variable in port.BEARING_DETAILS)
"""Bearing outputs in the record where bearings tell them."""


def tells_details(unit: Unit) -> bool:
    """Whether a bearing tells `DETAILS`: one with tilting pads, or with a mass-conserving film."""
    if DETAILS[0] not in unit.file.variables:
        return False
    return tilts(unit) or unit.get_string(port.BEARING_KEYS["boundary"]) == "jfo"


class Recorder(Observer):
    """Records of a run.

    Parameters
    ----------
    system : System
        Watched after each of its steps.
    nodes : int
        Nodes of the shaft.
    steps : int
        Macro steps of the run.
    stride : int
        Macro steps from one record to the next; the start and the last step are always recorded.

    Attributes
    ----------
    size : int
        Records so far.
    peaks, peak_times : ndarray (bearings, 9)
        Extremes of the whole run in the order of `EXTREMES`, and their instants in s.
    """

    def __init__(self, system: System, nodes: int, steps: int, stride: int) -> None:
        bearings, capacity = len(system.bearings), math.ceil(steps / stride) + 2
        self._system = system
        self._steps, self._stride = steps, stride
        self.size = 0
        self._whole = True
        self._times = np.empty(capacity)
        self._journals = np.empty((capacity, bearings, 8))
        self._responses = np.empty((capacity, bearings, len(KEPT)))
        self._extremes = np.empty((capacity, bearings, len(EXTREMES)))
        self._shaft = np.empty((capacity, len(SHAFT)))
        self._fields = np.empty((capacity, len(FIELDS), nodes), dtype=np.float32)
        self._speeds = np.empty(capacity)
        self._details = np.zeros((capacity, bearings, len(DETAILS)))
        self._details_now = np.zeros((bearings, len(DETAILS)))
        self._detail_blocks = [
            Block(unit, list(DETAILS), row)
            for unit, row in zip(system.bearings, self._details_now, strict=True)
            if tells_details(unit)
        ]
        moving = bearings if system.housings is not None else 0
        self._housings = np.empty((capacity, moving, 8))
        self._foundation = np.empty((capacity, moving, len(port.FOUNDATION)))
        self._foundation_values = np.empty((moving, len(port.FOUNDATION)))
        on_foundation = [port.at_bearing(i, name) for i in range(1, moving + 1) for name in port.FOUNDATION]
        self._foundation_block = Block(system.rotor, on_foundation, self._foundation_values.reshape(-1))
        self._now = np.empty((bearings, len(EXTREMES)))
        self._since = np.full_like(self._now, -np.inf)
        self._peaks = np.full_like(self._now, -np.inf)
        self.peak_times = np.zeros_like(self._now)
        self._shaft_values = np.empty(len(SHAFT) + len(FIELDS) * nodes)
        names = [f"node[{k}].{field}" for field in FIELDS for k in range(1, nodes + 1)]
        self._shaft_block = Block(system.rotor, [*SHAFT, *names], self._shaft_values)

    def begin(self, stepper: Stepper) -> None:
        """Keep the start."""
        self._note(0.0, None)
        self.record(0, 0.0, stepper)

    def watch(self, start: float, end: float, advance: Advance) -> None:
        """Note the extremes of the system as it stands after a step."""
        self._whole = advance.evaluated is None or bool(advance.evaluated.all())
        self._note(end, advance)

    def record(self, step: int, time: float, stepper: Stepper) -> None:
        """Keep a record if one is due."""
        if step % self._stride == 0 or step == self._steps:
            self._keep(time)

    def stop(self, step: int | None, time: float, stepper: Stepper) -> None:
        """Keep a record of where the run stopped, unless there is one, or some bearings stand behind."""
        if self._whole and self.size and self._times[self.size - 1] < time and not self._system.rotor.failed:
            self._keep(time)

    def _note(self, time: float, advance: Advance | None) -> None:
        now, system = self._now, self._system
        forces = system.forces
        np.hypot(forces[:, 0], forces[:, 1], out=now[:, _FORCE])
        np.hypot(forces[:, 2], forces[:, 3], out=now[:, _MOMENT])
        np.multiply(system.responses[:, _OUTPUTS], _SIGN[_SCALARS], out=now[:, _SCALARS])
        for column, error in (
            (_DEFECT, advance and advance.defect),
            (_STEP_ERROR, advance and advance.of_length),
        ):
            if error is None:
                now[:, column] = 0.0
            else:
                np.hypot(error[:, 0], error[:, 1], out=now[:, column])
        np.maximum(self._since, now, out=self._since)
        higher = now > self._peaks
        if higher.any():
            self._peaks[higher] = now[higher]
            self.peak_times[higher] = time

    def _keep(self, time: float) -> None:
        k = self.size
        self._times[k] = time
        self._speeds[k] = self._system.speed
        self._journals[k] = self._system.journals
        self._responses[k] = self._system.responses[:, _KEPT]
        for block in self._detail_blocks:
            block.get()
        self._details[k] = self._details_now
        np.multiply(self._since, _SIGN, out=self._extremes[k])
        self._since[:] = -np.inf
        self._shaft_block.get()
        self._shaft[k] = self._shaft_values[: len(SHAFT)]
        self._fields[k] = self._shaft_values[len(SHAFT) :].reshape(len(FIELDS), -1)
        if self._system.housings is not None:
            self._foundation_block.get()
            self._housings[k] = self._system.housings
            self._foundation[k] = self._foundation_values
        self.size = k + 1

    def arrays(self) -> dict[str, NDArray[Any]]:
        """What was kept so far, by name; views."""
        kept = {name: getattr(self, f"_{name}")[: self.size] for name in _KEPT_ARRAYS}
        return kept | {"since": self._since, "peaks": self._peaks, "peak_times": self.peak_times}

    def restore(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what `arrays` returned."""
        self.size = len(arrays["times"])
        for name in _KEPT_ARRAYS:
            getattr(self, f"_{name}")[: self.size] = arrays[name]
        self._since[:], self._peaks[:] = arrays["since"], arrays["peaks"]
        self.peak_times[:] = arrays["peak_times"]

    @property
    def times(self) -> Array:
        """Instants of the records, (records,)."""
        return self._times[: self.size]

    @property
    def speeds(self) -> Array:
        """Speeds of the rotor, (records,)."""
        return self._speeds[: self.size]

    @property
    def journals(self) -> Array:
        """Motion q, v of the journals, (records, bearings, 8)."""
        return self._journals[: self.size]

    @property
    def housings(self) -> Array:
        """Motion q, v of the housings, (records, bearings, 8); no bearings where they stand rigidly."""
        return self._housings[: self.size]

    @property
    def foundation(self) -> Array:
        """Wrenches on the foundation, (records, bearings, 4); likewise."""
        return self._foundation[: self.size]

    def response(self, name: str) -> Array:
        """Bearing output `name`, one of `KEPT`, (records, bearings)."""
        return self._responses[: self.size, :, KEPT.index(name)]

    def detail(self, name: str) -> Array:
        """What only some films tell, one of `DETAILS`, (records, bearings); 0 of others."""
        return self._details[: self.size, :, DETAILS.index(name)]

    @property
    def has_details(self) -> bool:
        """Whether a bearing tells any."""
        return bool(self._detail_blocks)

    def extreme(self, name: str) -> Array:
        """Extreme of one of `EXTREMES` since the record before, (records, bearings)."""
        return self._extremes[: self.size, :, EXTREMES.index(name)]

    @property
    def peaks(self) -> Array:
        """Extremes of the whole run, (bearings, 9)."""
        return self._peaks * _SIGN

    def shaft(self, name: str) -> Array:
        """Rotor output `name`, one of `SHAFT`, (records,)."""
        return self._shaft[: self.size, SHAFT.index(name)]

    def field(self, name: str) -> NDArray[np.float32]:
        """Rotor output ``node[:].name``, one of `FIELDS`, (records, nodes)."""
        return self._fields[: self.size, FIELDS.index(name)]
