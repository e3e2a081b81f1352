"""Coupling schemes by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from orchestrator.master.coupling.base import Advance, Coupled, Coupling, NotConverged
from orchestrator.master.coupling.gauss_seidel import GaussSeidel
from orchestrator.master.coupling.iqn_ils import IqnIls
from orchestrator.master.coupling.jacobi import Jacobi
from orchestrator.master.coupling.linear_implicit import LinearImplicit
from orchestrator.master.coupling.multirate import Multirate
from orchestrator.master.coupling.newton import Newton

__all__ = [
    "SCHEMES",
    "Advance",
    "Coupled",
    "Coupling",
    "GaussSeidel",
    "IqnIls",
    "Jacobi",
    "LinearImplicit",
    "Multirate",
    "Newton",
    "NotConverged",
    "make_scheme",
]


SCHEMES: Mapping[str, type[Coupling]] = {
    scheme.name: scheme for scheme in (LinearImplicit, Multirate, Newton, IqnIls, GaussSeidel, Jacobi)
}
"""Schemes by their name in scenarios."""


def make_scheme(name: str, tolerance: float | None = None) -> Coupling:
    """Make the scheme of this name, without memory of another run.

    Parameters
    ----------
    name : str
        A key of `SCHEMES`.
    tolerance : float, optional
        Of the schemes that iterate, or have many rates; each has its own where there is none.
    """
    scheme = SCHEMES[name]
    takes: Callable[..., Coupling] = scheme
    return takes(tolerance) if tolerance is not None and (scheme.iterates or scheme.many_rates) else takes()
