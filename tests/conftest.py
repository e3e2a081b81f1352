"""What holds for all tests: BLAS on one thread, and what takes long to make is made once for all workers."""

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")  # before numpy is loaded; for processes that tests start, too

import subprocess  # noqa: E402
import sys  # noqa: E402
from pathlib import Path  # noqa: E402

import numpy  # noqa: E402, F401
import pytest  # noqa: E402
from filelock import FileLock  # noqa: E402
from threadpoolctl import threadpool_limits  # noqa: E402

from orchestrator.fmi.folder import build  # noqa: E402
from rotor_fmu.train.file import load_train  # noqa: E402

threadpool_limits(1)  # where a plugin of pytest has loaded numpy before

_COMPILE = """
from bearing_fmu import depths
from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import TURBINE
for depth in depths.films():
    make_film(depth, TURBINE).respond([1e-4, -2e-4, 1e-6, 0.0], [0.0] * 4, 157.0)
"""


def pytest_configure(config):
    """Compile the kernels before the workers start, which would each compile them.

    Nor does each of their processes compile the modules that it imports, whatever the environment says.
    """
    if config.getoption("numprocesses", None) and not hasattr(config, "workerinput"):
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        root = Path(__file__).parents[1]
        subprocess.run([sys.executable, "-c", _COMPILE], cwd=root, check=False)


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
