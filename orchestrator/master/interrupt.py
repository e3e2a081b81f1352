"""Ctrl-C and SIGTERM between macro steps: a unit must not be interrupted inside a call, or it is lost."""

from __future__ import annotations

import signal
import threading
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


@contextmanager
def handled(handler: Callable[[int, FrameType | None], None]) -> Iterator[None]:
    """Let `handler` take the signals that end a run; elsewhere than on the main thread none arrive."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.signal(number, handler) for number in SIGNALS}
    try:
        yield
    finally:
        for number, earlier in before.items():
            signal.signal(number, earlier)


def raise_at_once(number: int, _frame: FrameType | None) -> None:
    """Handle a signal where no unit is at work: what is open is closed on the way out."""
    raise SIGNALS[number]


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
    due: list[int] = []

    def on_signal(number: int, _frame: FrameType | None) -> None:
        if due:
            raise SIGNALS[number]
        due.append(number)

    def report(*how_far: _Report.args, **more: _Report.kwargs) -> None:
        progress(*how_far, **more)
        if due:
            raise SIGNALS[due[0]]

    with handled(on_signal):
        yield report
