"""A host without Python: starts and ends of each unit, and what must not be loaded for it to end well.

Three of each unit in the suite; ``NATIVE_HOST_STARTS=40`` in the environment takes some minutes.
V1 and V2 find this tree's packages and their compiled kernels; the others take the copies that they carry,
and V3 compiles the kernels of its own.
"""

import os
import shutil
import subprocess
import sys
import sysconfig
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from bearing_fmu import depths

SOURCE = Path(__file__).with_name("native_host.c")
REPOSITORY = Path(__file__).parents[2]
STARTS = int(os.environ.get("NATIVE_HOST_STARTS", "3"))
UNITS = ("rotor_small.fmu", "bearing_v1.fmu", "bearing_v2.fmu", "bearing_v3.fmu")
AT_HAND = ("bearing_v1.fmu", "bearing_v2.fmu")
# Bring in scipy's _uarray, with which Python 3.11 crashes in Py_FinalizeEx.
HARMFUL = ("scipy._lib._uarray", "scipy.fft", "scipy.interpolate")


FILMS = sorted({depth.film.partition(":")[0] for depth in depths.depths()})


@pytest.mark.parametrize("module", ["rotor_fmu.facade", "bearing_fmu.facade", *FILMS])
def test_no_unit_loads_what_crashes_the_end_of_python_3_11(module):
    script = f"import sys, {module}; print(*(set(sys.modules) & set({HARMFUL!r})))"
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=REPOSITORY, capture_output=True, text=True, check=True
    )
    assert not done.stdout.split()


@pytest.fixture(scope="module")
def native_host(tmp_path_factory):
    compiler = shutil.which("cc")
    if sys.platform != "linux" or not compiler:
        pytest.skip("no C compiler `cc` on Linux")
    program = tmp_path_factory.mktemp("native") / "native_host"
    subprocess.run([compiler, "-Wall", "-o", program, SOURCE, "-ldl"], check=True)
    return program


@pytest.fixture(scope="module")
def libpython():
    """The shared library of this very Python; a native host needs it in the process."""
    names = [sysconfig.get_config_var(key) for key in ("INSTSONAME", "LDLIBRARY")]
    folders = [sysconfig.get_config_var(key) for key in ("LIBDIR", "LIBPL")]
    for name in filter(None, names):
        for folder in filter(None, folders):
            if ".so" in name and (path := Path(folder) / name).is_file():
                return path
    pytest.skip("this Python is built without a shared libpython")


@pytest.fixture(scope="module")
def start_and_end(native_host, libpython, hosts):
    """Run a unit in a process of its own, from its start to its end; returns how that ended."""
    installed = [path for path in sys.path if path.endswith("site-packages")]
    environment = os.environ | {
        "LD_PRELOAD": str(libpython),
        "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        "OPENBLAS_NUM_THREADS": "1",
    }

    def run(name):
        host = hosts[name]
        library = host.folder / "binaries" / "linux64" / f"{host.description.modelName}.so"
        resources = (host.folder / "resources").as_uri()
        command = [native_host, library, resources, host.description.guid, "3"]
        paths = [str(REPOSITORY), *installed] if name in AT_HAND else installed
        given = environment | {"PYTHONPATH": os.pathsep.join(paths)}
        done = subprocess.run(command, env=given, capture_output=True, text=True, check=False)
        return done.returncode, done.stderr[-500:]

    return run


def check(start_and_end, name, times):
    first = start_and_end(name)  # alone, for it may compile
    with ThreadPoolExecutor(2) as two:
        ends = [first, *two.map(start_and_end, [name] * (times - 1))]
    assert [end for end in ends if end[0]] == []


@pytest.mark.parametrize("name", UNITS)
def test_a_native_host_ends_well(start_and_end, name):
    check(start_and_end, name, STARTS)
