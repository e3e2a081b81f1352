"""Ctrl-C and SIGTERM between macro steps: a unit must not be interrupted inside a call, or it is lost."""

from __future__ import annotations

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import ParamSpec

from orchestrator.errors import Terminated

_Report = ParamSpec("_Report")

SIGNALS: dict[int, type[KeyboardInterrupt]] = {
    signal.SIGINT: KeyboardInterrupt,
    signal.SIGTERM: Terminated,
}
"""The signals that end a run, and what they raise."""

if hasattr(signal, "SIGHUP"):  # the terminal is gone
    SIGNALS[signal.SIGHUP] = Terminated

TOGETHER = 0.05
"""Time in s within which signals count as one: terminal, shell and batch system may all send it."""


class _Last:
    """When the last signal came that counts."""

    time = -math.inf


def counts() -> bool:
    """Whether a signal that has just come is another one than the last."""
    now = time.monotonic()
    if now - _Last.time < TOGETHER:
        return False
    _Last.time = now
    return True


@contextmanager
def handled(handler: Callable[[int, FrameType | None], None]) -> Iterator[None]:
    """Let `handler` take the signals that end a run; elsewhere than on the main thread none arrive."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.signal(number, handler) for number in SIGNALS if not _ignored(number)}
    try:
        yield
    finally:
        for number, earlier in before.items():
            signal.signal(number, earlier)


def raise_at_once(number: int, _frame: FrameType | None) -> None:
    """Handle a signal where no unit is at work: what is open is closed on the way out."""
    if counts():
        raise SIGNALS[number]


def _ignored(number: int) -> bool:
    """Whether a process was started so that it outlives its terminal, as by nohup."""
    return number == getattr(signal, "SIGHUP", None) and signal.getsignal(number) is signal.SIG_IGN


class _Held:
    """A handler that keeps the first signal until `raise_due`; a second one is raised at once."""

    def __init__(self) -> None:
        self._due: int | None = None

    def __call__(self, number: int, _frame: FrameType | None) -> None:
        if not counts():
            return
        if self._due is not None:
            raise SIGNALS[number]
        self._due = number

    def raise_due(self) -> None:
        """Raise what has come, if anything has."""
        if self._due is not None:
            raise SIGNALS[self._due]


@contextmanager
def held_back() -> Iterator[None]:
    """Hold a signal back until the end of the block, and raise it then; a second one is not held back."""
    on_signal = _Held()
    with handled(on_signal):
        yield
    on_signal.raise_due()


@contextmanager
def interrupt_between_steps(progress: Callable[_Report, None]) -> Iterator[Callable[_Report, None]]:
    """Hold an interrupt or a request to terminate back until the time loop reports progress.

    FMUs run Python inside their calls; a `KeyboardInterrupt` raised there ends as a fatal error
    of the unit.  A second signal is not held back.

    Parameters
    ----------
    progress : callable
        Told how far the run is, at least after every macro step.

    Yields
    ------
    callable
        The same, which raises `KeyboardInterrupt` or `Terminated` when one is due.
    """
    on_signal = _Held()
    main = threading.current_thread() is threading.main_thread()

    def report(*how_far: _Report.args, **more: _Report.kwargs) -> None:
        progress(*how_far, **more)
        for number in SIGNALS if main else ():
            if signal.getsignal(number) is not on_signal and not _ignored(number):
                signal.signal(number, on_signal)  # a unit has put another in its place
        on_signal.raise_due()

    with handled(on_signal):
        yield report
