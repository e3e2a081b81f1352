"""Benchmark f: what a step of a mass-conserving film costs beside Guembel's and Reynolds' condition.

``python -m tests.benchmarks f``
"""

from __future__ import annotations

from dataclasses import replace
from time import process_time

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.film import Film, make_film
from tests.bearing_fmu.bearings import SPEED, TURBINE
from tests.benchmarks.table import show

Array = NDArray[np.float64]

BOUNDARIES = ("guembel", "reynolds", "jfo")
BORES = {"plain, ends at 1 bar": "plain", "two grooves, 1.5 bar": "[[0.2, 2.94, 0, 0], [3.34, 6.08, 0, 0]]"}
STEP, STEPS, REPEATS = 1e-4, 400, 5


def film_of(boundary: str, bore: str) -> Film:
    """A bearing of the turbine with a supply."""
    ends = 1e5 if bore == "plain" else 0.0
    return make_film(
        "v1", replace(TURBINE, ambient_pressure=ends, feed_pressure=1.5e5, bore=bore, boundary=boundary)
    )


def orbit(swing: float) -> Array:
    """Inputs of the steps of a wide orbit at the speed of rotation, tilting."""
    inputs = np.zeros((STEPS, 17))
    angle = SPEED * STEP * np.arange(STEPS)
    inputs[:, 0], inputs[:, 1] = 0.3 + swing * np.cos(angle), -0.4 + swing * np.sin(angle)
    inputs[:, 4], inputs[:, 5] = -swing * SPEED * np.sin(angle), swing * SPEED * np.cos(angle)
    inputs[:, :8] *= TURBINE.clearance
    inputs[:, 2], inputs[:, 16] = 1e-4, SPEED
    return inputs


def time_of(film: Film, inputs: Array) -> float:
    """Least mean time of a step over the orbit [s]."""
    best = np.inf
    for _ in range(REPEATS):
        _, state = film.evaluate(film.rest(), inputs[0], 0.0)
        begin = process_time()
        for row in inputs[1:]:
            _, state = film.evaluate(state, row, STEP)
        best = min(best, (process_time() - begin) / (STEPS - 1))
    return best


def main() -> None:
    """Print the table."""
    rows: list[tuple[object, ...]] = []
    for name, bore in BORES.items():
        for swing in (0.05, 0.3):
            times = [time_of(film_of(boundary, bore), orbit(swing)) for boundary in BOUNDARIES]
            rows.append(
                (name, f"{swing:g}", *(f"{1e6 * t:.0f}" for t in times), f"{times[2] / times[0]:.1f}")
            )
    show(
        "f. A step of V1, 48 x 8: force, tangent and memory, us",
        ("bore", "orbit over C", *BOUNDARIES, "jfo / guembel"),
        rows,
        "",
    )


if __name__ == "__main__":
    main()
