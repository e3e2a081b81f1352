"""Any FMI 2.0 co-simulation units as a system, given as a graph and the order of its groups."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from orchestrator.master.graph import Graph
from orchestrator.master.rollback import Rollback


class Loop:
    """Units and connections for the couplings that need no port: explicit ones and iqn-ils.

    Parameters
    ----------
    graph : Graph
        The units and their connections.
    order : sequence of sequences of str
        Names of the units of each group, in the order of the flow through the system. The loops must
        close through the first group: what a later group receives comes from earlier ones.
    """

    def __init__(self, graph: Graph, order: Sequence[Sequence[str]]) -> None:
        self.graph = graph
        self.groups = tuple(graph.group(names) for names in order)
        self.rollback = Rollback([member.unit for member in graph.members.values()], graph)
        self._largest = np.zeros(len(self.groups[0].received()))

    def begin(self, time: float = 0.0) -> None:
        """Initialize all units, group by group in the order of the flow."""
        units = [unit for group in self.groups for unit in group.units]
        for unit in units:
            unit.enter_initialization(time)
        for group in self.groups:
            group.push()
            group.feed()
            group.fetch()
        self.groups[0].feed()
        for unit in units:
            unit.exit_initialization()
        for group in self.groups:
            group.fetch()

    def defect(self) -> NDArray[np.float64]:
        """Return what the first group's inputs lack of the outputs that they are connected to."""
        return self.groups[0].lacking()

    def relative(self, defect: NDArray[np.float64]) -> float:
        """Return the largest component of a defect against the largest values of its unit and measure."""
        first = self.groups[0]
        np.maximum(self._largest, np.abs(first.received()), out=self._largest)
        return float(np.max(np.abs(defect) / first.per_measure(self._largest), initial=0.0))

    def close(self) -> None:
        """Free all units."""
        self.rollback.close()
        for member in self.graph.members.values():
            member.unit.close()
