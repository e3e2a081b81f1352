"""What a reduction costs: the reduced shaft beside the unreduced one where it matters.

Good free-free frequencies do not make a good coupled model.  So the report also has
the modes on bearings, the static bearing loads and the bearing forces from unbalance.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy  # scipy.optimize is loaded where it is used: few runs need it
from numpy.typing import ArrayLike, NDArray

from rotor_fmu.linear.harmonic import static_response, unbalance_responses
from rotor_fmu.linear.whirl import Bearings, campbell
from rotor_fmu.reduction.reduce import ReducedShaft
from rotor_fmu.shaft.matrices import ShaftModel

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class Pair:
    """The same quantity of the unreduced and of the reduced shaft, and the scale of its error."""

    full: NDArray
    reduced: NDArray
    scale: Array

    @property
    def error(self) -> Array:
        """|reduced - full| over the scale, elementwise."""
        return np.abs(self.reduced - self.full) / self.scale

    @property
    def worst(self) -> float:
        """Largest error."""
        return float(self.error.max())


@dataclass(frozen=True, eq=False)
class ReductionReport:
    """Errors of a reduction over S speeds.

    Attributes
    ----------
    method, size : str, int
        Name and degrees of freedom of the reduction.
    iterations : int
        Of IRS, else 0.
    speeds : ndarray, (S,)
        [rad/s].
    free, supported : Pair of complex ndarray, (S, count)
        Eigenvalues of the free shaft's elastic modes and on the bearings [1/s], relative to their modulus.
    static : Pair of ndarray, (n_b, 2)
        Static bearing forces [N] on bearings in line, relative to the largest.
    unbalance : Pair of complex ndarray, (S, n_b, 2)
        Bearing forces from unbalance [N], relative to the largest at that speed.
    """

    method: str
    size: int
    iterations: int
    speeds: Array
    free: Pair
    supported: Pair
    static: Pair
    unbalance: Pair

    def __str__(self) -> str:
        """A table over speed, worst errors."""
        title = f"{self.method}, {self.size} degrees of freedom"
        if self.iterations:
            title += f", {self.iterations} iterations"
        rows = [
            title,
            f"static bearing forces: {self.static.worst:.1e}",
            "speed [1/s]  free-free frequencies  supported eigenvalues  unbalance bearing forces",
        ]
        for k, speed in enumerate(self.speeds):
            free, supported, unbalance = (
                float(pair.error[k].max()) for pair in (self.free, self.supported, self.unbalance)
            )
            rows.append(
                f"{speed / (2.0 * math.pi):11.2f}  {free:21.1e}  {supported:21.1e}  {unbalance:24.1e}"
            )
        return "\n".join(rows)


def reduction_report(
    model: ShaftModel,
    reduced: ReducedShaft,
    bearings: Bearings,
    speeds: Sequence[float],
    unbalance: ArrayLike,
    *,
    count: int = 16,
    elastic_above: float = 2.0,
) -> ReductionReport:
    """Compare a reduced shaft with the unreduced one.

    Parameters
    ----------
    model, reduced : ShaftModel, ReducedShaft
        The shaft, and its reduction.
    bearings : Bearings
        Linearised bearings, the same at all speeds.
    speeds : sequence of float
        [rad/s], positive.
    unbalance : array_like of complex, (n_w,)
        U exp(i phase) of each wheel [kg m].
    count : int
        Modes to compare, fewer where the shafts have not as many; two whirl directions count as two.
    elastic_above : float
        Free-free modes below this frequency [rad/s] are rigid-body motion.

    Returns
    -------
    ReductionReport
        Both results and their differences.
    """
    pairs = []
    for held, above in ((None, elastic_above), (bearings, 0.1)):
        wanted, offered = (
            [modes.eigenvalues for modes in campbell(shaft, speeds, number, bearings=held, above=above)]
            for shaft, number in ((model, count), (reduced, count + 8))
        )
        number = min(len(values) for values in wanted + offered)
        exact = np.array([values[np.sort(np.argsort(np.abs(values))[:number])] for values in wanted])
        nearest = np.array([matched(a, values) for a, values in zip(exact, offered, strict=True)])
        pairs.append((exact, nearest))
    (free, free_reduced), (supported, supported_reduced) = pairs
    static = [static_response(shaft, bearings)[1][:, :2] for shaft in (model, reduced)]
    forces = [
        np.array([r.wrench[:, :2] for r in unbalance_responses(shaft, speeds, bearings, unbalance)])
        for shaft in (model, reduced)
    ]
    largest = np.abs(forces[0]).max(axis=(1, 2), keepdims=True)
    largest[largest == 0.0] = 1.0  # no unbalance, no force, no error
    return ReductionReport(
        method=reduced.method,
        size=reduced.size,
        iterations=max(len(reduced.history) - 1, 0),
        speeds=np.array(speeds, dtype=np.float64),
        free=Pair(free, free_reduced, np.abs(free)),
        supported=Pair(supported, supported_reduced, np.abs(supported)),
        static=Pair(static[0], static[1], np.abs(static[0]).max()),
        unbalance=Pair(forces[0], forces[1], largest),
    )


def matched(exact: Complex, offered: Complex) -> Complex:
    """The offered eigenvalues that belong to the exact ones: least sum of distances, each used once.

    Parameters
    ----------
    exact, offered : ndarray of complex, (k,), (l,)
        With l >= k.
    """
    _, chosen = scipy.optimize.linear_sum_assignment(np.abs(exact[:, None] - offered))
    return offered[chosen]
