"""Ctrl-C between macro steps: a unit must not be interrupted inside a call, or it is lost."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from orchestrator.simulate import Stage


@contextmanager
def interrupt_between_steps(
    progress: Callable[[Stage, float], None],
) -> Iterator[Callable[[Stage, float], None]]:
    """Hold an interrupt back until the time loop reports progress.

    FMUs run Python inside their calls; a `KeyboardInterrupt` raised there ends as a fatal error
    of the unit.  A second interrupt is not held back.

    Parameters
    ----------
    progress : callable
        As `orchestrator.simulate.Progress`.

    Yields
    ------
    callable
        The same, which raises `KeyboardInterrupt` when one is due.
    """
    due = False

    def on_interrupt(_signal: int, _frame: FrameType | None) -> None:
        nonlocal due
        if due:
            raise KeyboardInterrupt
        due = True

    def report(stage: Stage, simulated: float) -> None:
        progress(stage, simulated)
        if due:
            raise KeyboardInterrupt

    if threading.current_thread() is not threading.main_thread():  # signals reach the main thread only
        yield progress
        return
    before = signal.signal(signal.SIGINT, on_interrupt)
    try:
        yield report
    finally:
        signal.signal(signal.SIGINT, before)
