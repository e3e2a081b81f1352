"""Benchmark g: what a force error costs with many rates, with one rate for all, and with the holistic model.

``python -m tests.benchmarks g``; a train and a picture: ``... .work_precision [small | inertia] [FILE.png]``.
At fixed and controlled steps, in one process, alternately; processor times are the least of two runs.
"""

from __future__ import annotations

import sys
from typing import Any, NamedTuple

import numpy as np

from tests.benchmarks.monolithic import WINDOWS, reference_of, solve
from tests.benchmarks.runs import Case, TimedRun, prepare, rms_error, run
from tests.benchmarks.table import percent, show
from tests.monolithic.integrate import Solution

AT = (0.01, 0.005, 0.0025)
"""Errors at which costs are compared."""

RUNS: dict[str, list[dict[str, Any]]] = {
    "linear-implicit, fixed": [
        {"coupling": "linear-implicit", "step": step} for step in (2e-4, 1.2e-4, 8e-5, 6e-5, 4e-5)
    ],
    "linear-implicit, controlled": [
        {"coupling": "linear-implicit", "step": 1.2e-3, "tolerance": tolerance}
        for tolerance in (0.05, 0.025, 0.015, 0.008, 0.004)
    ],
    "newton, controlled": [
        {"coupling": "newton", "step": 4e-4, "tolerance": tolerance} for tolerance in (1e-2, 3e-3, 1e-3)
    ],
    "multirate": [
        {"coupling": "multirate", "step": 1e-4, "tolerance": tolerance}
        for tolerance in (0.1, 0.05, 0.025, 0.015, 0.008, 0.004, 0.002)
    ],
}
HOLISTIC: dict[Any, tuple[float, ...]] = {"BDF": (2e-3, 1e-3, 3e-4, 1e-4), "Radau": (2e-3, 5e-4, 1e-4)}
COLUMNS = (
    "method", "H, tol, rtol", "RMS error", "largest", "estimated", "evaluations", "steps", "CPU s", "outcome",
)  # fmt: skip


class Cost(NamedTuple):
    """RMS error, evaluations of single films, processor time [s]."""

    error: float
    evaluations: int
    cpu: float


def at_error(costs: list[Cost], wanted: float) -> tuple[float, float] | None:
    """Evaluations and time at an error, on the lines through the runs in logarithms; None beyond them."""
    runs = sorted(cost for cost in costs if 0.0 < cost.error < 1.0)
    if len(runs) < 2 or not runs[0].error <= wanted <= runs[-1].error:
        return None
    error, *measures = np.log(np.array(runs)).T
    evaluations, cpu = (float(np.exp(np.interp(np.log(wanted), error, m))) for m in measures)
    return evaluations, cpu


def largest_error(timed: TimedRun, exact: Solution) -> float:
    """Largest error of a force against the largest force of its bearing."""
    if timed.forces.shape != exact.forces.shape:
        return float("inf")
    size = np.linalg.norm(exact.forces, axis=2).max(axis=0)
    return float((np.linalg.norm(timed.forces - exact.forces, axis=2) / size).max())


def measure(case: Case, exact: Solution) -> tuple[dict[str, list[Cost]], list[tuple[object, ...]]]:
    """Run everything; costs by method, and the rows of the table."""
    costs: dict[str, list[Cost]] = {}
    rows: list[tuple[object, ...]] = []
    for name, runs in RUNS.items():
        for change in runs:
            first, timed = run(case, **change), run(case, **change)
            error, cpu = rms_error(timed.forces, exact.forces), min(first.cpu, timed.cpu)
            costs.setdefault(name, []).append(Cost(error, timed.result.evaluations, cpu))
            counts = timed.result.counts
            size = change.get("tolerance", change["step"])
            told = (percent(largest_error(timed, exact)), percent(counts.largest_relative_error))
            done = (
                timed.result.evaluations,
                counts.accepted,
                f"{cpu:.3f}",
                timed.result.record.attrs["status"],
            )
            rows.append((name, f"{size:.3g}", percent(error), *told, *done))
    for method, tolerances in HOLISTIC.items():
        for rtol in tolerances:
            if (found := solve(case, method, rtol)) is not None:
                error = rms_error(found.forces, exact.forces)
                costs.setdefault(f"holistic {method}", []).append(Cost(error, found.evaluations, found.cpu))
                row = (f"holistic {method}", f"{rtol:.3g}", percent(error), "", "", found.evaluations, "")
                rows.append((*row, f"{found.cpu:.3f}", ""))
    return costs, rows


def comparison(costs: dict[str, list[Cost]]) -> str:
    """What the others take at equal error, in parts of what many rates take."""
    lines = []
    for wanted in AT:
        own = at_error(costs["multirate"], wanted)
        if own is None:
            lines.append(f"at {percent(wanted)}: multirate has no such run")
            continue
        lines.append(f"at {percent(wanted)}: multirate {own[0]:.0f} evaluations, {own[1]:.2f} s; times that")
        for name, runs in costs.items():
            other = at_error(runs, wanted)
            if name != "multirate" and other is not None:
                lines.append(f"  {name}: {other[0] / own[0]:.2f} evaluations, {other[1] / own[1]:.2f} time")
    return "\n".join(lines)


def picture(costs: dict[str, list[Cost]], title: str, path: str) -> None:
    """Draw error against evaluations and against processor time."""
    from matplotlib.figure import Figure
    from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

    figure = Figure(figsize=(9.0, 4.5), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True)
    for name, runs in costs.items():
        points = np.array(sorted(cost for cost in runs if cost.error < 1.0))
        for axes, column in zip(panels, (1, 2), strict=True):
            axes.loglog(points[:, column], 100.0 * points[:, 0], "o-", label=name)
    for axes, label in zip(panels, ("evaluations of bearings", "processor time [s]"), strict=True):
        axes.set_xlabel(label)
        axes.grid(which="both", alpha=0.3)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            axis.set_major_formatter(StrMethodFormatter("{x:g}"))
            axis.set_minor_formatter(NullFormatter())
    panels[0].set_ylabel("RMS force error [%]")
    lines, names = panels[0].get_legend_handles_labels()
    figure.legend(lines, names, loc="outside lower center", ncols=3, fontsize="small")
    figure.suptitle(title)
    figure.savefig(path)


def main(*arguments: str) -> None:
    """Print the tables of the trains, by default both, and draw what is asked for."""
    pictures = [name for name in arguments if name.endswith(".png")]
    for source in [name for name in arguments if name not in pictures] or list(WINDOWS):
        case = prepare(source, **WINDOWS[source])
        exact = reference_of(case)
        run(case, coupling="linear-implicit", step=6e-4)  # kernels and caches are warm from here on
        costs, rows = measure(case, exact)
        title = f"g. Work and precision: {source}, {case.scenario().end} s through the fracture"
        show(title, COLUMNS, rows, comparison(costs))
        for path in pictures:
            picture(costs, title, path)


if __name__ == "__main__":
    main(*sys.argv[1:])
