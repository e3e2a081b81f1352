"""What a facade fills in: its physics between the values of a unit."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from fmus.unit.state import ModelState


class Hooks(ABC):
    """The calls that a facade answers; what they raise becomes a refusal, see `fmus.unit.failure`.

    Attributes
    ----------
    values : ndarray of float64, shape (variables,)
        All values but strings, by value reference.  Facades hold views on it.
    inputs : ndarray of float64
        The view on the inputs.
    strings : dict
        Values of the String variables, by value reference.
    start_time : float
        Time at the start of the simulation [s].
    """

    values: NDArray[np.float64]
    inputs: NDArray[np.float64]
    strings: dict[int, str]
    start_time: float
    model_type: ClassVar[type[ModelState] | None] = None  # of the model's state, where it has one

    @abstractmethod
    def prepare(self) -> None:
        """Build the model from the parameters and write the calculated parameters."""

    @abstractmethod
    def start(self) -> None:
        """Write the outputs at the start time from inputs and parameters."""

    def starts_on(self) -> int:
        """Return how many inputs, from the first, the start depends on; others may be NaN until a step."""
        return len(self.inputs)

    @abstractmethod
    def advance(self, time: float, step: float) -> None:
        """Step from `time` by `step` and write the outputs; on error leave all as it was."""

    def observe(self, group: str) -> None:
        """Write the lazy variables of `group` for the present state; needed where there are some."""
        raise NotImplementedError(f"variables of {group}")

    def model_state(self) -> ModelState | None:
        """Return what the model holds beyond the values, of the type `model_type`."""
        return None

    def restore_model(self, state: Any) -> None:
        """Take back what `model_state` returned; `prepare` has run."""
        raise NotImplementedError("a state of the model")
