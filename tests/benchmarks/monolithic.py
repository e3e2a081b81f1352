"""The holistic model alone: error against cost of scipy's stiff solvers.

``python -m tests.benchmarks.monolithic [small | inertia]``
The reference of benchmark b is the tightest of them; two methods at two tolerances show how far it is to be
trusted.
"""

from __future__ import annotations

import sys
from typing import Literal

from tests.benchmarks.runs import Case, prepare, rms_error
from tests.benchmarks.table import percent, show
from tests.monolithic.integrate import Solution, integrate

REFERENCE_TOLERANCE = 1e-6
TOLERANCES: dict[Literal["Radau", "BDF"], tuple[float, ...]] = {
    "Radau": (1e-5, 1e-4, 5e-4, 1e-3, 2e-3, 5e-3),
    "BDF": (1e-5, 1e-4, 3e-4, 1e-3, 2e-3),
}
WINDOWS: dict[str, dict[str, object]] = {
    "small": {"end": 0.0996, "event": {"time": 0.0213}, "record": {"interval": 1.2e-3}},
    "inertia": {"end": 0.0816, "event": {"time": 0.0213}, "record": {"interval": 1.2e-3}},
}
"""Parts of the bundled scenarios through the fracture, which falls on no macro step; instants at which
errors are taken, a multiple of every macro step."""

COLUMNS = ("solver", "H, tol, rtol", "RMS force error", "film evaluations", "CPU s", "wall s")
Row = tuple[str, str, str, int, str, str]


def row(solver: str, size: float, error: float, evaluations: int, cpu: float, wall: float) -> Row:
    """A row under `COLUMNS`."""
    return solver, f"{size:.3g}", percent(error), evaluations, f"{cpu:.3f}", f"{wall:.3f}"


def reference_of(case: Case) -> Solution:
    """The reference solution."""
    return integrate(case.holistic(), case.times(), rtol=REFERENCE_TOLERANCE)


def solve(case: Case, method: Literal["Radau", "BDF"], rtol: float) -> Solution | None:
    """A solution, or None where the integrator gives up."""
    try:
        return integrate(case.holistic(), case.times(), rtol=rtol, method=method)
    except RuntimeError:
        return None


def main(source: str = "small") -> None:
    """Print the table."""
    case = prepare(source, **WINDOWS[source])
    exact = reference_of(case)
    rows = [row("Radau", REFERENCE_TOLERANCE, 0.0, exact.evaluations, exact.cpu, exact.wall)]
    for method, tolerances in TOLERANCES.items():
        for rtol in tolerances:
            found = solve(case, method, rtol)
            if found is not None:
                error = rms_error(found.forces, exact.forces)
                rows.append(row(method, rtol, error, found.evaluations, found.cpu, found.wall))
    show(
        f"Holistic model, scenario {source}, {case.scenario().end} s, {len(exact.states[0])} states",
        COLUMNS,
        rows,
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
