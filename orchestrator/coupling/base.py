"""The contract of a coupling scheme."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from orchestrator.graph import Group
from orchestrator.system import Wiring


class Advance(NamedTuple):
    """A macro step that was carried out.

    Attributes
    ----------
    iterations : int
        Times that the units exchanged values in it.
    defect : ndarray (bearings, 4)
        Wrench of the bearings less the one that the rotor was moved by, at the end of the step: the
        error estimate of the coupling. Overwritten by the next step.
    """

    iterations: int
    defect: NDArray[np.float64]


class Coupled(Protocol):
    """What a scheme needs of a system; `orchestrator.system.System` is one."""

    @property
    def groups(self) -> Sequence[Group]:
        """Groups of mutually independent units, in the order of the flow through the system."""

    def defect(self) -> NDArray[np.float64]:
        """Return the defect of the interface at the newest values."""


class Coupling(Protocol):
    """A scheme that carries a system over macro steps.

    A scheme holds no values of the system: its start values are the outputs that the
    system's groups fetched last, and it leaves those at the end of the step there.
    """

    @property
    def name(self) -> str:
        """Name in scenarios."""

    @property
    def wiring(self) -> Wiring:
        """What the bearings must give the rotor."""

    def advance(self, system: Coupled, time: float, step: float) -> Advance:
        """Carry the system from `time` to `time + step`.

        Raises
        ------
        UnitError
            When a unit does not accept the step.
        """
