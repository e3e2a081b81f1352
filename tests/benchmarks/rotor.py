"""Cost of the rotor's step: ``python -m tests.benchmarks.rotor [train]``."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from rotor_fmu.reduction.reduce import METHODS, Method
from rotor_fmu.train.file import load_train
from rotor_fmu.train.train import Train
from rotor_fmu.vibration.rotor import Rotor

Result = TypeVar("Result")

STEP = 1e-4
COLUMNS = ("set up", "first step", "start", "step", "extremes", "fields")


def oil_films(train: Train) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Linear bearings of the size of oil films, F0 for a level shaft."""
    count = len(train.bearings)
    F0, K, C = np.zeros((count, 4)), np.zeros((count, 4, 4)), np.zeros((count, 4, 4))
    K[:, 0, 0], K[:, 0, 1], K[:, 1, 0], K[:, 1, 1] = 1e9, 5e8, -1.5e9, 3e9
    C[:, 0, 0], C[:, 1, 1] = 1e7, 2e7
    K[:, 2, 2] = K[:, 3, 3] = 1e7
    return F0, K, C


def least_time(call: Callable[[], object], repeats: int) -> float:
    """Least mean time of `repeats` calls over five rounds [s]: what is left when nobody disturbs."""
    best = float("inf")
    for _ in range(5):
        start = time.perf_counter()
        for _ in range(repeats):
            call()
        best = min(best, (time.perf_counter() - start) / repeats)
    return best


def timed(call: Callable[[], Result]) -> tuple[float, Result]:
    """Time of one call [s] and its result."""
    start = time.perf_counter()
    result = call()
    return time.perf_counter() - start, result


def measure(train: Train, method: Method) -> tuple[int, list[float]]:
    """Reduced size, and times [s] in the order of `COLUMNS`."""
    law = oil_films(train)
    set_up, rotor = timed(lambda: Rotor.of_train(train, reduction=method))

    def start() -> None:
        rotor.start_from_law(*law, orbit=True)

    def step() -> None:
        rotor.step(0.0, STEP, *law, train.speed)

    start()
    maps, _ = timed(step)
    times = [least_time(call, 100) for call in (start, step, rotor.extremes, rotor.fields)]
    return rotor.shaft.size, [set_up, maps, *times]


def report(train: Train) -> None:
    """Print one line a reduction."""
    print(
        f"{train.name}: {4 * train.nodes} degrees of freedom, {len(train.bearings)} bearings, H = {STEP:g} s"
    )
    print("reduction".ljust(15) + "m".rjust(6) + "".join(name.rjust(11) for name in COLUMNS) + "   [ms]")
    for method in METHODS:
        size, times = measure(train, method)
        print(f"{method:15s}{size:6d}" + "".join(f"{1e3 * t:11.3f}" for t in times))


if __name__ == "__main__":
    report(load_train(sys.argv[1] if len(sys.argv) > 1 else "turbine"))
