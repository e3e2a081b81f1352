"""Benchmark f: what a step of a mass-conserving film costs beside Guembel's and Reynolds' condition.

``python -m tests.benchmarks f``
"""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path
from time import process_time

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.film import Film, make_film
from orchestrator.results.relative_motion import film_states
from rotor_fmu.train.file import bundled_file
from tests.bearing_fmu.bearings import SPEED, TURBINE
from tests.benchmarks.runs import prepare, run
from tests.benchmarks.table import show

Array = NDArray[np.float64]

TRAIN = """\
base = "{base}"
name = "flooded"

[every_bearing]
ambient_pressure = "1 bar"
"""
"""The big train with oil at the ends of its bearings, from which a mass-conserving film lives."""

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
        best = min(best, (process_time() - begin) / (len(inputs) - 1))
    return best


def path_of(bearing: str, end: float = 0.06, lost: float = 0.01) -> tuple[Array, float]:
    """Inputs of a bearing of the big train through its blade fracture, and its least gap [m]."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "train.toml"
        base = bundled_file("turbine")
        assert base is not None
        file.write_text(TRAIN.format(base=base.as_posix()), encoding="utf-8")
        case = prepare("inertia", train=str(file), end=end, event={"time": lost}, record={"interval": STEP})
        record = run(case).result.record
    position, velocity, speed = film_states(record, bearing, 0, record.sizes["time"])
    inputs = np.concatenate((position, velocity, np.zeros((len(speed), 8)), speed[:, None]), axis=1)
    return inputs, float(record["least_gap"].sel(bearing=bearing).min())


def row(name: str, path: str, bore: str, inputs: Array) -> tuple[object, ...]:
    """Of the table."""
    times = [time_of(film_of(boundary, bore), inputs) for boundary in BOUNDARIES]
    return name, path, *(f"{1e6 * t:.0f}" for t in times), f"{times[2] / times[0]:.1f}"


def main() -> None:
    """Print the table."""
    rows: list[tuple[object, ...]] = []
    for name, bore in BORES.items():
        for swing in (0.05, 0.3):
            rows.append(row(name, f"orbit of {swing:g} C", bore, orbit(swing)))
    for bearing in ("LP1-front", "LP1-rear"):
        path, least = path_of(bearing)
        words = f"{bearing} through the fracture, least gap {1e6 * least:.1f} um"
        rows.append(row("plain, ends at 1 bar", words, "plain", path))
    show(
        "f. A step of V1, 48 x 8: force, tangent and memory, us",
        ("bore", "path", *BOUNDARIES, "jfo / guembel"),
        rows,
        "",
    )


if __name__ == "__main__":
    main()
