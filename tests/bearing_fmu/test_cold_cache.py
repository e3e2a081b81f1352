"""The numbers of a process that compiles the kernels, and of one that finds them compiled."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from bearing_fmu import depths
from tests.bearing_fmu import cold_kernels

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("depth", depths.films())
def test_a_cold_cache_changes_no_bit(depth, request, tmp_path):
    folder = request.config.cache.mkdir("cold-kernels")
    given = os.environ | {"PYTHONPATH": str(ROOT)}

    def process():
        command = [sys.executable, "-m", cold_kernels.__name__, str(folder), depth]
        subprocess.run(command, env=given, check=True)

    if not cold_kernels.path_of(folder, depth, "compiled").exists():
        given["NUMBA_CACHE_DIR"] = str(tmp_path)
        process()  # else conftest.py did it, before these tests
    cold_kernels.path_of(folder, depth, "found").unlink(missing_ok=True)
    process()
    cold, warm = (np.load(cold_kernels.path_of(folder, depth, how)) for how in ("compiled", "found"))
    assert np.any(cold != 0.0)
    assert np.array_equal(cold, warm)
