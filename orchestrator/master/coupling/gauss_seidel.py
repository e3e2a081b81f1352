"""Gauss-Seidel: one group after the other, each on the newest values (Busch 2012, section 3.2)."""

from __future__ import annotations

from typing import ClassVar

from orchestrator.master.coupling.base import Sequential
from orchestrator.master.system import Wiring


class GaussSeidel(Sequential):
    """Explicit and sequential, rotor then bearings; force only."""

    name: ClassVar[str] = "gauss-seidel"
    wiring: ClassVar[Wiring] = Wiring.FORCE
