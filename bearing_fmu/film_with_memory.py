"""A film that remembers from step to step: what its evaluations share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.film import Film
from bearing_fmu.outputs import OUTPUTS

Floats = NDArray[np.float64]


class FilmWithMemory(Film, ABC):
    """Prepared evaluator of one bearing whose film has a state, see `bearing_fmu.depths.Film`.

    The state is empty before the first evaluation, which is in balance with its inputs.
    """

    told: ClassVar[int] = 0
    """How many of `fmus.port.BEARING_DETAILS` it tells behind the outputs."""

    def evaluate(self, state: Floats, inputs: Floats, dt: float) -> tuple[Floats, Floats]:
        """Evaluate the port at the end of a step, see `bearing_fmu.depths.Film.evaluate`."""
        out = np.zeros(OUTPUTS + self.told)
        status, now = self._advance(state, inputs, self.offset, dt, out)
        if status:
            raise self.failure(status, inputs, self.offset)
        return out, now

    def solve(self, inputs: Floats, offset: Floats, out: Floats) -> int:
        """Evaluate the port in balance with the inputs, see `Film.solve`."""
        return self._advance(self.rest(), inputs, offset, 0.0, out)[0]

    @abstractmethod
    def _advance(
        self, state: Floats, inputs: Floats, offset: Floats, dt: float, out: Floats
    ) -> tuple[int, Floats]:
        """A code of `FilmStatus`, and what is remembered after the step."""
