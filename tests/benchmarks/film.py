"""Speed and accuracy of the film: ``python -m tests.benchmarks.film``.

Prints the time of one evaluation of the port (wrench, tangent and all outputs) on one core, and the worst
error over the independent solutions of tilted films, for several resolutions.
"""

from __future__ import annotations

import argparse
import time

import numpy as np

from bearing_fmu.film import Film, make_film
from bearing_fmu.parameters import BearingParameters
from tests.bearing_fmu.bearings import SPEED, TURBINE, lever
from tests.bearing_fmu.films.test_published_films import MISALIGNED, misaligned_error

RESOLUTIONS = ((32, 6), (40, 8), (48, 8), (48, 10), (64, 8), (64, 10), (96, 12))
OPEN = (0.2, -0.78, 0.05, 0.04)
CONTACT = (0.2, -0.9, 0.085, 0.02)


def microseconds(film: Film, q: tuple[float, ...], rounds: int, calls: int = 100) -> tuple[float, float]:
    """Median and least processor time of an evaluation over `rounds` of `calls`, us."""
    inputs, offset, out = np.zeros(17), np.zeros(4), np.empty(58)
    inputs[:4] = np.asarray(q) * lever(film.parameters)
    inputs[4:8] = 0.02 * SPEED * lever(film.parameters)
    inputs[16] = SPEED
    if film.solve(inputs, offset, out) != 0:
        raise RuntimeError("the benchmark's state has no response")
    times = []
    for _ in range(rounds):
        start = time.thread_time()
        for _ in range(calls):
            film.solve(inputs, offset, out)
        times.append((time.thread_time() - start) / calls * 1e6)
    return float(np.median(times)), min(times)


def refined(columns: int, rows: int) -> BearingParameters:
    """The turbine's bearing at another resolution."""
    values = {name: getattr(TURBINE, name) for name in TURBINE.__dataclass_fields__}
    return BearingParameters(**values | {"columns": columns, "rows": rows})


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=30, help="rounds of 100 calls for each figure")
    rounds = parser.parse_args().rounds
    print("time of an evaluation with tangent, us: median (least)")
    print(f"{'depth':6}{'columns x rows':>16}{'open film':>20}{'edge in contact':>20}", end="")
    print(f"{'force error':>14}{'moment error':>14}")
    for columns, rows in RESOLUTIONS:
        film = make_film("v1", refined(columns, rows))
        cells = [
            f"{t:.1f} ({least:.1f})" for t, least in (microseconds(film, q, rounds) for q in (OPEN, CONTACT))
        ]
        errors = np.array([misaligned_error(row, (columns, rows)) for row in MISALIGNED]).max(axis=0)
        print(f"{'v1':6}{f'{columns} x {rows}':>16}{cells[0]:>20}{cells[1]:>20}", end="")
        print("".join(f"{100 * e:>13.2f}%" for e in errors))
    for depth in ("v2", "v3"):
        t, least = microseconds(make_film(depth, TURBINE), OPEN, rounds)
        print(f"{depth:6}{'48 x 8' if depth == 'v2' else '-':>16}{f'{t:.1f} ({least:.1f})':>20}")


if __name__ == "__main__":
    main()
