"""Runs in a process that may crash or hang, attended from one that must not; both live from run to run."""

from __future__ import annotations

import os
import pickle
import queue
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from multiprocessing import Pipe
from multiprocessing.connection import Connection

from orchestrator.study.ensemble.running.row import DIED, OVER_LIMIT, TRIED_AGAIN, Row

COMMAND = (sys.executable, "-P", "-m", "orchestrator.study.ensemble.running.runner")
STARTING = 300.0
"""Time in s in which a process must be ready."""
_PERIOD = 0.5  # s, between two looks at the clock
_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


class Attendant:
    """Attends one process, which it starts anew when it has ended; for one thread at a time.

    Attributes
    ----------
    ended : bool
        Whether it is at its end, and starts no other.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._there: Connection | None = None
        self.ended = False
        self._said = tempfile.TemporaryFile()  # noqa: SIM115

    def carry_out(self, work: bytes, limit: float = 0.0) -> Row:
        """Have work done, twice where that may have failed for the machine alone.

        Parameters
        ----------
        work : bytes
            A pickled `orchestrator.study.ensemble.running.bench.Work`.
        limit : float
            Wall time in s that it may take; 0 for any.
        """
        row = self._once(work, limit)
        if row.outcome not in TRIED_AGAIN:
            return row
        again = self._once(work, limit)
        return replace(again, message=f"{again.message} (twice)") if again.outcome in TRIED_AGAIN else again

    def end(self) -> None:
        """End the process for good: what it was at is not tried again."""
        self.ended = True
        self.close()

    def close(self) -> None:
        """End the process; the next work starts another."""
        process, there = self._process, self._there
        self._process = self._there = None
        if there is not None:
            there.close()
        if process is not None:
            process.kill()
            process.wait()

    def _once(self, work: bytes, limit: float) -> Row:
        try:
            there = self._connection()
            there.send_bytes(work)
            end = time.monotonic() + (limit or float("inf"))
            while not there.poll(_PERIOD):
                if time.monotonic() > end:
                    self.close()
                    return Row(OVER_LIMIT, f"took longer than {limit:g} s")
            row: Row = pickle.loads(there.recv_bytes())
        except (EOFError, OSError):
            return Row(DIED, self._last_words())
        if row.outcome in TRIED_AGAIN:  # its unit hangs there still
            self.close()
        return row

    def _connection(self) -> Connection:
        if self.ended:
            raise OSError("its study has ended")
        if self._there is None or self._process is None or self._process.poll() is not None:
            self.close()
            self._said.seek(0)
            self._said.truncate()
            self._there, there = Pipe()
            self._process = subprocess.Popen(
                [*COMMAND, str(there.fileno())],
                pass_fds=[there.fileno()],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=self._said,
                env=os.environ
                | dict.fromkeys(_THREADS, "1")
                | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
                start_new_session=True,  # a signal of the terminal is for the study, which closes its runs
            )
            there.close()
            if self._there.poll(STARTING):
                self._there.recv_bytes()  # it is ready: a limit does not count how long it takes to load
        return self._there

    def _last_words(self) -> str:
        process = self._process
        code = 0
        with suppress(subprocess.TimeoutExpired, AttributeError):
            code = process.wait(10.0)  # type: ignore[union-attr]
        self.close()
        how = f"by {signal.Signals(-code).name}" if code < 0 else f"with exit code {code}"
        self._said.seek(0)
        words = self._said.read().decode(errors="replace").strip().splitlines()
        last = f": {words[-1][:200]}" if words and code >= 0 else ""
        return f"the process of the run ended {how}{last}"


_idle: queue.LifoQueue[Attendant] = queue.LifoQueue()
_all: list[Attendant] = []


def attend(works: Sequence[bytes], limit: float = 0.0) -> list[Row]:
    """Have works done one after another by a process that is free, or a new one; what Dask calls."""
    attendant = None
    with suppress(queue.Empty):
        while attendant is None or attendant.ended:
            attendant = _idle.get_nowait()
    if attendant is None or attendant.ended:
        attendant = Attendant()
        _all.append(attendant)
    try:
        return [attendant.carry_out(work, limit) for work in works]
    finally:
        _idle.put(attendant)


def close_all() -> None:
    """End all processes of runs that this one has started, whatever they are at."""
    while _all:
        _all.pop().end()
    close_idle()


def close_idle() -> None:
    """End those processes of runs that this one has started, and that are at nothing."""
    with suppress(queue.Empty):
        while True:
            _idle.get_nowait().end()
