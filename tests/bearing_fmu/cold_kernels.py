"""Compile the kernels of depths, and keep the numbers of the process that did.

``python -m tests.bearing_fmu.cold_kernels FOLDER NAME...``: before the tests, which all need the kernels, so
that the one time they are compiled anyway also shows what a process gives that compiles them. A name is that
of a depth, or of a variant, which has a kernel of its own.
"""

import hashlib
import math
import sys
from dataclasses import replace
from pathlib import Path

import numba
import numpy as np
from llvmlite import binding

from bearing_fmu.film import make_film
from bearing_fmu.kernels import compiled
from bearing_fmu.parameters import BearingParameters
from fmus.port.bore import lobes, tilting, to_text
from tests.bearing_fmu.bearings import SPEED, TURBINE

BEARING = BearingParameters(0.3, 0.2, 3e-4, 0.03, 0.0, 2e-6, 1e9, 0.1, 48, 8)
LEMON = {"bore": to_text(lobes(2, 0.5))}
PADS = {"bore": to_text(tilting(4, math.radians(80.0), 0.2))}
JFO = {"boundary": "jfo", "ambient_pressure": 1e5}
VARIANTS = {
    "v1-lemon": ("v1", LEMON),
    "v2-lemon": ("v2", LEMON),
    "v2-pads": ("v2", PADS),
}
SLOW_VARIANTS = {
    "v1-jfo": ("v1", JFO),
    "v1-jfo-lemon": ("v1", JFO | LEMON),
    "v1-pads": ("v1", PADS),
    "v1-layer": ("v1", {"layer_thickness": 5e-3}),
}
"""Of which only tests with the mark slow are."""


def path_of(folder: Path, depth: str, how: str) -> Path:
    """Where the numbers are kept of a process that `compiled` the kernels of a depth, or `found` them.

    Of these kernels, this numba and processor, at these states.
    """
    made_by = compiled._SOURCES, numba.__version__, binding.get_host_cpu_name(), Path(__file__).read_text()
    digest = hashlib.sha256(repr(made_by).encode()).hexdigest()[:16]
    return folder / f"{depth}-{how}-{digest}.npy"


def responses(depth: str) -> tuple[np.ndarray, bool]:
    """The port at 300 states drawn all over the gap, and whether its kernel was compiled for them."""
    film = make_film(depth, BEARING)
    draw = np.random.default_rng(1)
    rows = np.zeros((300, 58))
    for row in rows:
        inputs = np.zeros(17)
        reach, angle = 3e-4 * draw.uniform(0.05, 0.98), draw.uniform(0.0, 2.0 * np.pi)
        inputs[:2] = reach * np.cos(angle), reach * np.sin(angle)
        inputs[2:4], inputs[4:6], inputs[16] = 1e-5 * draw.normal(size=2), 0.01 * draw.normal(size=2), 314.0
        film.solve(inputs, np.zeros(4), row)
    return rows, bool(film.solver.kernel.stats.cache_misses)


def main(folder: str, *names: str) -> None:
    """Keep the numbers of these depths; compile these variants."""
    for depth in names:
        variant = (VARIANTS | SLOW_VARIANTS).get(depth)
        if variant is not None:
            basis, changes = variant
            make_film(basis, replace(TURBINE, **changes)).respond([1e-4, -2e-4, 0.0, 0.0], [0.0] * 4, SPEED)
            continue
        rows, cold = responses(depth)
        np.save(path_of(Path(folder), depth, "compiled" if cold else "found"), rows)


if __name__ == "__main__":
    main(*sys.argv[1:])
