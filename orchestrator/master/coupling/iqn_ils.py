"""Interface quasi-Newton with inverse least squares, for units that export no tangents.

One pass through the groups maps the values x that the first group receives to the values
``H(x)`` that the later ones return to it.  The residual ``R = H(x) - x`` is brought to zero by ::

    x <- H(x) + W c,    c = argmin |V c + R|

where the columns of V and W are the changes of R and H(x) over the passes of this step and of
a few steps before (Degroote, Bathe, Vierendeels 2009, Computers & Structures 87, 793-801).
Columns that add nothing are left out by a QR factorisation from the newest to the oldest.

Values hold through a step.  An input of which no output of its unit depends directly acts by its
mean over the step, and is given the mean of the values at both ends, which keeps the second order;
with direct feedthrough it is given the value at the end.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from orchestrator.master.coupling.base import Advance, Coupled, NotConverged
from orchestrator.master.system import Wiring

Array = NDArray[np.float64]

_DEPENDENT = 1e-6
"""Share of a column that must be new for it to count."""

_ROUNDING = 1e-12
"""Size that a column's new part must have, against the values transmitted: above their rounding."""


@dataclass
class IqnIls:
    """Interface quasi-Newton with inverse least squares.

    Parameters
    ----------
    tolerance : float
        Largest residual at which the iteration ends, against the largest value transmitted so far of
        the same unit and measure.
    limit : int
        Passes over a step before it is given up.
    reuse : int
        Earlier steps whose differences are kept.
    relaxation : float
        Share of the residual that is taken while there are no differences.
    """

    tolerance: float = 1e-6
    limit: int = 60
    reuse: int = 8
    relaxation: float = 0.02

    name: ClassVar[str] = "iqn-ils"
    wiring: ClassVar[Wiring] = Wiring.FORCE
    iterates: ClassVar[bool] = True
    many_rates: ClassVar[bool] = False
    parts: ClassVar[int] = 1

    _history: list[tuple[Array, Array]] = field(default_factory=list, init=False)
    _size: Array | None = field(default=None, init=False)

    @property
    def memory(self) -> dict[str, NDArray[Any]]:
        """Differences of earlier steps, and the sizes of the values."""
        pairs = enumerate(self._history)
        kept = {f"{name}{k}": a for k, pair in pairs for name, a in zip("VW", pair, strict=True)}
        return kept if self._size is None else {**kept, "size": self._size}

    @memory.setter
    def memory(self, arrays: dict[str, NDArray[Any]]) -> None:
        steps = sum(name.startswith("V") for name in arrays)
        self._history = [(arrays[f"V{k}"], arrays[f"W{k}"]) for k in range(steps)]
        self._size = arrays.get("size")

    def refuse(self) -> int:
        """One halving will do; differences of a step taken back are as good."""
        return 1

    def begin_anew(self) -> None:
        """Nothing: differences of steps before an event are as good as any first guess."""

    def advance(self, system: Coupled, time: float, step: float, common: bool = True) -> Advance:
        """Repeat the step until what the first group receives is what the others return."""
        system.rollback.mark()
        first, later = system.groups[0], system.groups[1:]
        before = first.received()
        hold = first.hold
        if self._size is None:
            self._size = np.zeros_like(before)
        x = before.copy()
        residuals: list[Array] = []
        returned: list[Array] = []
        for iteration in range(1, self.limit + 1):
            first.give(hold * x + (1.0 - hold) * before)
            first.step(time, step)
            first.fetch()
            for group in later:
                group.feed()
                group.step(time, step)
                group.fetch()
            value = first.received()
            np.maximum(self._size, np.abs(value), out=self._size)
            scale = first.per_measure(self._size)
            residuals.append(value - x)
            returned.append(value)
            largest = float(np.max(np.abs(residuals[-1]) / scale, initial=0.0))
            if largest <= self.tolerance:
                self._remember(residuals, returned)
                return Advance(iteration, system.defect())
            if not np.isfinite(largest):
                break
            x = self._next(residuals, returned, x, scale)
            if iteration < self.limit:
                system.rollback.rewind()
        raise NotConverged(
            f"iqn-ils: residual {largest:.3g} after {iteration} passes, allowed is {self.tolerance:.3g}"
        )

    def _next(self, residuals: list[Array], returned: list[Array], x: Array, scale: Array) -> Array:
        V, W = _differences(residuals), _differences(returned)
        for old_V, old_W in self._history:
            V, W = np.hstack([V, old_V]), np.hstack([W, old_W])
        V, kept = _independent(V / scale[:, None])
        if not V.shape[1]:
            return x + self.relaxation * residuals[-1]
        c = np.linalg.lstsq(V, -residuals[-1] / scale, rcond=None)[0]
        return returned[-1] + W[:, kept] @ c

    def _remember(self, residuals: list[Array], returned: list[Array]) -> None:
        V, W = _differences(residuals), _differences(returned)
        if V.shape[1]:
            self._history.insert(0, (V, W))
            del self._history[self.reuse :]


def _differences(values: list[Array]) -> Array:
    """Changes from each vector to the next, the newest first, as columns."""
    return np.diff(np.array(values), axis=0)[::-1].T


def _independent(V: Array) -> tuple[Array, list[int]]:
    """Columns that are no combinations of those before them, at most as many as rows, and their places."""
    kept: list[int] = []
    basis = np.empty((len(V), 0))
    for k, column in enumerate(V.T):
        size = float(np.linalg.norm(column))
        rest = column - basis @ (basis.T @ column)
        rest -= basis @ (basis.T @ rest)
        norm = float(np.linalg.norm(rest))
        if norm > max(_DEPENDENT * size, _ROUNDING) and len(kept) < len(V):
            kept.append(k)
            basis = np.hstack([basis, (rest / norm)[:, None]])
    return V[:, kept], kept
