"""Runs side by side, each in a process of its own, watched until all have ended."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnContext, SpawnProcess
from multiprocessing.synchronize import Event
from types import FrameType

from orchestrator.errors import OrchestratorError
from orchestrator.master.interrupt import handled, raise_at_once
from orchestrator.outcome import Outcome
from orchestrator.study.paper.worker import Ended, Message, Progressed, Task, Work, simulate_task

DIED = "process-died"
"""Outcome of a run whose process ended without saying how the run ended."""
_ADVICE = "The process ended from outside or crashed, often for want of memory; try --jobs 1."
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_PATIENCE = 10.0  # s that a process gets to end by itself after its last word
_HASTE = 1.0  # s that it gets where its run is of no more use

Show = Callable[[str, Progressed | Ended], None]


@dataclass
class _Running:
    """A process under way and how far its run is."""

    task: Task
    process: SpawnProcess
    simulated: float = 0.0


def cores() -> int:
    """Number of cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def run_all(tasks: Sequence[Task], jobs: int, show: Show, *, work: Work = simulate_task) -> dict[str, Ended]:
    """Carry out tasks in parallel processes.

    Parameters
    ----------
    tasks : sequence of Task
        Started in this order.
    jobs : int
        Largest number at the same time.
    show : callable
        Told every message by the task's name.
    work : callable
        What a process does.

    Returns
    -------
    dict of Ended
        How each run ended, by the task's name in the order of the tasks; also runs whose process died
        (`DIED`), and after an interrupt, which lets the runs under way end between two steps.

    Raises
    ------
    OrchestratorError
        What a run says is wrong with the input; the other runs are ended.
    """
    context = multiprocessing.get_context("spawn")
    stop = context.Event()
    waiting, running = list(tasks), dict[Connection, _Running]()
    ended: dict[str, Ended] = {}

    asked: list[int] = []

    def end(task: Task, how: Ended) -> None:
        if asked[:1] == [signal.SIGTERM] and how.outcome == Outcome.INTERRUPTED.value:
            how = replace(how, outcome=Outcome.TERMINATED.value, advice=Outcome.TERMINATED.advice)
        ended[task.name] = how
        show(task.name, how)

    try:
        with _signal_sets(stop) as asked:
            while waiting or running:
                while waiting and len(running) < jobs and not stop.is_set():
                    connection, started = _start(context, waiting.pop(0), stop, work, jobs)
                    running[connection] = started
                if stop.is_set():
                    for task in waiting:
                        end(task, _not_started())
                    waiting = []
                for ready in wait(list(running), timeout=0.2):
                    assert isinstance(ready, Connection)
                    message = _receive(ready)
                    run = running[ready]
                    if isinstance(message, Progressed):
                        run.simulated = message.simulated
                        show(run.task.name, message)
                        continue
                    del running[ready]
                    ready.close()
                    run.process.join(_PATIENCE)
                    if isinstance(message, OrchestratorError):
                        raise message
                    end(run.task, message or _died(run))
    finally:
        stop.set()
        for run in running.values():
            run.process.join(_HASTE)
            run.process.kill()
            run.process.join(_PATIENCE)
    return {task.name: ended[task.name] for task in tasks}


def _start(
    context: SpawnContext, task: Task, stop: Event, work: Work, jobs: int
) -> tuple[Connection, _Running]:
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_carry_out, args=(work, task, sender, stop), name=task.name, daemon=True)
    with _threads(max(1, cores() // jobs)):
        process.start()
    sender.close()  # so that the end of the process is the end of the pipe
    return receiver, _Running(task, process)


def _carry_out(work: Work, task: Task, sender: Connection, stop: Event) -> None:
    """Work and leave at once: what FMUs do when their libraries are unloaded no longer matters then."""
    work(task, sender, stop)
    sender.close()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)


def _receive(connection: Connection) -> Message | None:
    """Next message, None at the end of the pipe."""
    try:
        message: Message = connection.recv()
    except (EOFError, OSError):
        return None
    return message


def _died(run: _Running) -> Ended:
    code = run.process.exitcode
    if code is not None and code < 0:
        how = f"the process of the run was ended by {signal.Signals(-code).name}"
    else:
        how = f"the process of the run ended with exit code {code}"
    return Ended(DIED, how, _ADVICE, run.simulated, 0.0)


def _not_started() -> Ended:
    return Ended(Outcome.INTERRUPTED.value, "not started", Outcome.INTERRUPTED.advice, 0.0, 0.0)


@contextmanager
def _threads(number: int) -> Iterator[None]:
    """Let a process that is started inside share the cores fairly, unless the user has said how."""
    given = [name for name in _THREADS if name not in os.environ]
    os.environ.update(dict.fromkeys(given, str(number)))
    try:
        yield
    finally:
        for name in given:
            del os.environ[name]


@contextmanager
def _signal_sets(stop: Event) -> Iterator[list[int]]:
    """Turn the first signal into the event, and yield the list that it enters; a second one is raised."""
    asked: list[int] = []

    def on_signal(number: int, frame: FrameType | None) -> None:
        if asked:
            raise_at_once(number, frame)
        asked.append(number)
        stop.set()

    with handled(on_signal):
        yield asked
