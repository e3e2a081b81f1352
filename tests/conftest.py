"""What holds for all tests: BLAS on one thread, and what takes long to make is made once for all workers."""

import gc
import os

gc.disable()  # until all is imported and collected, which stays
for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")  # before numpy is loaded; for processes that tests start, too
# numba colours messages that nobody reads, of types it tries: some percent of the time in which it compiles
os.environ.setdefault("NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING", "1")

import subprocess  # noqa: E402
import sys  # noqa: E402
from collections import Counter  # noqa: E402
from contextlib import suppress  # noqa: E402
from importlib import import_module  # noqa: E402
from pathlib import Path  # noqa: E402
from pkgutil import walk_packages  # noqa: E402

import numpy  # noqa: E402, F401
import pytest  # noqa: E402
from filelock import FileLock  # noqa: E402
from threadpoolctl import threadpool_limits  # noqa: E402

try:
    import coverage
except ImportError:
    coverage = None

PROBES = None
if coverage and sys.version_info < (3, 12) and coverage.Coverage.current():
    with suppress(ImportError):  # without SlipCover all is traced
        from tests.probes import start

        PROBES = start()  # before the packages are imported
        # in a worker both coverage's own, of every process, and pytest-cov's, below that of the worker
        while running := coverage.Coverage.current():
            running.stop()

from bearing_fmu import depths  # noqa: E402
from orchestrator.fmi.folder import build  # noqa: E402
from rotor_fmu.train.file import load_train  # noqa: E402
from tests.bearing_fmu.cold_kernels import SLOW_VARIANTS, VARIANTS  # noqa: E402

threadpool_limits(1)  # where a plugin of pytest has loaded numpy before


_COUNTED = "COVERAGE_PROCESS_CONFIG"
"""By which coverage tells a process that it is to count its lines, see `counted`."""


def pytest_configure(config):
    """Compile the kernels before the workers start, which would each compile them.

    On two cores, what draws on the same kernels on the same one. Nor does each of their processes compile the
    modules that it imports, whatever the environment says.
    """
    if config.getoption("numprocesses", None) and not hasattr(config, "workerinput"):
        config.option.loadscopereorder = False  # the order is that of `pytest_collection_modifyitems`
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        command = [
            sys.executable,
            "-m",
            "tests.bearing_fmu.cold_kernels",
            str(config.cache.mkdir("cold-kernels")),
        ]
        chosen = config.getoption("markexpr")
        names = [*depths.films(), *VARIANTS] if chosen != "slow" else []
        names += SLOW_VARIANTS if chosen != "not slow" else []
        first = [name for name in names if name.startswith("v1")]
        others = [name for name in names if name not in first]
        uncounted = {name: value for name, value in os.environ.items() if name != _COUNTED}
        started = [
            subprocess.Popen([*command, *part], cwd=Path(__file__).parents[1], env=uncounted)
            for part in (first, others)
        ]
        for process in started:
            process.wait()


LONG = (
    "tests/orchestrator/study/test_compare.py",
    "tests/orchestrator/linear/test_bearing.py",
    "tests/orchestrator/commands/test_any_shaft.py",
    "tests/interop/test_tools.py",
    "tests/orchestrator/ssp/test_ssp.py",
    "tests/orchestrator/cli/test_cli.py",
    "tests/orchestrator/commands/test_linear_commands.py",
    "tests/orchestrator/fmi/test_hanging_units.py",
    "tests/orchestrator/study/ensemble/test_runs_of_a_scenario.py",
    "tests/orchestrator/fmi/test_units_that_end_the_process.py",
    "tests/orchestrator/master/test_small_train.py",
    "tests/orchestrator/commands/test_machine_faults.py",
    "tests/orchestrator/commands/test_process_faults.py",
    "tests/orchestrator/commands/test_ssp_commands.py",
    "tests/orchestrator/cli/test_steadfast.py",
    "tests/fmus/test_native_host.py",
    "tests/orchestrator/master/test_holistic.py",
    "tests/properties/test_scenarios.py",
    "tests/bearing_fmu/kernels/test_compiled.py",
    "tests/orchestrator/study/test_children.py",
    "tests/orchestrator/case/test_certify.py",
    "tests/monolithic/test_energy_of_a_revolution.py",
)
"""Files that take longest: workers begin with them, or else one works on them alone at the end."""


@pytest.hookimpl(wrapper=True)
def pytest_collection(session):
    """Where lines are counted, import all modules: what stands outside their functions runs but once.

    No line of the tests is counted: behind that the tests are collected without tracing, in half the time,
    and run without, where there are probes. What is there then stays, and is not looked through for garbage.
    """
    try:
        return (yield from _collected(session))
    finally:
        gc.freeze()
        gc.enable()


def _collected(session):
    control = getattr(session.config.pluginmanager.getplugin("_cov"), "cov_controller", None)
    if control is None or not (coverage and coverage.Coverage.current()):
        return (yield)
    if PROBES:
        control.pause()
    if os.environ.get("PYTEST_XDIST_WORKER", "gw0") == "gw0":
        for package in ("fmus", "rotor_fmu", "bearing_fmu", "orchestrator"):
            for module in walk_packages(import_module(package).__path__, f"{package}."):
                with suppress(ImportError):  # of a library that is not installed
                    import_module(module.name)
    if not PROBES:
        control.pause()
    try:
        return (yield)
    finally:
        if not PROBES:
            control.resume()


@pytest.hookimpl(wrapper=True, trylast=True)
def pytest_runtestloop(session):
    """Hand what the probes saw to pytest-cov, which saves it behind this."""
    result = yield
    control = getattr(session.config.pluginmanager.getplugin("_cov"), "cov_controller", None)
    if PROBES and control:
        control.cov.get_data().add_lines(PROBES.newly_seen)
    return result


COLLECTED = pytest.StashKey()
"""All tests, before any is left out."""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """For workers, order the files: long ones first, then those of many tests, as xdist orders them."""
    config.stash[COLLECTED] = list(items)
    if not hasattr(config, "workerinput"):
        return
    files = [item.nodeid.partition("::")[0] for item in items]
    ranks = {name: (rank, 0) for rank, name in enumerate(LONG)}
    for name, count in Counter(files).items():
        ranks.setdefault(name, (len(LONG), -count))
    order = sorted(range(len(items)), key=lambda index: (ranks[files[index]], files[index]))
    items[:] = [items[index] for index in order]


@pytest.fixture(scope="session", autouse=True)
def coverage_of_processes():
    """Keep coverage out of the processes that tests start, most of whose lines these tests run, too.

    With Python 3.11 it makes them take twice their time; `counted` ones are left.
    """
    return os.environ.pop(_COUNTED, "")


@pytest.fixture(scope="module")
def counted(coverage_of_processes):
    """Where lines are counted at all, count also those that the processes of this module run."""
    with pytest.MonkeyPatch.context() as patch:
        if coverage_of_processes:
            patch.setenv(_COUNTED, coverage_of_processes)
        yield


@pytest.fixture(scope="session")
def once(tmp_path_factory):
    """Return a function that returns a folder filled once a session, for whichever worker asks first.

    It takes the name of the folder and a function that fills it; tests do not write there.
    """
    base = tmp_path_factory.getbasetemp()
    root = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base

    def folder(name, fill):
        whole, part = root / f"once-{name}", root / f"once-{name}.part"
        with FileLock(root / f"once-{name}.lock"):
            if not whole.exists():
                part.mkdir()
                fill(part)
                part.rename(whole)
        return whole

    return folder


@pytest.fixture(scope="session")
def train_fmus(once):
    """Folder with the FMUs of the small train: its rotor and a bearing of each depth."""
    return once("train", lambda folder: build(folder, [load_train("small")]))
