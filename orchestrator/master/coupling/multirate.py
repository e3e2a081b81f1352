"""Multirate: each bearing is evaluated on intervals of its own; in between the rotor goes on with its law.

A bearing whose wrench bends little need not be evaluated at every step of the rotor: its affine law
``F0 - K q - C v``, expanded where it stood last and bent on as it did before (`bent_law`), serves until it is
evaluated again, at the end of an interval of its own.  What the law has missed by then is the defect, against
the largest force of late: a force that turns with the rotor is as large once in a revolution.
The rotor's steps are chosen by the bearings that are evaluated at each of them, the busy ones.  The interval
of a bearing doubles where its defect is calm and halves where it is above `OWN` of the tolerance.  It is
evaluated early when motion and velocity have changed its wrench so much that the defect, which goes with the
square of that change, is to be expected above; so nothing need be taken back for it.

A unit takes one ``doStep`` from where it stands to where it is evaluated, so that communication points are in
order and no unit steps twice over a time.  At common instants, some in a revolution and where something
happens, all bearings are evaluated.  Records may fall in between (`orchestrator.observers.between`).
Behind an event nothing is known of the intervals: all begin with a step again, and double at most.

Tried and left out: the mean of what the last interval missed, added to F0 in the next one (third order).
Through contact of the turbine train it costs accuracy at equal evaluations, even where it is confined to
defects below a tenth of the change of the wrench.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from orchestrator.master.coupling.base import Advance
from orchestrator.master.coupling.bent_law import FINEST, bent_laws
from orchestrator.master.system import System, Wiring

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

OWN = 0.3
"""Share of the tolerance that the defect over an interval of several steps may reach: of equal defects that
of the longer interval does more harm."""

CALM = 0.2
"""Share of that within which the defect, of second order, allows twice the interval."""

STIFFENS = 0.5
"""Bend that is expected at least, that of a force as the inverse of a gap, of what bends at all."""

LINEAR = 1e-3
"""Bend of what does not bend."""

FADES = 0.5
"""Share of the bend of the interval before that is expected still: a calm interval tells little of it."""

LATE = 2.0
"""Revolutions in which the size that defects are measured by falls to 1/e of what it was."""

LIGHT = 0.3
"""Share of the mean static load that is the least size."""

_WHOLE = 1.0 - 1e-6
"""Share of an interval that counts as the whole."""

_NOTHING = 1e-12
"""Relative change of a wrench that is none."""


class Rates(NamedTuple):
    """Where the bearings stand and how long they may go on, (bearings,) each.

    Attributes
    ----------
    stands : ndarray
        Where they were evaluated last, in s.
    interval : ndarray
        After which they are due, in s.
    bend : ndarray
        Relative defect of the last interval over the square of what moved the wrench in it, see
        `System.moved`; at least `FADES` of that before.
    size : ndarray
        Largest force of late, in N.
    span : ndarray
        How long the last interval was, in s; 0 before there was one.
    tangents : ndarray (bearings, 32)
        K and C at its start, by rows.
    """

    stands: Array
    interval: Array
    bend: Array
    size: Array
    span: Array
    tangents: Array

    @classmethod
    def anew(cls, time: float, step: float, size: Array) -> Rates:
        """Bearings that stand at an instant of which nothing is known."""
        n = len(size)
        nothing = np.zeros(n)
        return cls(np.full(n, time), np.full(n, step), nothing, size, nothing, np.zeros((n, 32)))

    def due(self, end: float, moved: Array, tolerance: float) -> Mask:
        """Which bearings are to be evaluated at `end`, their wrenches changed by `moved` (relative)."""
        bend = np.where(self.bend > LINEAR, np.maximum(self.bend, STIFFENS), self.bend)
        return (end - self.stands >= _WHOLE * self.interval) | (bend * moved**2 > tolerance)

    def after(self, end: float, due: Mask, moved: Array, sizes: Array, tolerance: float) -> Rates:
        """What follows on relative defects of these sizes at `end` of the bearings that were `due`."""
        spans = end - self.stands
        whole = spans >= _WHOLE * self.interval
        interval = np.where(due & whole & (sizes <= CALM * tolerance), 2.0 * spans, self.interval)
        interval = np.where(due & (sizes > tolerance), np.minimum(interval, 0.5 * spans), interval)
        found = np.maximum(sizes / np.maximum(moved, _NOTHING) ** 2, FADES * self.bend)
        bend = np.where(due, found, self.bend)
        stands, span = np.where(due, end, self.stands), np.where(due, spans, self.span)
        return self._replace(stands=stands, interval=interval, bend=bend, span=span)


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

    _rates: Rates | None = field(default=None, init=False)
    _next: Rates | None = field(default=None, init=False)
    _rough: Mask | None = field(default=None, init=False)
    """Bearings whose defect was above the tolerance in a step that was taken back."""

    @property
    def memory(self) -> dict[str, NDArray[Any]]:
        """Where the bearings stand, and their intervals."""
        rates = self._next or self._rates
        return {} if rates is None else rates._asdict()

    @memory.setter
    def memory(self, arrays: dict[str, NDArray[Any]]) -> None:
        self._rates, self._next, self._rough = (Rates(**arrays) if arrays else None), None, None

    def refuse(self) -> None:
        """Go back to the intervals before the step; what was above the tolerance is due in its repetition."""
        self._next = None

    def begin_anew(self) -> None:
        """Forget the intervals, for something happens: each begins with a step and is evaluated behind it."""
        rates = self._next or self._rates
        if rates is not None:
            nothing = np.zeros_like(rates.span)
            self._rates, self._next, self._rough = rates._replace(interval=nothing, span=nothing), None, None

    def advance(self, system: System, time: float, step: float, common: bool = True) -> Advance:
        """Carry the rotor over the step, and the bearings that are due to its end."""
        rates, end = self._at(system, time, step), time + step
        fresh = rates.stands == time
        tangents = system.squares.reshape(-1, 32)
        system.give_laws(self._laws(system, rates, tangents, np.flatnonzero(fresh), step))
        system.rotor_group.step(time, step)
        system.rotor_group.fetch()
        moved = system.magnitudes(system.moved()) / rates.size
        again = np.zeros(len(moved), dtype=bool) if self._rough is None else self._rough
        due = np.ones_like(again) if common else again | rates.due(end, moved, OWN * self.tolerance)
        spans = np.where(fresh, step, end - rates.stands)  # an even step to the bit
        kept = np.where(due[:, None], tangents, rates.tangents)
        chosen = np.flatnonzero(due).tolist()
        system.bearing_group.feed_some(chosen)
        system.bearing_group.step_some(chosen, rates.stands.tolist(), spans.tolist())
        system.bearing_group.fetch(chosen)
        defect = system.defect()
        defect[~due] = 0.0
        size = self._size(system, rates.size, step)
        sizes = system.magnitudes(defect) / size
        # A shorter step helps those that stand at its start, and others once, to be evaluated in time.
        answers = fresh | ~(sizes <= self.tolerance) & ~again | np.isnan(sizes)
        self._rough = sizes > self.tolerance
        after = rates.after(end, due, moved, sizes, OWN * self.tolerance)
        self._next = after._replace(size=size, tangents=kept)
        return Advance(1, defect, None, due, sizes, answers)

    def _laws(
        self, system: System, rates: Rates, tangents: Array, fresh: NDArray[np.intp], step: float
    ) -> Array:
        """The laws of a step: those that the rotor has, new ones of bearings that stand at its start."""
        laws, span = system.laws.copy(), rates.span[fresh]
        ratio = np.maximum(rates.interval[fresh], step) / np.where(span > 0.0, span, np.inf)
        ratio *= self.tolerance >= FINEST
        of_all = system.forces, tangents, rates.tangents, system.stands_at()
        wrench, tangent, before, where = (each[fresh] for each in of_all)
        laws[fresh] = bent_laws(wrench, tangent, before, ratio, where)
        return laws

    @staticmethod
    def _size(system: System, before: Array, step: float) -> Array:
        """The largest forces of late, in N, a step later."""
        kept = np.exp(-abs(system.speed) * step / (2.0 * np.pi * LATE))
        forces = np.hypot(system.forces[:, 0], system.forces[:, 1])
        return np.maximum(np.maximum(forces, kept * before), LIGHT * system.loads)

    def _at(self, system: System, time: float, step: float) -> Rates:
        """Return how the bearings stand at the start of a step; one before that was not refused counts."""
        if self._next is not None:
            self._rates, self._next, self._rough = self._next, None, None
        if self._rates is None or (self._rates.stands > time + 1e-6 * step).any():  # of another system
            self._rates = Rates.anew(time, step, self._size(system, np.zeros(len(system.bearings)), 0.0))
            system.rotor_group.feed()
        here = np.abs(self._rates.stands - time) <= 1e-6 * step  # but for rounding
        self._rates = self._rates._replace(stands=np.where(here, time, self._rates.stands))
        return self._rates
