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


def process(folder, names, **environment):
    """Let a process keep the numbers of these depths."""
    given = os.environ | {"PYTHONPATH": str(ROOT)} | environment
    subprocess.run([sys.executable, "-m", cold_kernels.__name__, str(folder), *names], env=given, check=True)


@pytest.fixture(scope="module")
def folder(request, tmp_path_factory):
    """The numbers of one process that compiles, and of one that does not."""
    folder, names = request.config.cache.mkdir("cold-kernels"), depths.films()
    cold = [name for name in names if not cold_kernels.path_of(folder, name, "compiled").exists()]
    if cold:  # else conftest.py did it, before these tests
        cache = str(tmp_path_factory.mktemp("kernels"))
        process(folder, cold, NUMBA_CACHE_DIR=cache)
        process(folder, cold, NUMBA_CACHE_DIR=cache)
    kept = [name for name in names if name not in cold]
    for name in kept:
        cold_kernels.path_of(folder, name, "found").unlink(missing_ok=True)
    if kept:
        process(folder, kept)
    return folder


@pytest.mark.parametrize("depth", depths.films())
def test_a_cold_cache_changes_no_bit(depth, folder):
    cold, warm = (np.load(cold_kernels.path_of(folder, depth, how)) for how in ("compiled", "found"))
    assert np.any(cold != 0.0)
    assert np.array_equal(cold, warm)
