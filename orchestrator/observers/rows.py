"""Named arrays that get a row each time something is kept, and forget rows that are written elsewhere."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray

_ROOM = 256


class Rows:
    """Arrays whose first axis grows.

    Parameters
    ----------
    shapes : mapping
        Shape of a row by name; of float numbers, or of those of a type behind it.

    Attributes
    ----------
    held, forgotten : int
        Rows that are here, and rows before them that are not any more.
    """

    def __init__(self, shapes: Mapping[str, tuple[tuple[int, ...], Any]]) -> None:
        self.held = self.forgotten = 0
        self._arrays = {name: np.empty((_ROOM, *shape), dtype=kind) for name, (shape, kind) in shapes.items()}
        self._bytes_of_row = sum(array[0].nbytes for array in self._arrays.values())

    def __getitem__(self, name: str) -> NDArray[Any]:
        """The rows of an array that are here; a view."""
        return self._arrays[name][: self.held]

    def add(self, **values: Any) -> int:
        """Keep a row of every array; return its number among those that are here."""
        row = self.held
        if row == len(next(iter(self._arrays.values()))):
            self._grow()
        for name, value in values.items():
            self._arrays[name][row] = value
        self.held = row + 1
        return row

    def forget(self, count: int) -> None:
        """Forget the first rows; copies keep them."""
        for name, old in self._arrays.items():
            self._arrays[name] = new = np.empty_like(old)
            new[: self.held - count] = old[count : self.held]
        self.held, self.forgotten = self.held - count, self.forgotten + count

    def copy(self) -> Rows:
        """The rows that are here now, whatever is kept or forgotten later; views."""
        whole = copy(self)
        whole._arrays = dict(self._arrays)
        return whole

    @property
    def nbytes(self) -> int:
        """Bytes of the rows that are here."""
        return self.held * self._bytes_of_row

    def arrays(self) -> dict[str, NDArray[Any]]:
        """All that it holds, by name; views."""
        return {name: self[name] for name in self._arrays} | {"forgotten": np.array(self.forgotten)}

    def restore(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what `arrays` returned."""
        held = len(arrays[next(iter(self._arrays))])
        while len(next(iter(self._arrays.values()))) < held:
            self._grow()
        for name, array in self._arrays.items():
            array[:held] = arrays[name]
        self.held, self.forgotten = held, int(arrays["forgotten"])

    def _grow(self) -> None:
        for name, old in self._arrays.items():
            new = np.empty((2 * len(old), *old.shape[1:]), dtype=old.dtype)
            new[: len(old)] = old
            self._arrays[name] = new
