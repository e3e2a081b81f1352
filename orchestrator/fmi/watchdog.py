"""Ends a run whose unit does not come back from a call, with what was recorded until then.

The thread that waits for such a unit can do nothing more, so the watchdog is another: a few times a
second it looks in which call every unit is (`Unit.call`), and counts how long that stays the same.
"""

from __future__ import annotations

import faulthandler
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterable
from contextlib import suppress
from os import _exit
from typing import Generic, NoReturn, TypeVar

from orchestrator.fmi.file import Call, Instance

Result = TypeVar("Result")

BUDGET = 60.0
"""Wall time in s that a call to a unit may take, unless the user says otherwise."""

PATIENCE = 10.0
"""Times the budget before the time loop: there a first call may compile a film or reduce a shaft."""

_PERIOD = 0.25  # s
_WRITING = 600.0  # s, at most, to write what there is
_SWIFT = 1e-4  # s, after which a unit that loops in Python gives way to the writing


class Watchdog(Generic[Result]):
    """Watches the calls to units; a context, within which it is awake.

    Parameters
    ----------
    budget : float
        Wall time in s that a call may take in the time loop; 0 for no watch.
    give_up : callable, optional
        Gets the result of a run whose unit hangs, on a thread of its own. It should not return.

    Attributes
    ----------
    patience : float
        Times the budget, for the present.
    partial : callable
        Makes the result of the run as it stands from a message.
    units : callable
        Returns the units to watch, for they come one by one.
    remove : callable
        Removes what must not stay when the process ends.
    """

    def __init__(self, budget: float = 0.0, give_up: Callable[[Result], None] | None = None) -> None:
        self.budget = budget
        self.patience = PATIENCE
        self.partial: Callable[[str], Result] | None = None
        self.units: Callable[[], Iterable[Instance]] = tuple
        self.remove: Callable[[], None] = lambda: None
        self.time = 0.0
        self.tripped = False
        self._give_up = give_up
        self._awake = threading.Event()
        self._thread: threading.Thread | None = None

    def beat(self, time: float) -> None:
        """Note the simulated time; a thread that comes back after all goes no further."""
        self.time = time
        if self.tripped:
            threading.Event().wait()

    def __enter__(self) -> Watchdog:
        if self.budget > 0.0 and self._give_up is not None:
            self._thread = threading.Thread(target=self._watch, name="watchdog", daemon=True)
            self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._awake.set()
        if self._thread is not None:
            self._thread.join()

    def _watch(self) -> None:
        period = min(_PERIOD, self.budget / 4.0)
        calls: dict[int, tuple[Call, float]] = {}
        before = time.monotonic()
        while not self._awake.wait(period):
            _arm_last_resort(2.0 * self.budget * self.patience + 1.0)
            now = time.monotonic()
            # A suspended process has not waited for its unit.
            elapsed, before = min(now - before, 2.0 * period), now
            units = {id(unit): unit for unit in self.units()}
            calls = {
                key: (call, known[1] + elapsed if known is not None and known[0] is call else 0.0)
                for key, unit in units.items()
                for call, known in ((unit.call, calls.get(key)),)
                if call is not None
            }
            for key, (call, spent) in calls.items():
                if spent >= self.budget * self.patience:
                    self._trip(units[key].name, call, spent)
                    return
        with suppress(RuntimeError):
            faulthandler.cancel_dump_traceback_later()

    def _trip(self, name: str, call: Call, spent: float) -> None:
        self.tripped = True
        _arm_last_resort(_WRITING)
        sys.setswitchinterval(_SWIFT)
        message = f"at t = {self.time:.9g} s: {name}: {call[0]} has not come back for {spent:.3g} s"
        self.remove()
        if self.partial is not None and self._give_up is not None:
            self._give_up(self.partial(message))


def _arm_last_resort(limit: float) -> None:
    """Let the C runtime end the process where a unit hangs with Python's lock in its hands."""
    if sys.__stderr__ is not None:
        with suppress(ValueError, OSError, RuntimeError):  # without a file behind it
            faulthandler.dump_traceback_later(limit, exit=True, file=sys.__stderr__)


def leave(conclude: Callable[[], int], *after: Callable[[], object]) -> NoReturn:
    """Conclude a run, do what is left, and end the process with its status, whatever other threads are in."""
    status = 1
    try:
        status = conclude()
    except BaseException:  # nobody is left to see it
        traceback.print_exc()
    finally:
        for act in after:
            with suppress(Exception):
                act()
        with suppress(Exception):
            sys.stdout.flush()
            sys.stderr.flush()
        _exit(status)
