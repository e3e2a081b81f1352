"""Runs of the own command side by side, each in a process of its own, watched until all have ended."""

from __future__ import annotations

import json
import os
import queue
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from threading import Thread
from types import FrameType
from typing import IO

from orchestrator.errors import OrchestratorError
from orchestrator.master.interrupt import SIGNALS, counts, handled
from orchestrator.outcome import INPUT_ERROR, PROCESS_DIED, Outcome
from orchestrator.results.folder import partial_folder

COMMAND = (sys.executable, "-P", "-m", "orchestrator.cli.main", "run")
"""The own command, by the interpreter that runs this."""
DIED = "process-died"
"""Outcome of a run whose process ended without saying how the run ended."""
_ADVICE = "The process ended from outside or crashed, often for want of memory; try --jobs 1."
_PATIENCE = 10.0  # s that a process gets to leave after its last word, or when it is told to end

Show = Callable[[str, "str | Ended"], None]


@dataclass(frozen=True)
class Child:
    """A run to be done.

    Attributes
    ----------
    name : str
        Told with its progress.
    arguments : sequence of str
        Of ``bladeloss run``, but for the folder of the results.
    folder : Path
        Of the results.
    """

    name: str
    arguments: Sequence[str]
    folder: Path

    @property
    def results(self) -> Path:
        """Where results are: the folder, or that of partial results when the run left only these."""
        return self.folder if self.folder.is_dir() else partial_folder(self.folder)


@dataclass(frozen=True)
class Ended:
    """How a run ended.

    Attributes
    ----------
    outcome : str
        Value of an `Outcome`, or `DIED`.
    message, advice : str
        What failed, what helps.
    simulated : float
        Simulated time reached [s].
    wall_time : float
        Of the time loop [s].
    """

    outcome: str
    message: str = ""
    advice: str = ""
    simulated: float = 0.0
    wall_time: float = 0.0

    @property
    def ok(self) -> bool:
        """Whether the run is complete."""
        return self.outcome == Outcome.FINISHED.value

    @property
    def status(self) -> int:
        """Exit status of a command that ends with this run."""
        if self.outcome == DIED:
            return PROCESS_DIED
        return next(item for item in Outcome if item.value == self.outcome).status

    def text(self) -> str:
        """How it ended, for people."""
        words = f"{self.outcome} at t = {self.simulated:.4g} s"
        return f"{words}: {self.message}" if self.message else words


def cores() -> int:
    """Number of cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class _Process:
    """A child under way: a thread hands its lines on, a file keeps what it says of errors."""

    def __init__(
        self, child: Child, command: Sequence[str], said: queue.Queue[tuple[str, str | None]]
    ) -> None:
        self.child, self._said = child, said
        self.errors = tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace")  # noqa: SIM115
        self.process = subprocess.Popen(
            [*command, *child.arguments, "--out", str(child.folder)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=self.errors,
            text=True,
            encoding="utf-8",
            errors="replace",
            env=os.environ | {"COLUMNS": "200"},
            start_new_session=True,  # a signal of the terminal comes once, from here
        )
        assert self.process.stdout is not None
        Thread(target=self._listen, args=(self.process.stdout,), daemon=True).start()

    def _listen(self, stream: IO[str]) -> None:
        with stream:
            for line in stream:
                self._said.put((self.child.name, line.rstrip("\n")))
        self._said.put((self.child.name, None))

    def tell(self, number: int) -> None:
        """Send it a signal, unless it has ended."""
        with suppress(OSError):
            self.process.send_signal(number)

    def kill(self) -> None:
        """End it at once."""
        self.process.kill()
        self.process.wait()
        self.errors.close()

    def ended(self, asked: int | None) -> Ended:
        """How the run ended; `asked` is the signal by which all were told to end.

        Raises
        ------
        OrchestratorError
            What the run says is wrong with the input.
        """
        code = self.process.wait(_PATIENCE)
        with self.errors as file:
            file.seek(0)
            error = file.read().strip()
        if code == INPUT_ERROR:
            raise OrchestratorError(error.removeprefix("error: "))
        outcome = next((one for one in Outcome if one.status == code), None)
        if asked is not None and code == -asked:  # before it could listen
            outcome = Outcome.TERMINATED if asked == signal.SIGTERM else Outcome.INTERRUPTED
            error = "before the first step"
        summary = self.child.results / "summary.json"
        told = json.loads(summary.read_text(encoding="utf-8")) if summary.is_file() else {}
        simulated = told.get("simulated", 0.0)
        if outcome is None:
            how = f"by {signal.Signals(-code).name}" if code < 0 else f"with exit code {code}"
            last = f": {error.splitlines()[-1]}" if code > 0 and error else ""
            return Ended(DIED, f"the process of the run ended {how}{last}", _ADVICE, simulated)
        if told.get("outcome") == outcome.value:
            error = told["message"]
        error = error.removeprefix("error: ").removeprefix(f"{outcome.value} (exit status {code}): ")
        wall_time = told["timing"]["loop"] if told else 0.0
        return Ended(outcome.value, "" if outcome.ok else error, outcome.advice, simulated, wall_time)


def run_children(
    children: Sequence[Child], jobs: int, show: Show, *, command: Sequence[str] = COMMAND
) -> dict[str, Ended]:
    """Carry out runs in processes side by side.

    Parameters
    ----------
    children : sequence of Child
        Started in this order.
    jobs : int
        Largest number at the same time.
    show : callable
        Told, by the child's name, every line that it prints and at the end how it ended.
    command : sequence of str
        What runs a scenario.

    Returns
    -------
    dict of Ended
        How each run ended, by name in the order given: also one whose process died (`DIED`), and after
        Ctrl-C or SIGTERM, which is passed on so that the runs under way end between two steps. A second
        signal ends all at once.

    Raises
    ------
    OrchestratorError
        What a run says is wrong with the input; the other runs are ended.
    """
    said: queue.Queue[tuple[str, str | None]] = queue.Queue()
    waiting, running, ended = list(children), dict[str, _Process](), dict[str, Ended]()
    asked: list[int] = []

    def on_signal(number: int, _frame: FrameType | None) -> None:
        if not counts():
            return
        if asked:
            raise SIGNALS[number]
        asked.append(number)
        for process in list(running.values()):
            process.tell(number)

    try:
        with handled(on_signal):
            while waiting or running:
                while waiting and len(running) < jobs and not asked:
                    child = waiting.pop(0)
                    running[child.name] = _Process(child, command, said)
                    if asked:  # while it was started
                        running[child.name].tell(asked[0])
                for child in waiting if asked else ():
                    ended[child.name] = _not_started(asked[0])
                    show(child.name, ended[child.name])
                waiting = [] if asked else waiting
                if not running:
                    break
                try:
                    name, line = said.get(timeout=0.2)  # not for ever, which on Windows no signal ends
                except queue.Empty:
                    continue
                if line is not None:
                    show(name, line)
                    continue
                ended[name] = running[name].ended(asked[0] if asked else None)
                del running[name]
                show(name, ended[name])
    finally:
        for process in running.values():
            process.kill()
    return {child.name: ended[child.name] for child in children}


def _not_started(asked: int) -> Ended:
    outcome = Outcome.TERMINATED if asked == signal.SIGTERM else Outcome.INTERRUPTED
    return Ended(outcome.value, "not started", outcome.advice)
