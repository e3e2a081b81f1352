"""The record of a run while it goes on: what is kept is written to a folder, and leaves the memory.

The folder is that of the checkpoint, or one of its own beside the results of a run without.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from threading import Lock
from time import monotonic

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from orchestrator.errors import NotWrittenError
from orchestrator.master.observer import Observer
from orchestrator.master.stepping import Stepper
from orchestrator.observers.checkpoint import CheckpointError
from orchestrator.observers.recorder import Recorder
from orchestrator.observers.revolutions import Revolutions
from orchestrator.results.growing_record import (
    GROWING,
    GrowingRecord,
    GrowingRecordError,
    files_of,
    open_growing,
)

RUNNING = "running"
"""The attribute ``status`` of such a record."""

HELD = 4 * 2**20
"""Bytes of rows that are held in memory."""
PATIENCE = 60.0
"""Wall time in s behind which what there is is written."""


@dataclass
class RecordSoFar(Observer):
    """Writes it.

    Attributes
    ----------
    folder : Path
        Where.
    recorder, revolutions : Recorder, Revolutions or None
        Of what they have kept complete rows are written and forgotten.
    make : callable
        A record of the rows that they hold.
    warn : callable
        Told of what cannot be written; it stays in memory until it can.
    """

    folder: Path
    recorder: Recorder
    revolutions: Revolutions | None
    make: Callable[[], xr.Dataset]
    warn: Callable[[str], None]
    _written: GrowingRecord | None = None
    _allowed: int = field(default_factory=lambda: HELD)
    _last: float = field(default_factory=monotonic)
    _lock: Lock = field(default_factory=Lock)

    def begin(self, stepper: Stepper) -> None:
        """Remove what another run has left."""
        self.remove()

    def go_on(self, checkpoint: Path) -> None:
        """Go on behind a checkpoint, at which all was written that it does not hold itself.

        Raises
        ------
        CheckpointError
            When that is not there.
        """
        turns = 0 if self.revolutions is None else self.revolutions.rows.forgotten
        counts = self.recorder.rows.forgotten, turns
        if not any(counts):
            self.remove()
            return
        try:
            self._written = open_growing(self.folder).first(counts)
            if GrowingRecord(self.folder, self.make()).layout != self._written.layout:
                raise GrowingRecordError(f"{files_of(self.folder)[0]}: is of a record with other series")
            self._written.write_head()  # what follows is written over what it counted besides
        except (GrowingRecordError, OSError) as error:
            raise CheckpointError(
                f"{error}; {checkpoint.name} goes on from there: put the files back, or start anew"
            ) from None

    def record(self, step: int, time: float, stepper: Stepper) -> None:
        """Write when there is much, or has been something for long."""
        held = self.recorder.rows.nbytes
        if self.revolutions is not None:
            held += self.revolutions.rows.nbytes
        if held > self._allowed or monotonic() > self._last + PATIENCE:
            self.write()

    def write(self) -> None:
        """Write what is complete.

        Raises
        ------
        NotWrittenError
            When what was written before is not there any more.
        """
        with self._lock:
            self._last = monotonic()
            count = self.recorder.size
            turns = 0 if self.revolutions is None else self.revolutions.rows.held
            if not count and not turns:
                return
            before = self._written or GrowingRecord(self.folder, xr.Dataset())
            try:
                data = self.make().assign_attrs(status=RUNNING)
                self._written = before.append(data)
            except GrowingRecordError as error:
                raise NotWrittenError(f"{error}; without what was written there is no record") from None
            except OSError as error:
                self._allowed *= 2
                self.warn(f"{self.folder}: the record so far cannot be written, it stays in memory: {error}")
                return
            self._allowed = HELD
            self.recorder.forget(count)
            if self.revolutions is not None:
                self.revolutions.rows.forget(turns)

    def series(self, name: str, held: NDArray[np.float64]) -> NDArray[np.float64]:
        """All rows of a series whose last ones are held."""
        if self._written is None:
            return held
        return np.append(self._written.dataset()[name].values, held)

    def joined(self, held: xr.Dataset) -> xr.Dataset:
        """The whole record, with all but the series as in that of the rows that are held.

        In memory where nothing is written, or what is held cannot be.
        """
        if self._written is None:
            return held
        if not any(held.sizes.get(name, 0) for name in GROWING):
            return self._written.dataset(held)
        return _concatenated(self._written.dataset(), held)

    def finish(self) -> None:
        """Write what there is, where something is written already."""
        if self._written is not None:
            self.write()

    def remove(self) -> None:
        """Remove the files."""
        for path in files_of(self.folder):
            with suppress(OSError):
                path.unlink(missing_ok=True)


def _concatenated(written: xr.Dataset, held: xr.Dataset) -> xr.Dataset:
    for dimension in set(GROWING) & set(held.dims):
        names = [name for name, variable in held.variables.items() if dimension in variable.dims]
        series = xr.concat([written[names], held[names]], dimension, join="override")
        held = held.drop_dims(dimension).merge(series, compat="override").assign_attrs(held.attrs)
    return held
