"""The kernels of the bearing run as the Python they are written in: ``python -m tests.bearing_fmu.plain``.

numba compiles with sums reordered and products fused, and the vector operations are written in LLVM's
language.  Here nothing is compiled, and the vector operations are numpy, so that the two must agree to
rounding; and a debugger, or a measurement of coverage, sees every line.
"""

from __future__ import annotations

import json
import sys
from functools import partial
from pathlib import Path

import numpy as np

from bearing_fmu.kernels import compiled, vector

LANES = vector.LANES


def _sum_of_rows(sign: float, keep: bool):
    def operation(y, at, x, x_at, x_step, a, a_at, a_step, count):
        total = y[at : at + LANES].copy() if keep else np.zeros(LANES)
        for j in range(count):
            row = a_at + j * a_step
            total += sign * x[x_at + j * x_step] * a[row : row + LANES]
        y[at : at + LANES] = total

    return operation


def _tile_of_rows(sign: float, keep: bool):
    def operation(y, at, y_next, part, part_at, x, x_at, x_step, x_next, a, a_at, a_step, count):
        totals = np.zeros((vector.TILE, LANES))
        for r, total in enumerate(totals):
            to = at + r * y_next
            if keep:
                total += y[to : to + LANES] * part[part_at : part_at + LANES]
            for j in range(count):
                row = a_at + j * a_step
                total += sign * x[x_at + j * x_step + r * x_next] * a[row : row + LANES]
        for r, total in enumerate(totals):
            to = at + r * y_next
            y[to : to + LANES] = total

    return operation


def _product(sign: float, keep: bool = True):
    def operation(y, at, a, a_at, b, b_at):
        product = sign * a[a_at : a_at + LANES] * b[b_at : b_at + LANES]
        y[at : at + LANES] = y[at : at + LANES] + product if keep else product

    return operation


OPERATIONS = {
    "set_rows": _sum_of_rows(1.0, keep=False),
    "add_rows": _sum_of_rows(1.0, keep=True),
    "subtract_rows": _sum_of_rows(-1.0, keep=True),
    "set_tile": _tile_of_rows(1.0, keep=False),
    "subtract_tile": _tile_of_rows(-1.0, keep=True),
    "set_product": _product(1.0, keep=False),
    "add_product": _product(1.0),
    "subtract_product": _product(-1.0),
}


def _with_names(take):
    """A work space, and what a kernel takes in it, with constants whose fields are attributes."""
    space, (constants, *rest) = take()
    return space, (constants.view(np.recarray), *rest)


def told(film, inputs, step):
    """Status and outputs of a film at rest, or at the end of the second of two steps of this length."""
    out = np.full(58, np.nan)
    if step is None:
        return film.solve(inputs, np.zeros(4), out), out
    later = inputs.copy()
    later[:4] += step * inputs[4:8]
    _, state = film.evaluate(film.rest(), inputs, step)
    return 0, film.evaluate(state, later, step)[0][: len(out)]


def main(states: Path, out: Path) -> None:
    """Evaluate the states of a JSON file, each with depth and parameters; write status and outputs."""
    compiled._compile = lambda function, _options: function
    for name, operation in OPERATIONS.items():
        setattr(vector, name, operation)
    from bearing_fmu.film import make_film
    from bearing_fmu.parameters import BearingParameters

    results = []
    np.seterr(all="ignore")  # as compiled: what is not finite is found at the end
    for case in json.loads(states.read_text()):
        film = make_film(case["depth"], BearingParameters(**case["parameters"]))
        film.take = partial(_with_names, film.take)
        status, outputs = told(film, np.array(case["inputs"]), case["step"])
        results.append([float(status), *outputs])
    np.save(out, np.array(results))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
