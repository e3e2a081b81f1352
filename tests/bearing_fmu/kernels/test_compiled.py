"""Kernels where compiled code cannot be kept: they are compiled in every process, and work."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.faults import fault

ROOT = Path(__file__).parents[3]
MODULE = """
from bearing_fmu.kernels.compiled import kernel

@kernel
def twice(x):
    return 2.0 * x
"""
MADE = """
from bearing_fmu.kernels.compiled import variant

def around(inner):
    def outer(x):
        return inner(x) + 1.0
    return variant("plus", outer)
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "kernels.py").write_text(MODULE)
    return tmp_path


def compute(folder, code="from kernels import twice; print(twice(1.5))", **environment):
    """What a process prints that uses the kernel."""
    path = os.pathsep.join([str(folder), str(ROOT)])
    given = {**os.environ, "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1", **environment}
    given.pop("NUMBA_CACHE_DIR", None)
    return subprocess.run(
        [sys.executable, "-c", code], env=given, capture_output=True, text=True, check=False
    )


@fault(
    "machine",
    "no folder that takes numba's compiled kernels: installation and home are read-only",
    "they are compiled in every process; no error",
    guard="bearing_fmu.kernels.compiled:_compile",
)
def test_nowhere_to_keep_compiled_code(folder):
    (folder / "__pycache__").write_text("a file where the folder would be")
    nowhere = {"HOME": "/proc/none", "XDG_CACHE_HOME": "/proc/none"}
    done = compute(folder, **nowhere)
    assert (done.returncode, done.stdout) == (0, "3.0\n"), done.stderr


@fault(
    "machine",
    "a full disk when numba keeps its compiled kernels",
    "they are used all the same, and compiled again in the next process; no error",
    guard="bearing_fmu.kernels.compiled:_compile",
)
def test_no_room_to_keep_compiled_code(folder):
    full = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (100, -1))\n"
    done = compute(folder, full + "from kernels import twice; print(twice(1.5))")
    assert (done.returncode, done.stdout) == (0, "3.0\n"), done.stderr
    assert not list(folder.rglob("*.nbc"))
    done = compute(folder)
    assert done.stdout == "3.0\n" and list(folder.rglob("*.nbc"))


def test_a_kernel_of_another_package_is_renewed_with_its_file(folder):
    """A depth of one's own is compiled by this package; its code is not taken from an older version."""
    assert compute(folder).stdout == "3.0\n"
    assert list(folder.rglob("*.nbc"))
    (folder / "kernels.py").write_text(MODULE.replace("2.0 * x", "4.0 * x"))
    assert compute(folder).stdout == "6.0\n"


def test_a_variant_is_renewed_with_the_kernels_that_it_is_given(folder):
    (folder / "made.py").write_text(MADE)
    around = "from kernels import twice; from made import around; print(around(twice)(1.5))"
    assert compute(folder, around).stdout == "4.0\n"
    (folder / "kernels.py").write_text(MODULE.replace("2.0 * x", "4.0 * x"))
    assert compute(folder, around).stdout == "7.0\n"
