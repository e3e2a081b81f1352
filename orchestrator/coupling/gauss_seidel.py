"""Gauss-Seidel: one group after the other, each on the newest values (Busch 2012, section 3.2)."""

from __future__ import annotations

from orchestrator.coupling.base import Advance, Coupled, Memoryless
from orchestrator.system import Wiring


class GaussSeidel(Memoryless):
    """Explicit and sequential, rotor then bearings; force only."""

    name = "gauss-seidel"
    wiring = Wiring.FORCE

    def advance(self, system: Coupled, time: float, step: float) -> Advance:
        """Feed, step and read group by group."""
        for group in system.groups:
            group.feed()
            group.step(time, step)
            group.fetch()
        return Advance(1, system.defect())
