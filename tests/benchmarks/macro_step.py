"""Benchmark c: where the time of a macro step goes on the big train, ``python -m tests.benchmarks c``."""

from __future__ import annotations

import resource
import sys

from tests.benchmarks.runs import Case, prepare, run
from tests.benchmarks.table import show

PARTS = ("film", "rotor", "fmi", "master", "record")


def peak_memory() -> float:
    """Largest resident memory of this process so far [MB]."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / 2**20 if sys.platform == "darwin" else peak / 2**10


def main(source: str = "inertia", end: float = 0.1) -> None:
    """Print the split of the time loop, as the scenario couples and with many rates."""
    for changes in ({}, {"coupling": "multirate"}):
        split(prepare(source, end=end, event={"time": 0.2 * end}, **changes))


def split(case: Case) -> None:
    """Print the split of the time loop of a case."""
    before = peak_memory()
    run(case, end=0.4 * case.scenario().end)  # compiles, and fills the caches of the rotor's maps
    timed = run(case)
    timing, steps = timed.result.timing, timed.result.steps
    rows = [
        (
            part,
            f"{1e3 * getattr(timing, part) / steps:.3f}",
            f"{100 * getattr(timing, part) / timing.loop:.1f} %",
        )
        for part in PARTS
    ]
    rows.append(("step", f"{1e3 * timing.loop / steps:.3f}", "100 %"))
    scenario = case.scenario()
    show(
        f"c. Step: scenario {case.source}, {scenario.end} s, H = {scenario.step:g} s, {scenario.coupling}, "
        f"{timed.result.record.sizes['bearing']} bearings {scenario.depth}",
        ("part", "ms a step", "share"),
        rows,
        f"{steps} steps, {timed.result.evaluations} evaluations, {timed.wall:.2f} s wall, "
        f"{timed.cpu:.2f} s processor time; "
        f"loading {timing.load:.2f} s, start {timing.equilibrium:.2f} s; "
        f"memory {before:.0f} MB before, {peak_memory():.0f} MB at the peak",
    )


if __name__ == "__main__":
    main()
