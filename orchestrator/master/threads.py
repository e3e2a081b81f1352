"""Steps of independent units side by side on threads, with the results and errors of one after the other."""

from __future__ import annotations

from collections.abc import Sequence
from queue import SimpleQueue
from threading import Thread

from orchestrator.fmi.unit import Unit

_Share = Sequence[tuple[int, Unit]]
_Errors = dict[int, Exception]


class StepThreads:
    """Steps units on threads; all of them, whatever becomes of one.

    A unit does not see on which thread it steps, so that the values are those of one thread, to the bit.

    Parameters
    ----------
    units : sequence of Unit
        Instantiated with ``release_gil`` for more than one thread.
    threads : int
        The caller's among them.
    """

    def __init__(self, units: Sequence[Unit], threads: int = 1) -> None:
        count = max(1, min(threads, len(units)))
        first, *others = (tuple(enumerate(units))[k::count] for k in range(count))
        self._own = first
        self._workers = [_Worker(share) for share in others]

    def step(self, time: float, step: float) -> None:
        """Carry out a macro step in every unit.

        Raises
        ------
        UnitError
            From the first unit, in their order, that does not accept the step.
        """
        for worker in self._workers:
            worker.orders.put((time, step))
        errors = _step_all(self._own, time, step)
        for worker in self._workers:
            errors |= worker.done.get()
        if errors:
            raise errors[min(errors)]

    def close(self) -> None:
        """End the threads."""
        for worker in self._workers:
            worker.orders.put(None)
            worker.thread.join()
        self._workers = []


class _Worker:
    """A thread that waits for orders; a macro step is too short for the futures of an executor."""

    def __init__(self, share: _Share) -> None:
        self.orders: SimpleQueue[tuple[float, float] | None] = SimpleQueue()
        self.done: SimpleQueue[_Errors] = SimpleQueue()
        self.thread = Thread(target=self._work, args=(share,), name="bladeloss", daemon=True)
        self.thread.start()

    def _work(self, share: _Share) -> None:
        while (order := self.orders.get()) is not None:
            self.done.put(_step_all(share, *order))


def _step_all(share: _Share, time: float, step: float) -> _Errors:
    errors: _Errors = {}
    for index, unit in share:
        try:
            unit.do_step(time, step)
        except Exception as error:  # a surprise, too, must reach the caller, who waits for this thread
            errors[index] = error
    return errors
