"""Kernels where compiled code cannot be kept: they are compiled in every process, and work."""

import os
import shutil
import subprocess
import sys
from importlib.util import module_from_spec, spec_from_file_location
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
    guard="fmus.kernels.kept:keep_safely",
)
def test_no_room_to_keep_compiled_code(folder):
    full = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (100, -1))\n"
    done = compute(folder, full + "from kernels import twice; print(twice(1.5))")
    assert (done.returncode, done.stdout) == (0, "3.0\n"), done.stderr
    assert not list(folder.rglob("*.nbc"))
    done = compute(folder)
    assert done.stdout == "3.0\n" and list(folder.rglob("*.nbc"))


@pytest.mark.parametrize("ending", ["*.nbi", "*.nbc"])
@pytest.mark.parametrize("damage", ["empty", "zeros", "cut short", "a bit flipped"])
@fault(
    "machine",
    "a compiled kernel on disk that is damaged, as after a power loss",
    "it is compiled and kept anew; no error, no wrong number",
    guard="fmus.kernels.kept:_read",
)
def test_a_damaged_kernel_is_compiled_anew(folder, kept, ending, damage):
    shutil.copytree(kept, folder / "__pycache__")
    (path,) = folder.rglob(ending)
    whole = path.read_bytes()
    flipped = bytearray(whole)
    flipped[len(whole) // 2] ^= 1
    damaged = {"empty": b"", "zeros": bytes(len(whole)), "cut short": whole[: len(whole) // 2]}
    path.write_bytes(damaged.get(damage, flipped))
    kernels = compiled_here(folder)
    assert kernels.twice(1.5) == 3.0 and kernels.twice.stats.cache_misses
    again = compiled_here(folder)
    assert again.twice(1.5) == 3.0 and again.twice.stats.cache_hits


def compiled_here(folder):
    """The module in the folder, imported anew into this process."""
    spec = spec_from_file_location("kernels", folder / "kernels.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """What is kept of a kernel."""
    folder = tmp_path_factory.mktemp("kept")
    (folder / "kernels.py").write_text(MODULE)
    assert compiled_here(folder).twice(1.5) == 3.0
    return folder / "__pycache__"


def test_processes_that_keep_kernels_at_once_do_not_mix_them(folder):
    """Unlike signatures of one function, whose files numba numbers: each index entry has its own code."""
    code = "import sys; from kernels import twice; print(twice(complex(3) if sys.argv[1] == 'c' else 1.5))"
    given = {**os.environ, "PYTHONPATH": os.pathsep.join([str(folder), str(ROOT)])}
    given.pop("NUMBA_CACHE_DIR", None)
    for _ in range(2):  # cold, then from what was kept
        started = [
            subprocess.Popen([sys.executable, "-c", code, kind], env=given, stdout=subprocess.PIPE, text=True)
            for kind in ("c", "f")
        ]
        said = [process.communicate()[0].strip() for process in started]
        assert said == ["(6+0j)", "3.0"]


def test_numba_switched_off(folder):
    """The kernels are compiled all the same: those of the films cannot run otherwise."""
    assert compute(folder, NUMBA_DISABLE_JIT="1").stdout == "3.0\n"
    assert list(folder.rglob("*.nbc"))


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


def test_a_numba_with_other_inner_parts(tmp_path):
    """Inner kernels are then compiled as any other."""
    code = """
from numba.core.codegen import CPUCodeLibrary as library
kept = library._verify_declare_only_symbols
del library._verify_declare_only_symbols
from bearing_fmu.kernels import compiled
library._verify_declare_only_symbols = kept
from inner import thrice
print(compiled.PARTS, thrice(1.5))
"""
    (tmp_path / "inner.py").write_text(
        "from bearing_fmu.kernels.compiled import inner_kernel, kernel\n\n"
        "@inner_kernel\ndef twice(x):\n    return 2.0 * x\n\n"
        "@kernel\ndef thrice(x):\n    return x + twice(x)\n"
    )
    done = compute(tmp_path, code)
    assert (done.returncode, done.stdout) == (0, "{} 4.5\n"), done.stderr
