"""The bearing as an FMU: values in, film, values out.  The one module here that knows FMI."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from importlib import import_module
from typing import Any, Self

import numpy as np

from bearing_fmu import depths
from fmus import port
from fmus.unit.failure import UnitError
from fmus.unit.layout import Layout
from fmus.unit.slave import UnitSlave


class FilmState:
    """State of a film with memory, see `fmus.unit.state.ModelState`."""

    def __init__(self, numbers: np.ndarray) -> None:
        self.numbers = numbers

    def to_bytes(self) -> bytes:
        """Return the numbers without loss."""
        return self.numbers.tobytes()

    @classmethod
    def from_bytes(cls, data: bytes, /) -> Self:
        """Read what `to_bytes` wrote; ValueError if it is no whole number of them."""
        return cls(np.frombuffer(data))


@lru_cache(maxsize=16)
def _depth_and_layout(name: str) -> tuple[depths.Depth, Layout]:
    depth = depths.find(name)
    return depth, Layout(depth.variables)


class BearingSlave(UnitSlave):
    """A journal bearing of one depth.

    Parameters
    ----------
    depth : str
        Name of the depth.
    film : str
        Where its film is, see `bearing_fmu.depths.Depth.film`; loading that makes the depth known.
    starts : mapping, optional
        Start values in place of the depth's.
    **kwargs
        What pythonfmu passes.
    """

    model_type = FilmState

    def __init__(
        self, depth: str, film: str, starts: Mapping[str, float] | None = None, **kwargs: Any
    ) -> None:
        import_module(film.partition(":")[0])
        self._depth, layout = _depth_and_layout(depth)
        super().__init__(layout, **kwargs)
        for name, value in (starts or {}).items():
            if layout[name] in self.strings:
                self.strings[layout[name]] = str(value)
            else:
                self.values[layout[name]] = value
        self._outputs = self.values[layout.outputs]
        self._parameters = layout.block(self._depth.parameters[0].name, self._depth.parameters[-1].name)

    def prepare(self) -> None:
        """Make the film of the parameters."""
        numbers = self.values[self._parameters].tolist()
        values = dict(zip((v.name for v in self._depth.parameters), numbers, strict=True))
        values |= {self.layout.variables[i].name: text for i, text in self.strings.items()}
        self._film = self._depth.make(values)
        self._state = self._film.rest()

    def start(self) -> None:
        """Evaluate the film at the inputs, in balance with them."""
        self._state = self._film.rest()
        self.advance(self.start_time, 0.0)

    def advance(self, time: float, step: float) -> None:
        """Evaluate the film at the inputs, which are those at the end of the step."""
        try:  # outputs and state together are taken on, or nothing
            outputs, state = self._film.evaluate(self._state, self.inputs, step)
        except ArithmeticError as error:
            raise UnitError(f"film failed: {error}", port.Failure.FILM) from None
        self._outputs[: len(outputs)] = outputs  # the details behind them only some films tell
        self._state = state

    def model_state(self) -> FilmState | None:
        """Return the state of the film; None where there is nothing to remember."""
        return FilmState(self._state) if self._state.size else None

    def restore_model(self, state: FilmState) -> None:
        """Take back the state of the film."""
        self._state = state.numbers
