"""The record of a run while it goes on: with each checkpoint a file of the instants since the one before.

The files lie beside the checkpoint, each whole or not there; `read_record` of their folder joins them.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import xarray as xr

from orchestrator.observers.recorder import Recorder
from orchestrator.observers.revolutions import Revolutions
from orchestrator.results.record_files import block, block_name, blocks_in

RUNNING = "running"
"""The attribute ``status`` of such a record."""


@dataclass
class RecordSoFar:
    """Writes the files.

    Attributes
    ----------
    folder : Path
        That of the checkpoint.
    recorder, revolutions : Recorder, Revolutions or None
        What has been kept.
    make : callable
        A record of some rows of both.
    warn : callable
        Told of what cannot be written; the next file then begins there.
    rows, turns : int
        Rows of both that are written.
    """

    folder: Path
    recorder: Recorder
    revolutions: Revolutions | None
    make: Callable[[Recorder, Revolutions | None], xr.Dataset]
    warn: Callable[[str], None]
    rows: int = 0
    turns: int = 0

    def go_on(self) -> None:
        """Go on behind a checkpoint, at which all that was kept by then is written."""
        self.rows = self.recorder.size
        self.turns = 0 if self.revolutions is None else self.revolutions.size
        self._remove_from(self.rows)

    def write(self) -> None:
        """Write what is new, if anything is."""
        if not self.rows:
            self._remove_from(0)
        if self.recorder.size == self.rows:
            return
        turned = self.revolutions and self.revolutions.since(self.turns)
        data = self.make(self.recorder.since(self.rows), turned)
        path = self.folder / block_name(self.rows)
        fresh = path.with_suffix(f".{os.getpid()}.part")
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            with fresh.open("wb") as file:
                file.write(block(data.assign_attrs(status=RUNNING)))
                file.flush()
                os.fsync(file.fileno())  # a checkpoint that counts its rows comes behind it
            fresh.replace(path)
        except OSError as error:
            self.warn(f"{path}: not written, the next file has its instants: {error}")
            return
        finally:
            fresh.unlink(missing_ok=True)
        self.rows = self.recorder.size
        self.turns = 0 if self.revolutions is None else self.revolutions.size

    def _remove_from(self, row: int) -> None:
        """Remove files of rows that the run has not come to, of another run or another try."""
        for path in blocks_in(self.folder):
            if path.name >= block_name(row):
                with suppress(OSError):  # what is read again is overwritten, or of an older run
                    path.unlink(missing_ok=True)
