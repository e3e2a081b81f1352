"""Steps of independent units side by side on threads, with the results and errors of one after the other."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

from orchestrator.unit import Unit, UnitError


class Crew:
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
        self._shares = [tuple(enumerate(units))[first::count] for first in range(count)]
        self._pool = ThreadPoolExecutor(count - 1, "bladeloss") if count > 1 else None

    def step(self, time: float, step: float) -> None:
        """Carry out a macro step in every unit.

        Raises
        ------
        UnitError
            From the first unit, in their order, that does not accept the step.
        """
        if self._pool is None:
            errors = _step_all(self._shares[0], time, step)
        else:
            others = [self._pool.submit(_step_all, share, time, step) for share in self._shares[1:]]
            errors = _step_all(self._shares[0], time, step)
            for other in others:
                errors |= other.result()
        if errors:
            raise errors[min(errors)]

    def close(self) -> None:
        """End the threads."""
        if self._pool is not None:
            self._pool.shutdown()


def _step_all(share: Sequence[tuple[int, Unit]], time: float, step: float) -> dict[int, UnitError]:
    errors = {}
    for index, unit in share:
        try:
            unit.do_step(time, step)
        except UnitError as error:
            errors[index] = error
    return errors
