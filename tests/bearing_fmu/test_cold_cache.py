"""The numbers of a process that compiles the kernels, and of one that finds them compiled."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
STATES = """
import sys
import numpy as np
from bearing_fmu.film import make_film
from bearing_fmu.parameters import BearingParameters

film = make_film(sys.argv[1], BearingParameters(0.3, 0.2, 3e-4, 0.03, 0.0, 2e-6, 1e9, 0.1, 48, 8))
draw = np.random.default_rng(1)
rows = np.zeros((300, 52))
for row in rows:
    inputs = np.zeros(17)
    reach, angle = 3e-4 * draw.uniform(0.05, 0.98), draw.uniform(0.0, 2.0 * np.pi)
    inputs[:2] = reach * np.cos(angle), reach * np.sin(angle)
    inputs[2:4], inputs[4:6], inputs[16] = 1e-5 * draw.normal(size=2), 0.01 * draw.normal(size=2), 314.0
    film.solve(inputs, np.zeros(4), row)
np.save(sys.argv[2], rows)
"""


@pytest.mark.parametrize(
    "depth", ["v3", pytest.param("v2", marks=pytest.mark.slow), pytest.param("v1", marks=pytest.mark.slow)]
)
def test_a_cold_cache_changes_no_bit(depth, tmp_path):
    found = []
    for name in ("cold.npy", "warm.npy"):
        given = {**os.environ, "PYTHONPATH": str(ROOT), "NUMBA_CACHE_DIR": str(tmp_path / "kernels")}
        subprocess.run([sys.executable, "-c", STATES, depth, str(tmp_path / name)], env=given, check=True)
        found.append(np.load(tmp_path / name))
    assert np.any(found[0] != 0.0)
    assert np.array_equal(found[0], found[1])
