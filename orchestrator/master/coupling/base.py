"""The contract of a coupling scheme."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from orchestrator.errors import OrchestratorError
from orchestrator.master.graph import Graph, Group
from orchestrator.master.rollback import Rollback
from orchestrator.master.system import System, Wiring


class Errors(NamedTuple):
    """Largest relative defects of a step: of all bearings, and of those for which its length answers."""

    largest: float
    answered: float


class Advance(NamedTuple):
    """A macro step that was carried out.

    Attributes
    ----------
    iterations : int
        Times that the units exchanged values in it.
    defect : ndarray
        At the end of the step, what the units' inputs lacked of the outputs that they are connected to.
        Of a train (bearings, 4): wrench of the bearings less the one that the rotor was moved by, the
        error estimate of the coupling. Overwritten by the next step.
    of_length : ndarray or None
        Error of the bearing wrenches that comes of the length of the step (bearings, 4), see
        `orchestrator.master.step_error`; the step control puts it in.
    evaluated : ndarray of bool or None
        The bearings that stand at the end of the step; the defect of others is 0. None: all.
    errors : Errors or None
        The defects against what is transmitted, where the scheme has another measure than `System.relative`.
    """

    iterations: int
    defect: NDArray[np.float64]
    of_length: NDArray[np.float64] | None = None
    evaluated: NDArray[np.bool_] | None = None
    errors: Errors | None = None


class NotConverged(OrchestratorError):
    """An iteration over a macro step that did not reach its tolerance; a smaller step may."""


class Coupled(Protocol):
    """What a scheme needs of a system of units; `System` is such, and any loop of the tests."""

    @property
    def graph(self) -> Graph:
        """Units and the values that travel between them."""

    @property
    def groups(self) -> Sequence[Group]:
        """Groups of mutually independent units, in the order of the flow through the system."""

    @property
    def rollback(self) -> Rollback:
        """The way back to the start of a step."""

    def defect(self) -> NDArray[np.float64]:
        """Return the defect of the interface at the newest values."""

    def relative(self, defect: NDArray[np.float64]) -> float:
        """Return the size of a defect against what is transmitted; not a number where it is none."""


class Coupling(Protocol):
    """A scheme that carries a system over macro steps.

    Its start values are the outputs that the system's groups fetched last, and it leaves those at
    the end of the step there.  What it keeps from step to step only speeds it up, and is in `memory`.

    Attributes
    ----------
    name : str
        In scenarios.
    wiring : Wiring
        What the bearings must give the rotor.
    iterates : bool
        Whether it repeats a step until the defect meets its tolerance; then it sets the mark itself.
    many_rates : bool
        Whether bearings may stay behind where the step does not end on a common instant; it then goes on
        without taking steps back, too.
    parts : int
        Equal parts in which the rotor goes each step under one law.
    """

    name: ClassVar[str]
    wiring: ClassVar[Wiring]
    iterates: ClassVar[bool]
    many_rates: ClassVar[bool]
    parts: ClassVar[int]

    @property
    def memory(self) -> dict[str, NDArray[Any]]:
        """What it keeps from step to step, as arrays by name; setting it continues where it was got."""

    @memory.setter
    def memory(self, arrays: dict[str, NDArray[Any]]) -> None: ...

    def advance(self, system: System, time: float, step: float, common: bool = True) -> Advance:
        """Carry the system from `time` to `time + step`, and where that is a `common` instant all units.

        Raises
        ------
        UnitError
            When a unit does not accept the step.
        NotConverged
            When iterations do not reach the tolerance.
        """

    def refuse(self) -> int:
        """Forget the last step, which is taken back, and return by how many halvings to repeat it."""

    def begin_anew(self) -> None:
        """Take note that something happens now: what was learned before does not hold behind it."""


class Memoryless:
    """A scheme that takes each step once and keeps nothing."""

    iterates: ClassVar[bool] = False
    many_rates: ClassVar[bool] = False
    parts: ClassVar[int] = 1

    def refuse(self) -> int:
        """One halving will do."""
        return 1

    def begin_anew(self) -> None:
        """Nothing."""

    @property
    def memory(self) -> dict[str, NDArray[Any]]:
        """Nothing."""
        return {}

    @memory.setter
    def memory(self, arrays: dict[str, NDArray[Any]]) -> None:
        pass


class Sequential(Memoryless):
    """One group after the other, each on the newest values."""

    def advance(self, system: Coupled, time: float, step: float, common: bool = True) -> Advance:
        """Feed, step and read group by group."""
        for group in system.groups:
            group.feed()
            group.step(time, step)
            group.fetch()
        return Advance(1, system.defect())
