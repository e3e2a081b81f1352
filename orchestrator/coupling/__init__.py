"""Coupling schemes by name."""

from __future__ import annotations

from orchestrator.coupling.base import Advance, Coupled, Coupling
from orchestrator.coupling.gauss_seidel import GaussSeidel
from orchestrator.coupling.jacobi import Jacobi
from orchestrator.coupling.linear_implicit import LinearImplicit

__all__ = ["SCHEMES", "Advance", "Coupled", "Coupling", "GaussSeidel", "Jacobi", "LinearImplicit"]

SCHEMES: dict[str, Coupling] = {scheme.name: scheme for scheme in (LinearImplicit(), GaussSeidel(), Jacobi())}
"""Schemes by their name in scenarios."""
