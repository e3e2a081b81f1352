"""Jacobi: all units step side by side on the values of the step's start (Busch 2012, section 3.2)."""

from __future__ import annotations

from typing import ClassVar

from orchestrator.master.coupling.base import Advance, Coupled, Memoryless
from orchestrator.master.system import Wiring


class Jacobi(Memoryless):
    """Explicit and parallel; force only.

    The bearings see the rotor one step late, so the defect is that of the step before.
    """

    name: ClassVar[str] = "jacobi"
    wiring: ClassVar[Wiring] = Wiring.FORCE

    def advance(self, system: Coupled, time: float, step: float, common: bool = True) -> Advance:
        """Feed all, step all, read all."""
        for group in system.groups:
            group.feed()
        for group in system.groups:
            group.step(time, step)
        for group in system.groups:
            group.fetch()
        return Advance(1, system.defect())
