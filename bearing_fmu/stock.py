"""Work spaces that films of one resolution share."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from typing import Any

_RESOLUTIONS = 8
_SPACES = 16


class WorkSpace:
    """Arrays that one evaluation at a time may use."""

    def __init__(self, arrays: dict[str, Any] | None = None) -> None:
        self.arrays = arrays or {}


class Stock:
    """Work spaces that nobody uses, of the last few resolutions; the one used last is taken first.

    Nothing in a work space outlives an evaluation.  So it stays in the processor's nearest memory,
    whatever the number of bearings.

    Parameters
    ----------
    make : callable
        Arrays of a new work space of columns x rows.
    """

    def __init__(self, make: Callable[[int, int], dict[str, Any]]) -> None:
        self._make = make
        self._free: OrderedDict[tuple[int, int], list[WorkSpace]] = OrderedDict()

    def of(self, columns: int, rows: int) -> list[WorkSpace]:
        """The free work spaces of a resolution.

        Take one by ``pop`` and bring it back by `bring_back`; no other thread interrupts either.
        """
        free = self._free.setdefault((columns, rows), [])
        self._free.move_to_end((columns, rows))
        while len(self._free) > _RESOLUTIONS:
            self._free.popitem(last=False)  # films that hold it go on sharing it
        return free

    def new(self, columns: int, rows: int) -> WorkSpace:
        """A work space in addition to those in stock."""
        return WorkSpace(self._make(columns, rows))


def bring_back(free: list[WorkSpace], space: WorkSpace) -> None:
    """Let others use a work space; more than a few are given up."""
    if len(free) < _SPACES:
        free.append(space)
