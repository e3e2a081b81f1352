"""Real variables that travel every macro step: bound once, one foreign call for all of them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from orchestrator.fmi.unit import Unit


class Block:
    """Real variables of one unit bound to a part of a numpy array.

    Attributes
    ----------
    get, set : callable
        Move all values from the unit into the array, or from the array into the unit.
    """

    def __init__(self, unit: Unit, names: Sequence[str], values: NDArray[np.float64]) -> None:
        if values.shape != (len(names),) or values.dtype != np.float64 or not values.flags.c_contiguous:
            raise ValueError(f"a block of {len(names)} values needs as many contiguous float64")
        references = np.array([unit.variable(name).valueReference for name in names], dtype=np.uint32)
        arguments = (
            unit.component,
            ctypes.c_void_p(references.ctypes.data),
            ctypes.c_size_t(len(names)),
            ctypes.c_void_p(values.ctypes.data),
        )
        self.get = unit.prepare("fmi2GetReal", arguments, (references, values))
        self.set = unit.prepare("fmi2SetReal", arguments, (references, values))
