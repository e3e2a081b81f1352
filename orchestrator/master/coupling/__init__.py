"""Coupling schemes by name."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import ClassVar

from orchestrator.master.coupling.base import Advance, Coupled, Coupling, NotConverged
from orchestrator.master.coupling.gauss_seidel import GaussSeidel
from orchestrator.master.coupling.iqn_ils import IqnIls
from orchestrator.master.coupling.jacobi import Jacobi
from orchestrator.master.coupling.linear_implicit import LinearImplicit
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
    "Newton",
    "NotConverged",
    "make_scheme",
]


class _Schemes(Mapping[str, Coupling]):
    """Schemes by name; each look-up makes a fresh one, without memory of another run."""

    _makers: ClassVar[dict[str, Callable[[], Coupling]]] = {
        "linear-implicit": LinearImplicit,
        "newton": Newton,
        "iqn-ils": IqnIls,
        "gauss-seidel": GaussSeidel,
        "jacobi": Jacobi,
    }

    def __getitem__(self, name: str) -> Coupling:
        return self._makers[name]()

    def __iter__(self) -> Iterator[str]:
        return iter(self._makers)

    def __len__(self) -> int:
        return len(self._makers)


SCHEMES = _Schemes()
"""Schemes by their name in scenarios; each look-up makes a fresh one."""


def make_scheme(name: str, tolerance: float | None = None) -> Coupling:
    """A fresh scheme.

    Parameters
    ----------
    name : str
        A key of `SCHEMES`.
    tolerance : float, optional
        Of the schemes that iterate.
    """
    if tolerance is not None:
        if name == Newton.name:
            return Newton(tolerance)
        if name == IqnIls.name:
            return IqnIls(tolerance)
    return SCHEMES[name]
