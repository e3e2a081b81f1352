"""Multirate: each bearing is evaluated on intervals of its own; in between the rotor goes on with its law.

A bearing whose wrench bends little need not be evaluated at every step of the rotor: its affine law
``F0 - K q - C v``, expanded where it stood last and bent on as it did before (`rates`), serves until it is
evaluated again, at the end of an interval of its own.  What the law has missed by then is the defect, against
the largest force of late: a force that turns with the rotor is as large once in a revolution.
The rotor's steps are chosen by the bearings that are evaluated at each of them, the busy ones; it goes each
in `PARTS`.  The interval of a bearing doubles where its defect is calm and halves where it is above `OWN` of
the tolerance.  It is evaluated early when motion and velocity have changed its wrench so much that the
defect, which goes with the square of that change, is to be expected above, and at every step while it bears
next to nothing, for its tangent does not tell what may come; so little need be taken back for it.

A unit takes one ``doStep`` from where it stands to where it is evaluated, so that communication points are in
order and no unit steps twice over a time.  At common instants, some in a revolution and where something
happens, all bearings are evaluated.  Records may fall in between (`orchestrator.observers.between`).
Behind an event nothing is known of the intervals: all begin with a step again, and double at most.

Tried and left out: the mean of what the last interval missed, added to F0 in the next one (third order).
Through contact of the turbine train it costs accuracy at equal evaluations, even where it is confined to
defects below a tenth of the change of the wrench.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from orchestrator.master.coupling import rates as known
from orchestrator.master.coupling.base import Advance, Errors
from orchestrator.master.coupling.rate_step import find_due, settle
from orchestrator.master.coupling.rates import BEFORE, KNOWN, OWN, SIZE, SPAN, STANDS, WIDTH
from orchestrator.master.system import System, Wiring

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

FINEST = 7e-5
"""Tolerance below which laws are not bent: as the end of the pressure goes over the grid of a film its
tangent jumps a little, and at intervals short enough to follow that the order is not clear."""


PARTS = 3
"""Parts in which the rotor goes a step under laws that bend, for within each it lets wrenches run straight.

An odd number: of what is strongly damped such a step turns the sign of what is too much in its wrench (as the
trapezoidal rule does); an even number keeps it, and from law to law it adds up.
"""

SOON = 3
"""Halvings of a step in which a bearing that stood behind turned out to have been hit."""

LATE = 2.0
"""Revolutions in which the size that defects are measured by falls to 1/e of what it was."""


class _Room:
    """Memory for the arithmetic of a step of n bearings."""

    def __init__(self, n: int) -> None:
        self.changed, self.due, self.again, self.rough = (np.zeros(n, dtype=bool) for _ in range(4))
        self.moved, self.size, self.sizes = (np.zeros(n) for _ in range(3))
        self.defect, self.bent, self.felt = (np.zeros((n, 4)) for _ in range(3))
        self.tangents = np.zeros((n, 32))
        self.rates, self.next = np.zeros((n, WIDTH)), np.zeros((n, WIDTH))
        self.numbers, self.spans = np.zeros(n, dtype=np.intp), np.zeros((2, n))

    def orders(self, count: int) -> tuple[list[int], list[float], list[float]]:
        """Numbers of the bearings that are due, where they stand, and how far they go."""
        stands, spans = self.spans[:, :count].tolist()
        return self.numbers[:count].tolist(), stands, spans


@dataclass
class Multirate:
    """Rotor on the laws at hand, then the bearings that are due.

    Parameters
    ----------
    tolerance : float
        Largest defect against the largest force of late.
    """

    tolerance: float = 0.01

    name: ClassVar[str] = "multirate"
    wiring: ClassVar[Wiring] = Wiring.LAW
    iterates: ClassVar[bool] = False
    many_rates: ClassVar[bool] = True
    parts: ClassVar[int] = PARTS

    _room: _Room | None = field(default=None, init=False)
    _taken: bool = field(default=False, init=False)
    """Whether the last step was taken, so that what is next counts if it is not refused."""
    _known: bool = field(default=False, init=False)
    """Whether anything is known of the bearings."""
    _before: float = field(default=0.0, init=False)
    _reached: float = field(default=0.0, init=False)
    """Start of the last step, and the instant that no bearing stands behind."""

    @property
    def memory(self) -> dict[str, NDArray[Any]]:
        """Where the bearings stand, and their intervals."""
        if self._room is None or not self._known:
            return {}
        rates = self._room.next if self._taken else self._room.rates
        named = {name: rates[:, column].copy() for column, name in enumerate(KNOWN)}
        return named | {"tangents": rates[:, BEFORE:].copy()}

    @memory.setter
    def memory(self, arrays: dict[str, NDArray[Any]]) -> None:
        self._taken, self._known = False, bool(arrays)
        if arrays:
            self._room = room = _Room(len(arrays[KNOWN[0]]))
            columns = [arrays[name] for name in KNOWN]
            room.rates[:] = np.column_stack([*columns, arrays["tangents"]])
            self._reached = self._before = float(room.rates[:, STANDS].max())

    def refuse(self) -> int:
        """Go back to the intervals before the step; what was above the tolerance is due in its repetition.

        Where that is a surprise, at a bearing that stood behind, the repetition is `SOON` halvings shorter:
        what happens before its law is a new one the rotor does not feel.
        """
        room = self._room
        if room is None:
            return 1
        behind = room.rates[:, STANDS] < self._before
        surprised = bool((room.rough & behind & ~room.again).any())
        self._taken, room.again[:] = False, room.rough
        self._reached = self._before
        return SOON if surprised else 1

    def begin_anew(self) -> None:
        """Forget the intervals, for something happens: each begins with a step and is evaluated behind it."""
        room = self._room
        if room is not None and self._known:
            self._count(room)
            room.rates[:, known.INTERVAL] = room.rates[:, SPAN] = 0.0

    def advance(self, system: System, time: float, step: float, common: bool = True) -> Advance:
        """Carry the rotor over the step, and the bearings that are due to its end."""
        room, end = self._at(system, time, step), time + step
        rates, due, moved = room.rates, room.due, room.moved
        wrenches, tangents, where = system.forces, system.tangent_rows, system.stands_at()
        bends, told = self.tolerance >= FINEST, (wrenches, tangents, where)
        changed = system.laws, room.changed, room.numbers
        count = known.bend_on(time, step, bends, common, rates, room.again, *told, *changed)
        system.tell_laws(room.numbers[:count].tolist())
        system.carry_rotor(time, step, PARTS)
        motion, own = system.motion, OWN * self.tolerance
        standing = rates, *told, motion, system.loads, system.levers, room.again, system.laws
        seen = moved, due, room.tangents, room.bent, room.numbers, room.spans
        count = find_due(time, step, own, common, *standing, *seen)
        system.bearing_group.carry(*room.orders(count))
        largest, answered = settle(
            time,
            end,
            self.tolerance,
            own,
            math.exp(-abs(system.speed) * step / (2.0 * math.pi * LATE)),
            system.laws,
            motion,
            wrenches,
            system.loads,
            system.levers,
            room.tangents,
            rates,
            room.again,
            moved,
            due,
            room.bent,
            room.defect,
            room.felt,
            room.size,
            room.sizes,
            room.rough,
            room.next,
        )
        self._taken, self._before, self._reached = True, time, end
        return Advance(1, room.defect, None, due.copy(), Errors(largest, answered))

    def _at(self, system: System, time: float, step: float) -> _Room:
        """Return what is known at the start of a step; one before that was not refused counts."""
        room = self._room
        if room is not None and self._known:
            self._count(room)
            if self._reached <= time + 1e-6 * step:
                return room
        room = self._room = _Room(len(system.bearings))  # of another system, or the first step
        room.rates[:, STANDS], room.rates[:, known.INTERVAL] = time, step
        known.measure(system.forces, system.loads, 0.0, room.rates, room.size)
        room.rates[:, SIZE] = room.size
        self._known, self._taken, self._reached = True, False, time
        system.rotor_group.feed()
        return room

    def _count(self, room: _Room) -> None:
        """Let the last step count, if there is one that was not refused."""
        if self._taken:
            room.rates, room.next, self._taken = room.next, room.rates, False
            room.again[:] = room.rough[:] = False
