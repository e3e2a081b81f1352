"""The train as a system of units: one rotor and its bearings, connected by the port."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from enum import Enum
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from fmus import port
from orchestrator.fmi.block import Block
from orchestrator.fmi.unit import Unit
from orchestrator.master.graph import Connection, Graph, Group
from orchestrator.master.interface import defects, largest_relative
from orchestrator.master.port_check import check_port
from orchestrator.master.rollback import Rollback

Array = NDArray[np.float64]

RESPONSE = {v.name: index for index, v in enumerate(port.BEARING_OUTPUTS)}
"""Column of each bearing output in `System.responses`."""

_BEARING_INPUTS = tuple(v.name for v in port.BEARING_INPUTS)
_BEARING_OUTPUTS = tuple(v.name for v in port.BEARING_OUTPUTS)
_TANGENT = slice(RESPONSE[port.K[0]], RESPONSE[port.C[-1]] + 1)
_FORCE = slice(RESPONSE[port.FORCE[0]], RESPONSE[port.FORCE[-1]] + 1)
_PER_LAW = len(port.LAW)
_PER_JOURNAL = len(port.JOURNAL)


class Wiring(Enum):
    """What a coupling carries from the bearings to the rotor."""

    LAW = "affine law"
    FORCE = "force only"


class System:
    """Rotor and bearings with the values that travel between them.

    Parameters
    ----------
    rotor : Unit
        Carries `port.rotor` for these bearings.
    bearings : sequence of Unit
        In the order of the rotor's bearings.
    wiring : Wiring
        What the bearings give the rotor.
    turning : bool
        Whether the rotor tells the bearings its speed, and they it their friction; else all are told.
    parts : int
        Equal parts in which the rotor goes each step by itself, as it was told.

    Raises
    ------
    PortError
        Listing every variable of the port that a unit lacks or declares differently.

    Attributes
    ----------
    journals : ndarray (bearings, 8)
        q and v of each journal, the rotor's outputs.
    housings : ndarray (bearings, 8) or None
        q and v of each housing, the rotor's outputs; None where they stand rigidly.
    responses : ndarray (bearings, 58)
        The bearings' outputs, columns as in `RESPONSE`.
    forces : ndarray (bearings, 4)
        Of those the wrench of each bearing on the rotor.
    tangent_rows, squares : ndarray (bearings, 32), (bearings, 2, 4, 4)
        Of those stiffness K and damping C by rows, and as matrices.
    laws : ndarray (bearings, 36)
        F0, K, C that the rotor was given last.
    groups : tuple of Group
        Rotor and bearings, in the order of a sequential coupling.
    rollback : Rollback
        The way back to the start of a step.
    loads, levers : ndarray (bearings,)
        See `set_scale`.
    turning, parts : bool, int
        As given.
    """

    def __init__(
        self,
        rotor: Unit,
        bearings: Sequence[Unit],
        wiring: Wiring = Wiring.LAW,
        *,
        turning: bool = False,
        parts: int = 1,
    ) -> None:
        n = len(bearings)
        self.turning, self.parts = turning, parts
        check_port(rotor, bearings, turning=turning)
        self.rotor = rotor
        self.bearings = tuple(bearings)
        self.wiring = wiring
        rotor_inputs = (port.SPEED, *_at_bearings(n, port.LAW))
        moving = port.at_bearing(1, port.HOUSING[0]) in rotor.file.variables
        if turning:
            friction = (port.at_bearing(i, port.FRICTION_POWER) for i in range(1, n + 1))
            rotor_inputs += (*port.SWITCHES, port.LOST, *friction)
        rotor_outputs = tuple(_at_bearings(n, port.JOURNAL))
        if moving:
            rotor_outputs += tuple(_at_bearings(n, port.HOUSING))
        rotor_outputs += (port.ROTATION,) if turning else ()
        self.graph = Graph(
            [
                (rotor, rotor_inputs, rotor_outputs),
                *((bearing, _BEARING_INPUTS, _BEARING_OUTPUTS) for bearing in bearings),
            ],
            port_connections(rotor.name, [b.name for b in bearings], wiring, moving=moving, turning=turning),
        )
        inputs, outputs = self.graph.inputs, self.graph.outputs
        self.journals: Array = outputs[: n * _PER_JOURNAL].reshape(n, _PER_JOURNAL)
        self.housings: Array | None = None
        if moving:
            self.housings = outputs[n * _PER_JOURNAL : 2 * n * _PER_JOURNAL].reshape(n, _PER_JOURNAL)
        self.responses: Array = outputs[len(rotor_outputs) :].reshape(n, len(_BEARING_OUTPUTS))
        self.forces, self.tangent_rows = self.responses[:, _FORCE], self.responses[:, _TANGENT]
        self.squares: Array = self.tangent_rows.reshape(-1, 2, 4, 4)
        turned = slice(1 + n * _PER_LAW, len(rotor_inputs))
        self.laws: Array = inputs[1 : turned.start].reshape(n, _PER_LAW)
        self._rotor_speed = inputs[:1]
        self._speed_now = outputs[len(rotor_outputs) - 1 : len(rotor_outputs)] if turning else inputs[:1]
        self._input_at = {name: index for index, name in enumerate(rotor_inputs)}
        self.bearing_inputs: Array = inputs[len(rotor_inputs) :].reshape(n, len(_BEARING_INPUTS))
        self.rotor_group: Group = self.graph.group([rotor.name])
        self.bearing_group: Group = self.graph.group([b.name for b in bearings])
        self.groups = (self.rotor_group, self.bearing_group)
        self.rollback = Rollback(self.units, self.graph)
        self._law_blocks: dict[tuple[int, int], Block] = {}
        self._friction = inputs[turned][len(port.SWITCHES) + 1 :]
        self._turning = Block(rotor, rotor_inputs[turned], inputs[turned])
        self._defect = np.empty((n, 4))
        self.loads, self.levers = np.ones(n), np.ones(n)

    @property
    def units(self) -> tuple[Unit, ...]:
        """Rotor and bearings."""
        return (self.rotor, *self.bearings)

    @property
    def motion(self) -> Array:
        """Motion of each journal in its housing (bearings, 8): `journals` itself where that is rigid."""
        return self.journals if self.housings is None else self.journals - self.housings

    @property
    def tangents(self) -> Array:
        """Stiffness and damping [K C] that the bearings returned last (bearings, 4, 8), a copy."""
        square = self.squares
        return np.concatenate([square[:, 0], square[:, 1]], axis=2)

    def set_scale(self, load: float, levers: Iterable[float]) -> None:
        """Say what wrenches are measured by.

        Parameters
        ----------
        load : float
            Least scale of a bearing's force in N, such as the mean static load.
        levers : iterable of float
            For each bearing the lever in m that makes a scale of moments of it, such as the width.
        """
        self.loads[:] = load
        self.levers[:] = list(levers)

    def scale(self) -> Array:
        """Return what wrenches are measured by now (bearings, 4): the load, or the force where larger."""
        force = self._force_scale()
        moment = force * self.levers
        return np.stack([force, force, moment, moment], axis=1)

    def relative(self, defect: Array) -> float:
        """Return the largest component of a defect against `scale`."""
        return largest_relative(defect, self.forces, self.loads, self.levers)

    def _force_scale(self) -> Array:
        return np.maximum(self.loads, np.hypot(self.forces[:, 0], self.forces[:, 1]))

    @property
    def speed(self) -> float:
        """Speed of the rotor now in rad/s."""
        return float(self._speed_now[0])

    def switch(self, name: str, by: float = 1.0) -> None:
        """Add to an input of a turning rotor, one of `port.SWITCHES` or `port.LOST`, from now on."""
        self.graph.inputs[self._input_at[name]] += by

    def set_speed(self, speed: float) -> None:
        """Set the rotor speed in rad/s; the units have it from the next `Group.push` on."""
        self._rotor_speed[0] = speed
        self.set_film_speed(speed)

    def set_film_speed(self, speed: float) -> None:
        """Set the speed of the bearings alone, as `set_speed`."""
        self.bearing_inputs[:, _BEARING_INPUTS.index(port.SPEED)] = speed

    def tell_laws(self, changed: Sequence[int]) -> None:
        """Tell the rotor over FMI what has changed in `laws`, by numbers of bearings, and what turns it."""
        start = perf_counter()
        for first, end in _runs(changed) if 2 * len(changed) <= len(self.laws) else [(0, len(self.laws))]:
            if (first, end) not in self._law_blocks:
                names = [port.at_bearing(k + 1, name) for k in range(first, end) for name in port.LAW]
                self._law_blocks[first, end] = Block(self.rotor, names, self.laws[first:end].reshape(-1))
            self._law_blocks[first, end].set()
        if self.turning:
            self._friction[:] = self.responses[:, RESPONSE[port.FRICTION_POWER]]
            self._turning.set()
        self.rotor_group.exchange_time += perf_counter() - start

    def carry_rotor(self, time: float, step: float, parts: int) -> None:
        """Carry the rotor over a macro step in equal parts, if it does not go in them itself, and read it.

        Raises
        ------
        UnitError
            As `Group.step`.
        """
        steps = parts if self.parts == 1 else 1
        part = step / steps
        for k in range(steps):
            self.rotor_group.step(time + k * part, part)
        self.rotor_group.fetch()

    def stands_at(self) -> Array:
        """Return the motion of each journal in its housing where its bearing stands, (bearings, 8)."""
        there = self.bearing_inputs[:, :_PER_JOURNAL]
        if self.housings is None:
            return there
        return there - self.bearing_inputs[:, _PER_JOURNAL : 2 * _PER_JOURNAL]

    def defect(self) -> Array:
        """Return F(q, v) - (F0 - K q - C v) at the newest state with the law that the rotor used.

        Returns
        -------
        ndarray (bearings, 4)
            Overwritten by the next call.
        """
        defects(self.laws, self.motion, self.forces, self._defect)
        return self._defect

    def close(self) -> None:
        """Free all units."""
        self.bearing_group.close()
        self.rollback.close()
        for unit in self.units:
            unit.close()


def law_wrenches(laws: Array, motion: Array) -> Array:
    """F0 - K q - C v of laws (bearings, 36) at the motion of journals (bearings, 8), (bearings, 4)."""
    tangents = laws[:, 4:].reshape(-1, 2, 4, 4)
    reaction = np.matmul(tangents, motion.reshape(-1, 2, 4, 1)).sum(axis=1)[..., 0]
    return np.asarray(laws[:, :4] - reaction)


def port_connections(
    rotor: str, bearings: Sequence[str], wiring: Wiring, *, moving: bool = False, turning: bool = False
) -> Iterator[Connection]:
    """Connections of the port between units of these names.

    With `moving` the rotor moves the housings, with `turning` it owns the speed, too.
    """
    sources = port.LAW if wiring is Wiring.LAW else port.FORCE
    for index, bearing in enumerate(bearings, 1):
        for name in (*port.JOURNAL, *(port.HOUSING if moving else ())):
            yield Connection(rotor, port.at_bearing(index, name), bearing, name)
        for output, name in zip(sources, port.LAW, strict=False):
            yield Connection(bearing, output, rotor, port.at_bearing(index, name))
        if turning:
            yield Connection(rotor, port.ROTATION, bearing, port.SPEED)
            power = port.at_bearing(index, port.FRICTION_POWER)
            yield Connection(bearing, port.FRICTION_POWER, rotor, power)


def _runs(numbers: Sequence[int]) -> list[tuple[int, int]]:
    """First and end of runs of neighbours among ascending numbers: they travel in one call."""
    runs: list[tuple[int, int]] = []
    for k in numbers:
        first = runs.pop()[0] if runs and runs[-1][1] == k else k
        runs.append((first, k + 1))
    return runs


def _at_bearings(count: int, names: Iterable[str]) -> Iterator[str]:
    names = tuple(names)
    for index in range(1, count + 1):
        yield from _at_bearing(index, names)


def _at_bearing(index: int, names: Iterable[str]) -> list[str]:
    return [port.at_bearing(index, name) for name in names]
