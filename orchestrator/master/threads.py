"""Steps of independent units side by side on threads, with the results and errors of one after the other."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from queue import SimpleQueue
from threading import Thread

from orchestrator.fmi.unit import Unit

_Orders = Sequence[tuple[int, Unit, float, float]]
"""Units with their numbers, and the start and length of the step of each."""

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
        self._units = tuple(enumerate(units))
        self._workers = [_Worker() for _ in range(1, min(threads, len(units)))]

    def step(self, time: float, step: float) -> None:
        """Carry out a macro step in every unit, as `step_each`."""
        self.step_each([(index, unit, time, step) for index, unit in self._units])

    def step_some(self, chosen: Iterable[int], times: Sequence[float], steps: Sequence[float]) -> None:
        """Carry out in each of the chosen units a macro step of its own, as `step_each`."""
        orders = zip(chosen, times, steps, strict=True)
        self.step_each([(*self._units[k], time, step) for k, time, step in orders])

    def step_each(self, orders: _Orders) -> None:
        """Carry out orders.

        Raises
        ------
        UnitError
            From the first unit, in their order, that does not accept the step.
        """
        if not self._workers:
            _raise_first(_step_all(orders))
            return
        count = max(1, min(1 + len(self._workers), len(orders)))
        busy = self._workers[: count - 1]
        for k, worker in enumerate(busy, 1):
            worker.orders.put(orders[k::count])
        errors = _step_all(orders[::count])
        for worker in busy:
            errors |= worker.done.get()
        _raise_first(errors)

    def close(self) -> None:
        """End the threads."""
        for worker in self._workers:
            worker.orders.put(None)
            worker.thread.join()
        self._workers = []


class _Worker:
    """A thread that waits for orders; a macro step is too short for the futures of an executor."""

    def __init__(self) -> None:
        self.orders: SimpleQueue[_Orders | None] = SimpleQueue()
        self.done: SimpleQueue[_Errors] = SimpleQueue()
        self.thread = Thread(target=self._work, name="bladeloss", daemon=True)
        self.thread.start()

    def _work(self) -> None:
        while (orders := self.orders.get()) is not None:
            self.done.put(_step_all(orders))


def _raise_first(errors: _Errors) -> None:
    if errors:
        raise errors[min(errors)]


def _step_all(orders: _Orders) -> _Errors:
    errors: _Errors = {}
    for index, unit, time, step in orders:
        try:
            unit.do_step(time, step)
        except Exception as error:  # a surprise, too, must reach the caller, who waits for this thread
            errors[index] = error
    return errors
