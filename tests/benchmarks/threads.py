"""Benchmark e: one and two threads, ``python -m tests.benchmarks e``.

Wall time, so other work on the machine shows in it; runs alternate and the least of each counts.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from time import perf_counter

import numpy as np

from bearing_fmu.film import Film, make_film
from orchestrator.case.simulate import Execution
from tests.bearing_fmu.bearings import lever, plain
from tests.benchmarks.runs import prepare, run
from tests.benchmarks.table import show

THREADS = (1, 2)
ROUNDS = 5
EVALUATIONS = 400


def alternating(calls: dict[int, Callable[[], object]]) -> dict[int, float]:
    """Least wall time of each call over some rounds [s]."""
    least = dict.fromkeys(calls, float("inf"))
    for _ in range(ROUNDS):
        for key, call in calls.items():
            begin = perf_counter()
            call()
            least[key] = min(least[key], perf_counter() - begin)
    return least


def films() -> dict[int, float]:
    """Two films evaluated many times, one after the other and side by side: the bound for any master."""
    parameters = plain(0.8)
    inputs = np.zeros(17)
    inputs[:4], inputs[16] = np.array([0.3, -0.8, 0.02, 0.05]) * lever(parameters), 1.0
    pair = [make_film("v1", parameters) for _ in range(2)]

    def work(film: Film) -> None:
        out, offset = np.zeros(58), np.zeros(4)
        for _ in range(EVALUATIONS):
            film.solve(inputs, offset, out)

    with ThreadPoolExecutor(2) as pool:
        return alternating({1: lambda: [work(film) for film in pair], 2: lambda: list(pool.map(work, pair))})


def runs() -> dict[int, float]:
    """The big train's time loop."""
    case = prepare("inertia", end=0.04, event={"time": 0.02})
    loops: dict[int, list[float]] = {n: [] for n in THREADS}
    for _ in range(ROUNDS):
        for threads, found in loops.items():
            found.append(run(case, execution=Execution(threads=threads)).result.timing.loop)
    return {threads: min(found) for threads, found in loops.items()}


def main() -> None:
    """Print the table."""
    rows = []
    measured = {"two films, no master": films(), "big train, 0.04 s": runs()}
    for name, times in measured.items():
        rows.append((name, f"{times[1]:.3f}", f"{times[2]:.3f}", f"{times[1] / times[2]:.2f}"))
    show(f"e. Threads, on {os.cpu_count()} cores", ("what", "1 thread, s", "2 threads, s", "speed-up"), rows)


if __name__ == "__main__":
    main()
