"""The values of a unit: one flat block of numbers by value reference, and the strings."""

from __future__ import annotations

import math
from array import array
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fmus.port.failure import Failure
from fmus.unit.failure import UnitError
from fmus.unit.layout import Layout

_NAMED = 8  # of the bad inputs in a message


class Values:
    """Start values of `layout` at first; numbers are shared with numpy, without a copy.

    Integer and Boolean values are numbers, too.  FMI hands over lists of value
    references; neighbours, the usual case, are read and written as one block.

    Attributes
    ----------
    numbers : ndarray of float64, shape (variables,)
        The numbers; 0 in the place of strings.
    strings : dict
        The String values by value reference.
    """

    def __init__(self, layout: Layout) -> None:
        self._array = array("d", layout.starts)
        self._layout = layout
        self.numbers: NDArray[np.float64] = np.frombuffer(self._array)
        self._bytes = self.numbers.view(np.uint8)
        self.strings = dict(layout.strings)

    def block(self, vrs: list[int]) -> slice | None:
        """Return where `vrs` lie if they are neighbours in ascending order, else None."""
        block = slice(vrs[0], vrs[0] + len(vrs)) if vrs else slice(0, 0)
        return block if self._layout.references[block] == vrs else None

    def read(self, vrs: list[int], block: slice | None) -> list[float]:
        """Return the numbers at `vrs`, lying in `block`; IndexError if there is no such reference."""
        if block is not None:
            return self._array[block].tolist()
        return [self._array[i] for i in vrs]

    def write(self, vrs: list[int], numbers: Sequence[float], block: slice | None) -> None:
        """Set the numbers at `vrs`, lying in `block`."""
        if block is not None:
            self._array[block] = array("d", numbers)
        else:
            for i, number in zip(vrs, numbers, strict=True):
                self._array[i] = number

    def put(self, reference: int, number: float) -> None:
        """Set one number, quicker than numpy does."""
        self._array[reference] = number

    def check_inputs(self, inputs: NDArray[np.float64]) -> None:
        """Refuse inputs, from the first on, if one is not finite.

        Raises
        ------
        UnitError
            With the names of the bad ones.
        """
        # one pass: a single NaN or infinity spoils the sum of squares
        if not math.isfinite(inputs.dot(inputs)):
            bad = [self._layout.variables[i].name for i, x in enumerate(inputs) if not math.isfinite(x)]
            more = f" and {len(bad) - _NAMED} more" if len(bad) > _NAMED else ""
            reason = f"input {', '.join(bad[:_NAMED])}{more} is not a finite number"
            raise UnitError(reason, Failure.INPUT)

    def parameters(self) -> tuple[bytes, ...]:
        """Return all parameters, to the bit."""
        strings = (text.encode() for text in self.strings.values())
        return self.numbers[self._layout.parameters].tobytes(), *strings

    def pack(self) -> bytes:
        """Return all numbers as bytes."""
        return self._array.tobytes()

    def unpack(self, numbers: bytes) -> None:
        """Take all numbers from bytes."""
        self._bytes[:] = np.frombuffer(numbers, np.uint8)
