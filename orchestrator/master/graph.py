"""Units and the connections between them, apart from the order in which a coupling runs them.

All outputs of the graph lie in one array and all inputs in another; each unit is bound
to its stretch of both, and a connection is a pair of indices.  Moving values along the
connections is then one indexed copy for a whole group of units.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from orchestrator.errors import PortError
from orchestrator.fmi.block import Block
from orchestrator.fmi.unit import Unit
from orchestrator.master.threads import StepThreads


@dataclass(frozen=True)
class Connection:
    """One value that travels from an output to an input.

    Attributes
    ----------
    source, target : str
        Names of the units.
    output, input : str
        Names of their variables.
    """

    source: str
    output: str
    target: str
    input: str


class Group:
    """Units that a coupling feeds, steps and reads together; made by `Graph.group`.

    Attributes
    ----------
    units : tuple of Unit
        In the order in which they step.
    step_time, exchange_time : float
        Wall time so far in the units' steps, and in moving values to and from them, in s.
    hold : ndarray
        For each connection into the group what an input that holds through a step best has of the value
        at the end: 1 where an output depends on it directly, else 1/2, the mean of both ends.
    """

    def __init__(self, graph: Graph, names: Iterable[str]) -> None:
        members = [graph.members[name] for name in names]
        self.units: tuple[Unit, ...] = tuple(m.unit for m in members)
        self._graph = graph
        self._threads = StepThreads(self.units)
        self._targets = np.concatenate([m.targets for m in members])
        self._sources = np.concatenate([m.sources for m in members])
        self._moves = [(_as_slice(m.targets), _as_slice(m.sources), m.linked) for m in members]
        self._feeds = tuple(m.linked.set for m in members if m.linked is not None)
        self._sets = tuple(m.inputs.set for m in members)
        self._gets = tuple(m.outputs.get for m in members)
        self.step_time = 0.0
        self.exchange_time = 0.0
        self.hold = graph.hold[self._targets]
        self._measure = np.unique(graph.measure[self._targets], return_inverse=True)[1]

    def employ(self, threads: int) -> None:
        """Step the units on this many threads from now on."""
        self._threads.close()
        self._threads = StepThreads(self.units, threads)

    def close(self) -> None:
        """End the threads."""
        self._threads.close()

    def feed(self) -> None:
        """Move the newest outputs along the connections into the inputs of these units."""
        self.give(self._graph.outputs[self._sources])

    def give(self, values: NDArray[np.float64]) -> None:
        """Set the connected inputs of these units to values, in the order of `received`."""
        start = perf_counter()
        self._graph.inputs[self._targets] = values
        for call in self._feeds:
            call()
        self.exchange_time += perf_counter() - start

    def received(self) -> NDArray[np.float64]:
        """Return the newest values of the outputs that are connected to these units."""
        return self._graph.outputs[self._sources]

    def lacking(self) -> NDArray[np.float64]:
        """Return the newest values of the connected outputs less what these units were given."""
        return self._graph.outputs[self._sources] - self._graph.inputs[self._targets]

    def per_measure(self, sizes: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return for each connection the largest size among those of the same unit and measure, never 0."""
        largest = np.zeros(self._measure.max(initial=-1) + 1)
        np.maximum.at(largest, self._measure, sizes)
        largest[largest == 0.0] = 1.0
        return largest[self._measure]

    def push(self) -> None:
        """Give these units all their inputs as they stand in `Graph.inputs`, connected or not."""
        for call in self._sets:
            call()

    def step(self, time: float, step: float) -> None:
        """Carry out the macro step from `time` in every unit; they are independent of one another.

        Raises
        ------
        UnitError
            From the first unit that does not accept the step.
        """
        start = perf_counter()
        try:
            self._threads.step(time, step)
        finally:
            self.step_time += perf_counter() - start

    def carry(self, chosen: Sequence[int], times: Sequence[float], steps: Sequence[float]) -> None:
        """Feed the units of these numbers, carry out in each a macro step of its own, and read their outputs.

        Raises
        ------
        UnitError
            As `step`.
        """
        start = perf_counter()
        inputs, outputs = self._graph.inputs, self._graph.outputs
        for k in chosen:
            targets, sources, linked = self._moves[k]
            inputs[targets] = outputs[sources]
            if linked is not None:
                linked.set()
        fed = perf_counter()
        try:
            self._threads.step_some(chosen, times, steps)
        finally:
            stepped = perf_counter()
            self.step_time += stepped - fed
        for k in chosen:
            self._gets[k]()
        self.exchange_time += fed - start + perf_counter() - stepped

    def fetch(self, chosen: Iterable[int] | None = None) -> None:
        """Read the outputs of these units, or of those of these numbers."""
        start = perf_counter()
        for call in self._gets if chosen is None else [self._gets[k] for k in chosen]:
            call()
        self.exchange_time += perf_counter() - start

    @property
    def evaluations(self) -> int:
        """Steps that these units have begun."""
        return sum(unit.evaluations for unit in self.units)


@dataclass(frozen=True)
class Member:
    """A unit in the graph.

    Attributes
    ----------
    unit : Unit
        The instance.
    inputs, outputs : Block
        Its stretches of the graph's two arrays.
    linked : Block or None
        The part of the inputs from the first to the last with a connection.
    targets, sources : ndarray of int
        The connections into it: ``graph.inputs[targets] = graph.outputs[sources]``.
    """

    unit: Unit
    inputs: Block
    outputs: Block
    linked: Block | None
    targets: NDArray[np.intp]
    sources: NDArray[np.intp]


class Graph:
    """Units joined by connections.

    Parameters
    ----------
    units : sequence of (Unit, inputs, outputs)
        Units of unique names with the names of the inputs and outputs that travel.
    connections : iterable of Connection
        An input without a connection keeps its value in `inputs`, at first its start value.

    Raises
    ------
    PortError
        When two units have the same name or a unit lacks one of the variables.

    Attributes
    ----------
    inputs, outputs : ndarray
        The values of all units, one after the other.
    members : dict
        The units by name.
    hold, measure : ndarray
        For each input, see `Group.hold`; and a number that inputs of one unit in the same unit of
        measurement share.
    """

    def __init__(
        self,
        units: Sequence[tuple[Unit, Sequence[str], Sequence[str]]],
        connections: Iterable[Connection],
    ) -> None:
        input_at = _positions((unit.name, names) for unit, names, _ in units)
        output_at = _positions((unit.name, names) for unit, _, names in units)
        self.inputs = np.zeros(len(input_at))
        self.outputs = np.zeros(len(output_at))
        links: dict[str, list[tuple[int, int]]] = {unit.name: [] for unit, _, _ in units}
        for c in connections:
            links[c.target].append((input_at[c.target, c.input], output_at[c.source, c.output]))
        self.hold = np.concatenate([_hold(unit, names, travelling) for unit, names, travelling in units])
        measures = [(unit.name, unit.variable(name).unit) for unit, names, _ in units for name in names]
        self.measure = np.array([measures.index(measure) for measure in measures])
        self.members: dict[str, Member] = {}
        first_input = first_output = 0
        for unit, input_names, output_names in units:
            own_inputs = self.inputs[first_input : first_input + len(input_names)]
            own_outputs = self.outputs[first_output : first_output + len(output_names)]
            pairs = np.array(links[unit.name], dtype=np.intp).reshape(-1, 2)
            own_inputs[:] = [float(unit.variable(name).start or 0.0) for name in input_names]
            self.members[unit.name] = Member(
                unit,
                Block(unit, input_names, own_inputs),
                Block(unit, output_names, own_outputs),
                self._linked(unit, input_names, first_input, pairs[:, 0]),
                pairs[:, 0].copy(),
                pairs[:, 1].copy(),
            )
            first_input += len(input_names)
            first_output += len(output_names)

    def _linked(
        self, unit: Unit, names: Sequence[str], first: int, targets: NDArray[np.intp]
    ) -> Block | None:
        if not len(targets):
            return None
        low, high = int(targets.min()), int(targets.max()) + 1
        return Block(unit, names[low - first : high - first], self.inputs[low:high])

    def group(self, names: Iterable[str]) -> Group:
        """Return the units of these names as a group."""
        return Group(self, names)


def _as_slice(places: NDArray[np.intp]) -> NDArray[np.intp] | slice:
    """The same places as a slice, where they follow one another; numpy takes it in a quarter of the time."""
    if len(places) and (np.diff(places) == 1).all():
        return slice(int(places[0]), int(places[-1]) + 1)
    return places


def _hold(unit: Unit, inputs: Sequence[str], outputs: Sequence[str]) -> NDArray[np.float64]:
    """1 for inputs on which a travelling output depends directly (all where nothing is said), else 1/2."""
    direct: set[str] = set()
    for output in unit.file.description.outputs:
        if output.variable.name in outputs:
            if output.dependencies is None:
                return np.ones(len(inputs))
            direct |= {variable.name for variable in output.dependencies}
    return np.array([1.0 if name in direct else 0.5 for name in inputs])


def _positions(parts: Iterable[tuple[str, Sequence[str]]]) -> dict[tuple[str, str], int]:
    keys = [(unit, name) for unit, names in parts for name in names]
    positions = {key: index for index, key in enumerate(keys)}
    if len(positions) < len(keys):
        raise PortError("every unit of a system needs a name of its own")
    return positions
