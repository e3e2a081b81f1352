"""The bearing as an FMU: values in, film, values out.  The one module here that knows FMI."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bearing_fmu.film import Depth, make_film
from bearing_fmu.parameters import BearingParameters
from fmus import port
from fmus.unit.failure import FILM_FAILED, UnitError
from fmus.unit.layout import Layout
from fmus.unit.slave import UnitSlave

LAYOUT = Layout(port.BEARING)
_PARAMETERS = LAYOUT.block("diameter", "contact.friction")
_OFFSET = LAYOUT.block("offset.x", "offset.tilt_y")
_RESOLUTION = LAYOUT.block("film.columns", "film.rows")


class BearingSlave(UnitSlave):
    """A journal bearing of one depth.

    The film has no memory, so that the values are the whole state.

    Parameters
    ----------
    depth : str
        Modelling depth, a value of `Depth`.
    starts : mapping, optional
        Start values in place of the port's.
    **kwargs
        What pythonfmu passes.
    """

    def __init__(self, depth: str, starts: Mapping[str, float] | None = None, **kwargs: Any) -> None:
        super().__init__(LAYOUT, **kwargs)
        for name, value in (starts or {}).items():
            self.values[LAYOUT[name]] = value
        self._depth = Depth(depth)
        self._offset = self.values[_OFFSET]
        self._outputs = self.values[LAYOUT.outputs]

    def prepare(self) -> None:
        """Make the film of the parameters."""
        columns, rows = (int(n) for n in self.values[_RESOLUTION])
        d, b, clearance, eta, ambient, sigma, modulus, friction = self.values[_PARAMETERS].tolist()
        parameters = BearingParameters(d, b, clearance, eta, ambient, sigma, modulus, friction, columns, rows)
        self._film = make_film(self._depth, parameters)

    def start(self) -> None:
        """Evaluate the film at the inputs."""
        status = self._film.evaluate(self.inputs, self._offset, self._outputs)
        if status:
            raise UnitError(f"{FILM_FAILED}: {self._film.failure(status, self.inputs, self._offset)}")

    def advance(self, time: float, step: float) -> None:
        """Evaluate the film at the inputs, which are those at the end of the step."""
        self.start()
