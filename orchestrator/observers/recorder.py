"""Watches every macro step and keeps what is recorded, until it is written elsewhere.

Between two records nothing is lost of the extremes: the largest forces and the least
gaps of every macro step enter the next record.  The largest values of the whole run are
kept besides, with their instants.

With many rates a record may fall between two evaluations of a bearing.  It then waits for the next one (of a
run that breaks off, those that still wait are not kept: a twentieth of a revolution at most), and
is complete when all its bearings are (`orchestrator.observers.between`).
"""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
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
from orchestrator.observers.between import Between, Bores
from orchestrator.observers.extremes import DEFECT, EXTREMES, SIGN, Noted, extremes_of
from orchestrator.observers.rows import Rows

Array = NDArray[np.float64]

_KEPT = np.array([k for name, k in RESPONSE.items() if not name.startswith(("F0.", "K[", "C["))])
KEPT = tuple(np.array(list(RESPONSE))[_KEPT].tolist())
"""Bearing outputs in the record: all but the affine law."""

SHAFT = ("amplitude.max", "amplitude.max_z", "stress.max", "stress.max_z")
FIELDS = ("x", "y", "amplitude", "stress")
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
    bores : Bores
        For what bearings tell between two evaluations.

    Attributes
    ----------
    peaks, peak_times : ndarray (bearings, 9)
        Extremes of the whole run in the order of `EXTREMES`, and their instants in s.
    """

    def __init__(self, system: System, nodes: int, steps: int, stride: int, bores: Bores) -> None:
        bearings = len(system.bearings)
        moving = bearings if system.housings is not None else 0
        self._system = system
        self._steps, self._stride = steps, stride
        self._newest = -1.0
        self._between = Between(bores, len(RESPONSE) + len(DETAILS))
        self._done: NDArray[np.bool_] | None = None
        self._none = np.zeros(bearings, dtype=bool)
        self.rows = Rows(
            {
                "times": ((), float),
                "journals": ((bearings, 8), float),
                "responses": ((bearings, len(KEPT)), float),
                "extremes": ((bearings, len(EXTREMES)), float),
                "shaft": ((len(SHAFT),), float),
                "fields": ((len(FIELDS), nodes), np.float32),
                "housings": ((moving, 8), float),
                "foundation": ((moving, len(port.FOUNDATION)), float),
                "speeds": ((), float),
                "details": ((bearings, len(DETAILS)), float),
            }
        )
        self._details_now = np.zeros((bearings, len(DETAILS)))
        self._detail_blocks = [
            Block(unit, list(DETAILS), row)
            for unit, row in zip(system.bearings, self._details_now, strict=True)
            if tells_details(unit)
        ]
        self._foundation_values = np.empty((moving, len(port.FOUNDATION)))
        on_foundation = [port.at_bearing(i, name) for i in range(1, moving + 1) for name in port.FOUNDATION]
        self._foundation_block = Block(system.rotor, on_foundation, self._foundation_values.reshape(-1))
        self._noted = Noted(bearings)
        self._frozen: int | None = None
        self._shaft_values, self._field_values = np.empty(len(SHAFT)), np.empty((len(FIELDS), nodes))
        # Each of neighbours in the rotor, which gives them in one piece.
        names = [f"node[{k}].{field}" for field in FIELDS for k in range(1, nodes + 1)]
        self._shaft_blocks = (
            Block(system.rotor, SHAFT, self._shaft_values),
            Block(system.rotor, names, self._field_values.reshape(-1)),
        )

    def begin(self, stepper: Stepper) -> None:
        """Keep the start."""
        self._noted.note(0.0, self._system.responses)
        self.record(0, 0.0, stepper)

    def watch(self, start: float, end: float, advance: Advance) -> None:
        """Note the extremes of the system as it stands after a step, and complete records that waited."""
        done = self._done = advance.evaluated
        self._noted.note(end, self._system.responses, advance.defect, advance.of_length, done)
        if done is not None:
            rows = self.rows.held
            if self._detail_blocks and self._between.waits(rows):
                for block in self._detail_blocks:
                    block.get()
            if self._between.evaluated(done, end, rows, self._told, self._system.motion):
                self._fill()

    def record(self, step: int, time: float, stepper: Stepper) -> None:
        """Keep a record if one is due."""
        if step % self._stride == 0 or step == self._steps:
            self._keep(time)

    def stop(self, step: int | None, time: float, stepper: Stepper) -> None:
        """Keep a record of where the run stopped, unless there is one, or some bearings stand behind."""
        if self._whole and 0.0 <= self._newest < time and not self._system.rotor.failed:
            self._keep(time)

    def _keep(self, time: float) -> None:
        system = self._system
        for block in (*self._detail_blocks, *self._shaft_blocks):
            block.get()
        moving = {}
        if system.housings is not None:
            self._foundation_block.get()
            moving = {"housings": system.housings, "foundation": self._foundation_values}
        row = self.rows.add(
            times=time,
            speeds=system.speed,
            journals=system.journals,
            responses=system.responses[:, _KEPT],
            details=self._details_now,
            extremes=self._noted.since * SIGN,
            shaft=self._shaft_values,
            fields=self._field_values,
            **moving,
        )
        self._noted.since[:] = -np.inf
        self._newest = time
        waits = self._none if self._done is None else self._between.stands < time
        self._between.kept(row, waits, self._told, system.stands_at())

    @property
    def _told(self) -> tuple[Array, Array]:
        """All that bearings tell where they stand."""
        return self._system.responses, self._details_now

    @property
    def _whole(self) -> bool:
        """Whether all bearings stand at the end of the last step."""
        return self._done is None or bool(self._done.all())

    def _fill(self) -> None:
        """Complete what waited; a copy is complete."""
        if self._frozen is not None:
            return
        kept = self.rows

        def motion(rows: NDArray[np.intp], bearing: NDArray[np.intp]) -> Array:
            at = kept["journals"][rows, bearing]
            return at if self._system.housings is None else at - kept["housings"][rows, bearing]

        if (found := self._between.fill(kept["times"], motion)) is None:
            return
        rows, bearing, values = found
        kept["responses"][rows, bearing] = values[:, _KEPT]
        kept["details"][rows, bearing] = values[:, len(RESPONSE) :]
        extremes = kept["extremes"][rows, bearing] * SIGN
        extremes[:, DEFECT] = np.maximum(extremes[:, DEFECT], 0.0)
        extremes = np.maximum(extremes, extremes_of(values))
        kept["extremes"][rows, bearing] = extremes * SIGN
        self._noted.note_later(kept["times"][rows], bearing, extremes)

    @property
    def size(self) -> int:
        """Records that are complete, among those that are not forgotten."""
        if self._frozen is not None:
            return self._frozen
        self._fill()
        return self._between.complete

    def forget(self, count: int) -> None:
        """Forget the first complete records, which are written elsewhere."""
        self._fill()
        self.rows.forget(count)
        self._between.first -= count

    def arrays(self) -> dict[str, NDArray[Any]]:
        """All that is here, by name; views."""
        self._fill()
        whole = {"since": self._noted.since, "peaks": self._noted.peaks, "peak_times": self._noted.times}
        whole |= {"newest": np.array(self._newest)} | self.rows.arrays()
        return whole | {f"between.{k}": x for k, x in self._between.arrays().items()}

    def restore(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what `arrays` returned."""
        self.rows.restore(arrays)
        self._between.restore(arrays)
        self._noted.since[:], self._noted.peaks[:] = arrays["since"], arrays["peaks"]
        self._noted.times[:] = arrays["peak_times"]
        self._newest = float(arrays["newest"])

    def copy(self) -> Recorder:
        """What is complete now, whatever the run goes on to do; views."""
        whole = copy(self)
        whole._frozen, whole.rows = self.size, self.rows.copy()
        return whole

    @property
    def between(self) -> float:
        """Share of what bearings tell in all records that lies between two evaluations."""
        return self._between.filled / max(1, (self.rows.forgotten + self.size) * len(self._system.bearings))

    @property
    def times(self) -> Array:
        """Instants of the records, (records,)."""
        return self.rows["times"][: self.size]

    @property
    def speeds(self) -> Array:
        """Speeds of the rotor, (records,)."""
        return self.rows["speeds"][: self.size]

    @property
    def journals(self) -> Array:
        """Motion q, v of the journals, (records, bearings, 8)."""
        return self.rows["journals"][: self.size]

    @property
    def housings(self) -> Array:
        """Motion q, v of the housings, (records, bearings, 8); no bearings where they stand rigidly."""
        return self.rows["housings"][: self.size]

    @property
    def foundation(self) -> Array:
        """Wrenches on the foundation, (records, bearings, 4); likewise."""
        return self.rows["foundation"][: self.size]

    def response(self, name: str) -> Array:
        """Bearing output `name`, one of `KEPT`, (records, bearings)."""
        return self.rows["responses"][: self.size, :, KEPT.index(name)]

    def detail(self, name: str) -> Array:
        """What only some films tell, one of `DETAILS`, (records, bearings); 0 of others."""
        return self.rows["details"][: self.size, :, DETAILS.index(name)]

    @property
    def has_details(self) -> bool:
        """Whether a bearing tells any."""
        return bool(self._detail_blocks)

    def extreme(self, name: str) -> Array:
        """Extreme of one of `EXTREMES` since the record before, (records, bearings)."""
        return self.rows["extremes"][: self.size, :, EXTREMES.index(name)]

    @property
    def peaks(self) -> Array:
        """Extremes of the whole run, (bearings, 9)."""
        self._fill()
        return self._noted.peaks * SIGN

    @property
    def peak_times(self) -> Array:
        """Their instants in s, (bearings, 9)."""
        self._fill()
        return self._noted.times

    def shaft(self, name: str) -> Array:
        """Rotor output `name`, one of `SHAFT`, (records,)."""
        return self.rows["shaft"][: self.size, SHAFT.index(name)]

    def field(self, name: str) -> NDArray[np.float32]:
        """Rotor output ``node[:].name``, one of `FIELDS`, (records, nodes)."""
        return self.rows["fields"][: self.size, FIELDS.index(name)]
