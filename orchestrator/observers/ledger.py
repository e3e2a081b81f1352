"""The energy ledger: what the films gave the shaft, what it received, and what the coupling made of it.

At each bearing the wrench of the film runs, within a step, linearly between its values at both ends;
the one that the rotor was moved by runs linearly between those of its law.  With the journal's
displacement d over the step of length H and its velocities v0, v1, ::

    work = (w0 + w1) d / 2 + (w1 - w0) (v1 - v0) H / 12

which is exact for a wrench linear and a motion cubic in time.  Where a journal is pressed into its shell
the rotor holds part of the wrench at its mean (`rotor_fmu.vibration.affine_step`), and the last term is
smaller by that share, which the rotor does not tell: received work and residue of such a bearing are
estimates, and the whole shaft's account below is exact.  Where a bearing is evaluated after several steps of
the rotor (`orchestrator.master.coupling.multirate`), its wrench is that of the law and a part of the defect
that grows linearly over them.  The film's work includes solid contact, shown
besides.  The residue is what the rotor received beyond what the films gave: energy that the
coupling created, or lost where it is negative.

Over the whole shaft the energy stored changes by what the bearings and the unbalance do less what
damping takes; the rotor keeps these accounts exactly.  The rotation does the work of the unbalance and gets
that of the drive; friction and windage brake it.  What friction takes the rotor counts by the power that it
was told at the start of each step, and this ledger besides by the powers at both ends.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmus import port
from orchestrator.fmi.block import Block
from orchestrator.master.coupling import Advance
from orchestrator.master.observer import Observer
from orchestrator.master.stepping import Stepper
from orchestrator.master.system import RESPONSE, System, law_wrenches

Array = NDArray[np.float64]

COLUMNS = ("film", "contact", "received", "exchanged")
"""Per bearing: work of film and contact together, its part of contact, the work that the rotor was moved
by, and the film's work with every step counted positive."""

_CONTACT = slice(RESPONSE["contact.Fx"], RESPONSE["contact.My"] + 1)


@dataclass(frozen=True)
class Rotation:
    """The energy of the rotation, in J.

    Attributes
    ----------
    stored : float
        Change of its kinetic energy.
    drive, windage : float
        Work of the drive, and what windage took.
    friction : ndarray (bearings,)
        What friction took at each bearing, by the powers at both ends of each step.
    """

    stored: float
    drive: float
    windage: float
    friction: Array

    def gap(self, unbalance: float) -> float:
        """Energy stored less what came and went, with what the unbalance took: 0 where all closes."""
        return self.stored - self.drive + self.windage + float(self.friction.sum()) + unbalance


@dataclass(frozen=True)
class Balance:
    """The ledger of a run, in J.

    Attributes
    ----------
    bearings : ndarray (bearings, 4)
        Columns as in `COLUMNS`.
    stored : float
        Change of the energy in the shaft: kinetic, strain, gravity.
    bearing_work, unbalance, damping : float
        Works on the shaft by the rotor's exact account; damping is what it lost.
    rotation : Rotation or None
        Of a rotor whose speed may change.
    """

    bearings: Array
    stored: float
    bearing_work: float
    unbalance: float
    damping: float
    rotation: Rotation | None = None

    @property
    def residue(self) -> Array:
        """What the rotor received at each bearing beyond the film's work (bearings,)."""
        return self.bearings[:, 2] - self.bearings[:, 0]

    @property
    def exchanged(self) -> float:
        """Work that went through all films, steps counted positive."""
        return float(self.bearings[:, 3].sum())

    @property
    def gap(self) -> float:
        """Energy stored less the works of films and unbalance and what damping took: 0 where all closes."""
        return self.stored - float(self.bearings[:, 0].sum()) - self.unbalance + self.damping

    @property
    def relative_gap(self) -> float:
        """`gap` against the work exchanged."""
        return self.gap / self.exchanged if self.exchanged > 0.0 else 0.0


class _Open:
    """Sums since each bearing was evaluated last: time, received work, way d, and the integral of t v."""

    def __init__(self, bearings: int) -> None:
        self.time, self.received = np.zeros(bearings), np.zeros(bearings)
        self.moved, self.moment = np.zeros((bearings, 4)), np.zeros((bearings, 4))

    def add(self, step: float, start: Array, end: Array, first: Array, last: Array) -> None:
        """Add a step between these journals, under wrenches of the law that run from first to last."""
        moved, turned = end[:, :4] - start[:, :4], end[:, 4:] - start[:, 4:]
        within = 0.5 * step * moved + step**2 / 12.0 * turned  # integral of t v over the step, cubic motion
        self.received += np.sum(first * moved + (last - first) / step * within, axis=1)
        self.moment += self.time[:, None] * moved + within
        self.moved += moved
        self.time += step

    @property
    def sums(self) -> dict[str, Array]:
        """All of them, by name."""
        return {
            "open.time": self.time, "open.received": self.received,
            "open.moved": self.moved, "open.moment": self.moment,
        }  # fmt: skip

    def close(self, evaluated: NDArray[np.bool_]) -> None:
        """Begin anew at these bearings."""
        for sums in self.sums.values():
            sums[evaluated] = 0.0


class Ledger(Observer):
    """Keeps the ledger of a run, step by step.

    Parameters
    ----------
    system : System
        Its rotor with ``track_work``.
    """

    def __init__(self, system: System) -> None:
        self._system = system
        self._works = np.zeros((len(system.bearings), len(COLUMNS)))
        self._before = self._values()
        self._open = _Open(len(system.bearings))
        self._rotor = np.empty(len(port.ENERGY) + len(port.WORK))
        self._block = Block(system.rotor, (*port.ENERGY, *port.WORK), self._rotor)
        self._first = np.zeros_like(self._rotor)
        self._friction, self._power = np.zeros(len(system.bearings)), self._friction_power()

    def begin(self, stepper: Stepper) -> None:
        """Take the start of the run."""
        self._before = self._values()
        self._power = self._friction_power()
        self._block.get()
        self._first[:] = self._rotor

    def watch(self, start: float, end: float, advance: Advance) -> None:
        """Enter an accepted step."""
        if self._system.turning:
            power = self._friction_power()
            self._friction += 0.5 * (end - start) * (self._power + power)
            self._power = power
        if advance.evaluated is not None:
            self._watch_some(end - start, advance.evaluated, advance.defect)
            return
        before, now, step = self._before, self._values(), end - start
        moved, turned = now[0][:, :4] - before[0][:, :4], now[0][:, 4:] - before[0][:, 4:]

        def work(first: Array, last: Array) -> Array:
            mean, change = (first + last) / 2.0, (last - first) / 12.0
            return np.sum(mean * moved + change * turned * step, axis=1)

        film = work(before[1], now[1])
        self._works[:, 0] += film
        self._works[:, 1] += work(before[2], now[2])
        self._works[:, 2] += work(self._law(before[0]), self._law(now[0]))
        self._works[:, 3] += np.abs(film)
        self._before = now

    def _watch_some(self, step: float, evaluated: NDArray[np.bool_], defect: Array) -> None:
        """Enter a step at whose end some bearings were evaluated."""
        before, now, since = self._before, self._values(), self._open
        since.add(step, before[0], now[0], self._law(before[0]), self._law(now[0]))
        linearly = since.moment / since.time[:, None]
        film = since.received + np.sum(defect * linearly, axis=1)
        contact = np.sum(before[2] * since.moved + (now[2] - before[2]) * linearly, axis=1)
        done = np.column_stack([film, contact, since.received, np.abs(film)])
        self._works[evaluated] += done[evaluated]
        since.close(evaluated)
        self._before = (now[0], now[1], np.where(evaluated[:, None], now[2], before[2]))

    def balance(self) -> Balance:
        """Return the ledger up to now; films between two evaluations give what the rotor received."""
        self._block.get()
        energies, works = np.split(self._rotor - self._first, [len(port.ENERGY)])
        of_vibration, given = (part[: port.VIBRATION] for part in (energies, works))
        rotation = None
        if self._system.turning:
            drive, _, windage = works[port.VIBRATION :].tolist()
            rotation = Rotation(float(energies[port.VIBRATION]), drive, windage, self._friction.copy())
        bearings, unbalance, damping = given.tolist()
        stored = float(of_vibration.sum())
        films = self._works.copy()
        films[:, (0, 2)] += self._open.received[:, None]
        films[:, 3] += np.abs(self._open.received)
        return Balance(films, stored, bearings, unbalance, damping, rotation)

    def arrays(self) -> dict[str, NDArray[Any]]:
        """All that it holds, by name."""
        before = {f"before{k}": values for k, values in enumerate(self._before)}
        friction = {"friction": self._friction, "power": self._power}
        return {"works": self._works, "first": self._first, **friction, **before, **self._open.sums}

    def restore(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what `arrays` returned."""
        self._works[:], self._first[:] = arrays["works"], arrays["first"]
        self._friction[:], self._power = arrays["friction"], arrays["power"]
        self._before = (arrays["before0"], arrays["before1"], arrays["before2"])
        for name, sums in self._open.sums.items():
            sums[:] = arrays[name]

    def _values(self) -> tuple[Array, Array, Array]:
        """Journals in their housings, wrenches, and their parts from contact."""
        system = self._system
        return system.motion.copy(), system.forces.copy(), system.responses[:, _CONTACT].copy()

    def _friction_power(self) -> Array:
        return self._system.responses[:, RESPONSE[port.FRICTION_POWER]].copy()

    def _law(self, journals: Array) -> Array:
        """Wrenches of the laws that the rotor used last."""
        return law_wrenches(self._system.laws, journals)
