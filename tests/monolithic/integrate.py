"""Integration of the holistic model by scipy's stiff solvers, the fracture being a restart."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter, process_time
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from tests.monolithic.holistic import Holistic

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Solution:
    """A run of the holistic model.

    Attributes
    ----------
    times : ndarray, (n,)
        Instants asked for [s].
    states : ndarray, (n, 2 m)
        x there.
    responses : ndarray, (n, n_b, 58)
        Outputs of the bearings there; wrenches first.
    evaluations : int
        Evaluations of single films that the integration took.
    factorisations, steps : int
        LU factorisations (real and complex ones) and accepted steps.
    wall, cpu : float
        Time that the integration took [s].
    """

    times: Array
    states: Array
    responses: Array
    evaluations: int
    factorisations: int
    steps: int
    wall: float
    cpu: float

    @property
    def forces(self) -> Array:
        """Fx, Fy of each bearing on the rotor, (n, n_b, 2) in N."""
        return self.responses[:, :, :2]


def integrate(
    model: Holistic, times: Array, *, rtol: float, method: Literal["Radau", "BDF"] = "Radau"
) -> Solution:
    """Integrate from t = 0 to the last of the given instants.

    Parameters
    ----------
    model : Holistic
        The model.
    times : ndarray, (n,)
        Ascending instants at which the solution is wanted [s].
    rtol : float
        Relative tolerance; the absolute one is `rtol` times `Holistic.state_scale`.
    method : {"Radau", "BDF"}
        Radau IIA of order 5 (Hairer and Wanner 1996) or variable-order BDF (Shampine and Reichelt 1997).

    Raises
    ------
    RuntimeError
        If the integrator gives up.
    """
    before, wall, cpu = model.evaluations, perf_counter(), process_time()
    end, fracture = float(times[-1]), model.fracture_time
    spans = [(0.0, min(fracture, end), False)]
    if fracture < end:
        spans.append((fracture, end, True))
    x, states, factorisations, steps = model.start, [], 0, 0
    for first, last, broken in spans:
        inside = times[(times > first) & (times <= last)] if broken else times[times <= last]
        asked = np.append(inside, last) if len(inside) == 0 or inside[-1] < last else inside
        solution = solve_ivp(
            lambda t, x, broken=broken: model.rates(t, x, broken),
            (first, last),
            x,
            method=method,
            t_eval=asked,
            rtol=rtol,
            atol=rtol * model.state_scale(),
            jac=lambda t, x: model.jacobian(x),
        )
        if not solution.success:
            raise RuntimeError(f"{method}, rtol = {rtol:g}: {solution.message}, after t = {first:g} s")
        states.append(solution.y.T[: len(inside)])
        x = solution.y[:, -1]
        factorisations += solution.nlu
        steps += solution.njev
    wall, cpu = perf_counter() - wall, process_time() - cpu
    found = np.concatenate(states)
    evaluations = model.evaluations - before
    return Solution(times, found, model.responses(found), evaluations, factorisations, steps, wall, cpu)
