"""A host without Python: starts and ends of each unit, and what must not be loaded for it to end well.

Three of each unit in the suite; ``NATIVE_HOST_STARTS=40`` in the environment takes some minutes.
V1 and V2 find this tree's packages and their compiled kernels; the others take the copies that they carry,
and V3 compiles the kernels of its own.
"""

import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from bearing_fmu import depths
from tests.marks import slow
from tests.native import environment, libpython

SOURCE = Path(__file__).with_name("native_host.c")
REPOSITORY = Path(__file__).parents[2]
STARTS = int(os.environ.get("NATIVE_HOST_STARTS", "3"))
UNITS = ("rotor_small.fmu", "bearing_v1.fmu", "bearing_v2.fmu", "bearing_v3.fmu")
AT_HAND = ("bearing_v1.fmu", "bearing_v2.fmu")
# Bring in scipy's _uarray, with which Python 3.11 crashes in Py_FinalizeEx.
HARMFUL = ("scipy._lib._uarray", "scipy.fft", "scipy.interpolate")


LONG = ("bearing_v1.fmu", "bearing_v3.fmu")
FILMS = sorted({depth.film.partition(":")[0] for depth in depths.depths()})


def test_no_unit_loads_what_crashes_the_end_of_python_3_11():
    """Rotor, bearing, and each film, one after the other."""
    modules = ("rotor_fmu.facade", "bearing_fmu.facade", *FILMS)
    script = "import sys\n" + "".join(
        f"import {module}\nprint([name for name in {HARMFUL!r} if name in sys.modules])\n"
        for module in modules
    )
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=REPOSITORY, capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines() == ["[]"] * len(modules)


@pytest.fixture(scope="module")
def native_host(tmp_path_factory):
    compiler = shutil.which("cc")
    if sys.platform != "linux" or not compiler:
        pytest.skip("no C compiler `cc` on Linux")
    program = tmp_path_factory.mktemp("native") / "native_host"
    subprocess.run([compiler, "-Wall", "-o", program, SOURCE, "-ldl"], check=True)
    return program


@pytest.fixture(scope="module")
def start_and_end(native_host, hosts):
    """Run a unit in a process of its own, from its start to its end; returns how that ended."""
    if libpython() is None:
        pytest.skip("this Python is built without a shared libpython")

    def run(name, *settings):
        host = hosts[name]
        library = host.folder / "binaries" / "linux64" / f"{host.description.modelName}.so"
        resources = (host.folder / "resources").as_uri()
        command = [native_host, library, resources, host.description.guid, "3", *settings]
        given = environment(*[str(REPOSITORY)] * (name in AT_HAND))
        done = subprocess.run(command, env=given, capture_output=True, text=True, check=False)
        return done.returncode, done.stderr[-500:]

    return run


EXIT_INITIALIZATION, STEP, SET = 4, 5, 7  # what the host ends with


@pytest.mark.parametrize(
    ("variable", "value", "when", "end", "said"),
    [
        ("clearance", "-1.0", (), EXIT_INITIALIZATION, "ended without a start: bearing parameter clearance"),
        ("clearance", "1e-3", ("late",), SET, "clearance cannot be set after initialization"),
        ("wrench.Fx", "1.0", ("late",), SET, "wrench.Fx cannot be set after initialization"),
        ("99999", "1.0", (), SET, "cannot be set at all"),
        ("journal.y", "1.0", ("late",), STEP, "refused"),
    ],
)
def test_what_fails_is_no_ok_and_crashes_no_native_host(
    start_and_end, hosts, variable, value, when, end, said
):
    """Not in the host that frees the instance of a failed call either, of which pythonfmu lets go twice."""
    references = {v.name: v.valueReference for v in hosts["bearing_v2.fmu"].description.modelVariables}
    settings = (str(references.get(variable, variable)), value, *when)
    found, log = start_and_end("bearing_v2.fmu", *settings)
    assert found == end, log
    assert said in log


def check(start_and_end, name, times):
    first = start_and_end(name)  # alone, for it may compile
    with ThreadPoolExecutor(2) as two:
        ends = [first, *two.map(start_and_end, [name] * (times - 1))]
    assert [end for end in ends if end[0]] == []


@pytest.mark.parametrize("name", [slow(name) if name in LONG else name for name in UNITS])
def test_a_native_host_ends_well(start_and_end, name):
    check(start_and_end, name, STARTS)
