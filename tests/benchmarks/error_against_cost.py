"""Benchmark b: error against cost through the blade fracture, every coupling and the holistic model.

``python -m tests.benchmarks b``, or of one train ``python -m tests.benchmarks.error_against_cost small``.
"""

from __future__ import annotations

import sys
from typing import NamedTuple

from orchestrator.master.coupling import SCHEMES
from tests.benchmarks.monolithic import COLUMNS, TOLERANCES, WINDOWS, Row, reference_of, row, solve
from tests.benchmarks.runs import Case, prepare, rms_error, run
from tests.benchmarks.table import show
from tests.monolithic.integrate import Solution

STEPS = (6e-4, 4e-4, 3e-4, 2e-4, 1.5e-4, 1.2e-4, 1e-4, 5e-5)
"""Macro steps of couplings that are stable at any step of interest [s]."""

OWN_STEPS: dict[str, dict[str, tuple[float, ...]]] = {
    "small": {"gauss-seidel": (1e-5, 4e-6, 3e-6), "jacobi": (2e-6, 1e-6)},
    "inertia": {"gauss-seidel": (1e-5, 4e-6, 1e-6), "jacobi": (4e-6,), "newton": (2e-4, 1e-4), "iqn-ils": ()},
}
"""Of others: explicit ones down to where they are accurate or a minute is not enough; on the big train what
iterates, but for iqn-ils, which halves its steps for many minutes [s]."""

CONTROLLED = (
    ("linear-implicit", 1.2e-3, (0.2, 0.1, 0.05, 0.03, 0.025, 0.02, 0.01)),
    ("newton", 4e-4, (1e-2, 1e-3)),
    ("newton", 2e-4, (1e-2, 1e-3)),
)
"""Steps under control: coupling, longest macro step [s], and largest relative defects."""

WANTED = 0.01


class Cost(NamedTuple):
    """One run: error, evaluations of single films, processor time of the loop [s]."""

    error: float
    evaluations: int
    cpu: float


def couplings(case: Case, exact: Solution) -> tuple[dict[str, list[Cost]], list[Row]]:
    """Run every coupling of the registry of one rate at its steps; benchmark g has many."""
    costs: dict[str, list[Cost]] = {}
    rows: list[Row] = []
    for name, scheme in SCHEMES.items():
        for step in () if scheme.many_rates else OWN_STEPS[case.source].get(name, STEPS):
            timed = run(case, coupling=name, step=step)
            error = rms_error(timed.forces, exact.forces)
            cost = Cost(error, timed.result.evaluations, timed.cpu)
            costs.setdefault(name, []).append(cost)
            rows.append(row(name, step, error, cost.evaluations, timed.cpu, timed.wall))
    for name, step, tolerances in CONTROLLED:
        for tolerance in tolerances:
            timed = run(case, coupling=name, step=step, tolerance=tolerance)
            error = rms_error(timed.forces, exact.forces)
            cost = Cost(error, timed.result.evaluations, timed.cpu)
            costs[name].append(cost)
            rows.append(row(f"{name}, tol", tolerance, error, cost.evaluations, timed.cpu, timed.wall))
    return costs, rows


def holistic(case: Case, exact: Solution) -> tuple[dict[str, list[Cost]], list[Row]]:
    """Integrate the holistic model at every tolerance."""
    costs: dict[str, list[Cost]] = {}
    rows: list[Row] = []
    for method, tolerances in TOLERANCES.items():
        for rtol in tolerances:
            found = solve(case, method, rtol)
            if found is not None:
                error = rms_error(found.forces, exact.forces)
                costs.setdefault(f"holistic {method}", []).append(Cost(error, found.evaluations, found.cpu))
                rows.append(row(f"holistic {method}", rtol, error, found.evaluations, found.cpu, found.wall))
    return costs, rows


def cheapest(costs: list[Cost]) -> Cost | None:
    """The cheapest run that is within the wanted error."""
    good = [cost for cost in costs if cost.error <= WANTED]
    return min(good, key=lambda cost: cost.evaluations) if good else None


def comparison(costs: dict[str, list[Cost]]) -> str:
    """What the others need for 1 % against linear-implicit, a line each."""
    own = cheapest(costs["linear-implicit"])
    if own is None:
        return "linear-implicit does not reach 1 %"
    lines = [f"within 1 %: linear-implicit {own.evaluations} film evaluations, {own.cpu:.2f} s; against it"]
    for name, runs in costs.items():
        if name == "linear-implicit":
            continue
        best = cheapest(runs)
        if best is None:
            most = max(cost.evaluations for cost in runs)
            lines.append(
                f"  {name}: not within 1 % at {most / own.evaluations:.0f} times the film evaluations"
            )
        else:
            film, time = best.evaluations / own.evaluations, best.cpu / own.cpu
            lines.append(
                f"  {name}: {film:.3g} times the film evaluations, {time:.3g} times the processor time"
            )
    return "\n".join(lines)


def measure(source: str) -> None:
    """Print the table of one train."""
    case = prepare(source, **WINDOWS[source])
    exact = reference_of(case)
    run(case, coupling="linear-implicit", step=STEPS[0])  # numba and caches are warm from here on
    own, coupling_rows = couplings(case, exact)
    whole, holistic_rows = holistic(case, exact)
    scenario = case.scenario()
    lost = scenario.events[0].time
    show(
        f"b. Error against cost: scenario {source}, {scenario.end} s, blade off at {lost} s, "
        f"{exact.forces.shape[1]} bearings, {len(exact.states[0])} states",
        COLUMNS,
        [*coupling_rows, *holistic_rows],
        comparison({**own, **whole}),
    )


def main(*sources: str) -> None:
    """Print the tables of the small and the big train."""
    for source in sources or tuple(WINDOWS):
        measure(source)


if __name__ == "__main__":
    main(*sys.argv[1:])
