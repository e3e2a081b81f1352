"""Benchmark a: wrench and tangent of V1 against a straightforward solver at the same error.

``python -m tests.benchmarks a``
"""

from __future__ import annotations

from functools import partial
from time import process_time

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import force_unit, lever, plain, table
from tests.benchmarks.finite_volumes import UniformFilm
from tests.benchmarks.ross_bearing import compare_with_ross
from tests.benchmarks.table import least_time, percent, show

Array = NDArray[np.float64]

KERNELS = ((40, 7), (48, 8), (64, 10))
"""Columns and rows of V1."""

DEFAULT = (48, 8)

GRIDS = ((120, 16), (240, 32), (96, 96), (128, 128), (168, 168), (224, 224), (312, 312))
"""Cells of the uniform solver, around and along: two usual grids, then square ones up to V1's own error."""

ONE_PER_CENT = 0.01


def state(row: dict[str, str]) -> tuple[Array, Array]:
    """Dimensionless position and velocity of a reference case."""
    q = np.array([float(row[k]) for k in ("x", "y", "tx", "ty")])
    v = np.array([float(row[k]) for k in ("xd", "yd", "txd", "tyd")])
    return q, v


def error(wrench: Array, row: dict[str, str]) -> float:
    """Larger of the relative errors of force and moment; a moment that should vanish is left out."""
    exact = np.array([float(row[k]) for k in ("Fx_gumbel", "Fy", "Mx", "My")])
    parts = [slice(0, 2), slice(2, 4)] if np.abs(exact[2:]).max() > 1e-6 else [slice(0, 2)]
    return max(float(np.linalg.norm(wrench[p] - exact[p]) / np.linalg.norm(exact[p])) for p in parts)


def kernel(columns: int, rows: int, cases: list[dict[str, str]]) -> tuple[float, float]:
    """Worst error, and mean time of wrench with tangent [s]."""
    errors, times = [], []
    for row in cases:
        parameters = plain(float(row["L_over_D"]), columns=columns, rows=rows)
        film, (q, v) = make_film("v1", parameters), state(row)
        inputs, out, offset = np.zeros(17), np.zeros(58), np.zeros(4)
        inputs[:4], inputs[4:8], inputs[16] = q * lever(parameters), v * lever(parameters), 1.0
        times.append(least_time(partial(film.evaluate, inputs, offset, out), repeats=300))
        errors.append(error(out[:4] / force_unit(parameters), row))
    return max(errors), float(np.mean(times))


def uniform(columns: int, rows: int, cases: list[dict[str, str]]) -> tuple[float, float]:
    """Worst error, and mean time of wrench with difference tangent [s]."""
    errors, times = [], []
    for row in cases:
        film = UniformFilm(columns, rows, float(row["L_over_D"]))
        begin = process_time()
        wrench, _ = film.tangent(*state(row))
        times.append(process_time() - begin)
        errors.append(error(wrench, row))
    return max(errors), float(np.mean(times))


def speed_up(kernels: list[tuple[float, float]], grids: list[tuple[float, float]], allowed: float) -> str:
    """How much faster the cheapest V1 is than the cheapest uniform grid, both within an error."""
    fast = min((t for e, t in kernels if e <= allowed), default=float("nan"))
    slow = min((t for e, t in grids if e <= allowed), default=float("nan"))
    if fast != fast or slow != slow:
        return f"within {percent(allowed)}: not reached"
    times = f"V1 {1e6 * fast:.0f} us, uniform {1e3 * slow:.0f} ms"
    return f"within {percent(allowed)}: {times}, ratio {slow / fast:.0f}"


def main() -> None:
    """Print the table and the ratios at equal error."""
    cases = table("misaligned_guembel.csv")
    kernels = [kernel(*size, cases) for size in KERNELS]
    grids = [uniform(*size, cases) for size in GRIDS]
    rows: list[tuple[object, ...]] = []
    for name, sizes, results in (("V1", KERNELS, kernels), ("uniform volumes, splu", GRIDS, grids)):
        for (columns, count), (worst, seconds) in zip(sizes, results, strict=True):
            rows.append((f"{name} {columns} x {count}", percent(worst), f"{1e6 * seconds:.1f}"))
    default = kernels[KERNELS.index(DEFAULT)][0]
    show(
        "a. Film: wrench and 4 x 8 tangent, six misaligned cases, gap down to 0.02 C",
        ("solver", "worst error", "us a state"),
        rows,
        "\n".join(speed_up(kernels, grids, allowed) for allowed in (ONE_PER_CENT, default)),
    )
    compare_with_ross()


if __name__ == "__main__":
    main()
