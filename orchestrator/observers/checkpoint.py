"""A run on disk, complete enough to go on to the bit: units, values between them, record, step control.

A checkpoint is one file.  It is written beside the last one, flushed to the disk and put in its
place by a rename, so that at any moment there is one whole checkpoint or none.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from orchestrator.errors import OrchestratorError
from orchestrator.master.observer import Observer
from orchestrator.master.start.equilibrium import Start
from orchestrator.master.stepping import StepCounts, Stepper
from orchestrator.master.system import System
from orchestrator.master.time_loop import Course
from orchestrator.observers.checkpoint_meta import Meta, problem_of
from orchestrator.whole_file import whole_file

Arrays = dict[str, NDArray[Any]]

FILE = "checkpoint.npz"
VERSION = 7


class Keeper(Protocol):
    """What watches a run and keeps something of it: record, ledger."""

    def arrays(self) -> Arrays:
        """Return all that it holds."""

    def restore(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Go on from there."""


class CheckpointError(OrchestratorError):
    """A checkpoint that is missing, damaged, or belongs to other FMUs."""


@dataclass(frozen=True)
class Checkpoint:
    """A saved run.

    Attributes
    ----------
    path : Path
        Its file.
    about : dict
        What the command needs to go on: scenario, folders, options.
    meta : dict
        Macro step, step control, evaluations, identity of the FMUs.
    arrays : dict
        Everything numerical.
    """

    path: Path
    about: dict[str, Any]
    meta: dict[str, Any]
    arrays: Arrays

    @property
    def time(self) -> float:
        """Simulated time that was reached in s."""
        return float(self.meta["time"])

    def start(self) -> Start:
        """The start of the run."""
        with self._fitting():
            start = Start(**{field.name: self.arrays[f"start.{field.name}"] for field in fields(Start)})
            bearings, nodes = len(self.meta["fmus"]) - 1, len(start.static_line)
            shapes: dict[str, tuple[int, ...]] = {
                "static_line": (nodes, 2),
                "loads": (bearings, 2),
                "tangents": (bearings if len(start.tangents) else 0, 4, 8),  # none if not asked for
            }
            for name, value in vars(start).items():
                if value.shape != shapes.get(name, (bearings, 4)) or value.dtype != np.float64:
                    raise ValueError(f"start.{name} is {value.dtype} of shape {value.shape}")
            return start

    @contextmanager
    def _fitting(self) -> Iterator[None]:
        """Say in a line that something is missing, or of another shape than this run's."""
        try:
            yield
        except (LookupError, ValueError, TypeError, AttributeError, ArithmeticError) as error:
            text = f"{type(error).__name__}: {error}"
            raise CheckpointError(f"{self.path}: does not belong to this run: {text}") from None

    def restore_units(self, system: System) -> None:
        """Put the units of a freshly assembled system where they were.

        Raises
        ------
        CheckpointError
            When an FMU is not the one of the checkpoint.
        """
        with self._fitting():
            self._restore_units(system)

    def _restore_units(self, system: System) -> None:
        if len(self.meta["fmus"]) != len(system.units):
            raise ValueError(f"{len(self.meta['fmus'])} units, not {len(system.units)}")
        for index, unit in enumerate(system.units):
            saved, found = self.meta["fmus"][index], str(unit.file.description.guid)
            if saved != found:
                raise CheckpointError(
                    f"{self.path}: made with another {unit.file.path.name} ({saved}, not {found}); "
                    "build the FMUs of that version, or start anew"
                )
            unit.resume(self.arrays[f"unit{index}"].tobytes())
            unit.evaluations = int(self.meta["evaluations"][index])
        system.graph.inputs[:] = self.arrays["inputs"]
        system.graph.outputs[:] = self.arrays["outputs"]

    def restore_run(self, stepper: Stepper, keepers: Mapping[str, Keeper], course: Course) -> int:
        """Put step control and what watches the run where they were; return the macro step."""
        with self._fitting():
            reached = min(self.meta["step"] * course.step, course.end)
            if self.meta["step"] > course.steps or abs(self.time - reached) > 1e-6 * course.step:
                raise ValueError(
                    f"step {self.meta['step']} at {self.time} s of {course.steps} to {course.end} s"
                )
            stepper.level = int(self.meta["level"])
            stepper.counts = StepCounts(**self.meta["counts"])
            stepper.scheme.memory = _without_prefix("scheme.", self.arrays)
            for name, keeper in keepers.items():
                keeper.restore(_without_prefix(f"{name}.", self.arrays))
            return int(self.meta["step"])


@dataclass
class Checkpoints:
    """Writes checkpoints of a run at regular intervals.

    Attributes
    ----------
    folder, every : Path, float
        Where the file lies, and simulated time from one to the next in s.
    about : mapping
        Kept with it, see `Checkpoint.about`.
    warn : callable
        Told of a checkpoint that could not be written.
    beside : callable
        Writes what else is due then, before the checkpoint is made of what is left.
    """

    folder: Path
    every: float
    about: Mapping[str, Any]
    warn: Callable[[str], None] = print
    beside: Callable[[], None] = lambda: None
    _last: float = float("-inf")

    def save(
        self,
        instant: tuple[int, float],
        system: System,
        stepper: Stepper,
        keepers: Mapping[str, Keeper],
        start: Start,
        *,
        last: bool = False,
    ) -> None:
        """Write the run as it stands at the end of a macro step, if a checkpoint is due or the `last`.

        The first must succeed; later ones may fail, for want of room, without harm to the run or to the
        checkpoint before.

        Raises
        ------
        CheckpointError
            When the first cannot be written.
        """
        step, time = instant
        # Half a millionth of the interval forgives the rounding of instants.
        if not last and time < self._last + self.every * (1.0 - 5e-7):
            return
        self.beside()
        meta = {
            "version": VERSION,
            "step": step,
            "time": time,
            "level": stepper.level,
            "counts": asdict(stepper.counts),
            "evaluations": [unit.evaluations for unit in system.units],
            "fmus": [str(unit.file.description.guid) for unit in system.units],
            "about": dict(self.about),
        }
        arrays: Arrays = {"inputs": system.graph.inputs, "outputs": system.graph.outputs}
        for index, unit in enumerate(system.units):
            arrays[f"unit{index}"] = np.frombuffer(unit.state_bytes(), dtype=np.uint8)
        arrays |= {f"start.{name}": value for name, value in vars(start).items()}
        arrays |= {f"scheme.{name}": value for name, value in stepper.scheme.memory.items()}
        for keeper, watching in keepers.items():
            arrays |= {f"{keeper}.{name}": value for name, value in watching.arrays().items()}
        path = self.folder / FILE
        try:
            write(path, meta, arrays)
        except OSError as error:
            if self._last == float("-inf"):
                raise CheckpointError(f"{path}: cannot be written: {error}") from None
            self.warn(f"{path}: no checkpoint at t = {time:.6g} s, the one before stays: {error}")
        self._last = time


@dataclass(frozen=True)
class Saver(Observer):
    """Writes the checkpoints of a run.

    Attributes
    ----------
    checkpoints : Checkpoints
        Where, and how often.
    system, start : System, Start
        What runs, and how it started.
    keepers : mapping
        What else watches the run, by name.
    """

    checkpoints: Checkpoints
    system: System
    start: Start
    keepers: Mapping[str, Keeper]

    def begin(self, stepper: Stepper) -> None:
        """Write the first."""
        self.record(0, 0.0, stepper)

    def record(self, step: int, time: float, stepper: Stepper) -> None:
        """Write one if it is due."""
        self.checkpoints.save((step, time), self.system, stepper, self.keepers, self.start)

    def stop(self, step: int | None, time: float, stepper: Stepper) -> None:
        """Write the last, behind a macro step."""
        if step is not None:
            self.checkpoints.save((step, time), self.system, stepper, self.keepers, self.start, last=True)


def write(path: Path, meta: Mapping[str, Any], arrays: Arrays) -> None:
    """Write a checkpoint's file: whole, or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    text = np.frombuffer(json.dumps(meta).encode(), dtype=np.uint8)
    with whole_file(path) as file:
        np.savez(file, meta=text, **arrays)  # type: ignore[arg-type]


def read(folder: Path) -> Checkpoint:
    """Read the checkpoint in a folder.

    Raises
    ------
    CheckpointError
        When there is none, or it cannot be read.
    """
    path = folder / FILE
    if not path.is_file():
        raise CheckpointError(f"{path}: no such file; only a run with --checkpoint can be resumed")
    try:
        with np.load(path) as stored:
            arrays: Arrays = {name: stored[name] for name in stored.files}
        meta = json.loads(arrays.pop("meta").tobytes())
        version = meta["version"]
    except Exception as error:  # zipfile, numpy and json have their own each
        reason = " ".join(str(error).split())
        raise CheckpointError(f"{path}: not a readable checkpoint: {reason}") from None
    if version != VERSION:
        raise CheckpointError(f"{path}: of version {version!r}; this program reads version {VERSION}")
    try:
        Meta.model_validate(meta)
    except ValidationError as error:
        raise CheckpointError(f"{path}: not a checkpoint of a run: {problem_of(error)}") from None
    return Checkpoint(path, meta["about"], meta, arrays)


def _without_prefix(prefix: str, arrays: Arrays) -> Arrays:
    return {name.removeprefix(prefix): value for name, value in arrays.items() if name.startswith(prefix)}
