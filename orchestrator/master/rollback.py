"""Taking a step back: the state of all units and the values between them, at the start of a step."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from contextlib import suppress

from fmus import port
from fmus.build.promises import BORE, BOUNDARY, FOLLOWED, LAYER, MEMORYLESS, TEMPERATURE, memoryless_with
from orchestrator.errors import FmuError
from orchestrator.fmi.unit import Unit, UnitError
from orchestrator.master.graph import Graph


class Rollback:
    """The last mark of a system and the way back to it.

    Calls are prepared once; a mark costs two foreign calls a unit.  Units without memory need no
    mark, since a step is always preceded by a feed.  Where others cannot keep their state, `take_back`
    refuses.

    Parameters
    ----------
    units : sequence of Unit
        All units of the graph.
    graph : Graph
        With the values that travel between them.
    """

    def __init__(self, units: Sequence[Unit], graph: Graph) -> None:
        self._graph = graph
        self._inputs, self._outputs = graph.inputs.copy(), graph.outputs.copy()
        self._fixed = [u for u in units if not (MEMORYLESS in u.file.promises or u.file.can_keep_state)]
        self._units = () if self._fixed else tuple(units)
        self._kept: tuple[_KeptState, ...] | None = None
        self._marked = False

    @property
    def possible(self) -> bool:
        """Whether every unit can go back to an earlier state."""
        return not self._fixed

    def require(self, purpose: str) -> None:
        """Refuse a system that cannot be taken back.

        Raises
        ------
        FmuError
            Naming the units that cannot keep their state.
        """
        if self._fixed:
            names = ", ".join(unit.name for unit in self._fixed)
            raise FmuError(
                f"{self._fixed[0].file.path}: {purpose} takes steps back, and {names} cannot keep its state "
                "(canGetAndSetFMUstate is false); couple with linear-implicit, gauss-seidel or jacobi at a "
                "fixed step"
            )

    def mark(self) -> None:
        """Remember the present state in place of the last mark."""
        if self._kept is None:  # by now the units know their parameters
            self._kept = tuple(_KeptState(unit) for unit in self._units if not forgets(unit))
        for state in self._kept:
            state.keep()
        self._inputs[:] = self._graph.inputs
        self._outputs[:] = self._graph.outputs
        self._marked = True

    def take_back(self) -> None:
        """Return units and values to the last mark, which stays valid."""
        self.rewind()
        self._graph.inputs[:] = self._inputs
        self._graph.outputs[:] = self._outputs

    def rewind(self) -> None:
        """Return the units to the last mark, and leave the values as they came out of the step."""
        self.require("a repeated step")
        if not self._marked:
            raise ValueError("a system is taken back to a mark, and none was set")
        for state in self._kept or ():
            state.go_back()

    def close(self) -> None:
        """Free the kept states."""
        for state in self._kept or ():
            state.free()


def forgets(unit: Unit) -> bool:
    """Whether a unit promises to be memoryless, with the parameters that it has."""
    if TEMPERATURE in unit.file.variables and unit.get_string(TEMPERATURE) == FOLLOWED:
        return False
    promises = unit.file.promises
    if MEMORYLESS in promises or not any(word.startswith(MEMORYLESS) for word in promises):
        return MEMORYLESS in promises
    if LAYER in unit.file.variables and unit.get_real([LAYER])[0] > 0.0:
        return False
    tilts = port.pads_in(unit.get_string(BORE)) > 0
    return not tilts and memoryless_with(unit.get_string(BOUNDARY)) in promises


class _KeptState:
    """One unit's state at the mark."""

    def __init__(self, unit: Unit) -> None:
        handle = self._handle = ctypes.c_void_p(None)
        where = ctypes.pointer(handle)
        self._get = unit.prepare("fmi2GetFMUstate", (unit.component, where), handle)
        self.go_back: Callable[[], None] = unit.prepare("fmi2SetFMUstate", (unit.component, handle), handle)
        self._free = unit.prepare("fmi2FreeFMUstate", (unit.component, where), handle)

    def keep(self) -> None:
        if self._handle.value is not None:
            self._free()
            self._handle.value = None
        self._get()

    def free(self) -> None:
        if self._handle.value is not None:
            with suppress(UnitError):
                self._free()
            self._handle.value = None
