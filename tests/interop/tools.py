"""Other tools as subprocesses, so that a crash of one is a failed test and no more."""

import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

LIBRARIES = {
    "fmpy": "fmpy",
    "libcosim": "libcosimpy.CosimExecution",
    "ecos": "ecospy",
    "pyfmi": "pyfmi.master",
}
NATIVE = {"omsimulator": "OMSimulator", "fmusim": "fmusim"}
"""Commands, native hosts."""

LAG = {"fmpy": 0, "libcosim": 1, "ecos": 1, "pyfmi": 1, "omsimulator": 1}
"""Steps by which a bearing's outputs come late: these tools step all units at once."""

TOOLS = ("fmpy", "libcosim", "ecos")
"""Those that pip installs."""

RARE = ("pyfmi", "omsimulator")
"""Those that have to be built; the tests that concern them are left out without them."""

REPOSITORY = Path(__file__).parents[2]


@cache
def missing(tool: str) -> str:
    """Why a tool cannot run here; empty if it can."""
    if tool in NATIVE:
        return "" if shutil.which(NATIVE[tool]) else f"no command {NATIVE[tool]}"
    command = [sys.executable, "-c", f"import {LIBRARIES[tool]}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stderr.strip().splitlines()[-1] if done.returncode else ""


def start(tool: str, ssp: Path, step: float, end: float, out: Path) -> subprocess.CompletedProcess:
    """Run an SSP in a tool; skips the test where the tool is not there."""
    if missing(tool):
        pytest.skip(f"{tool}: {missing(tool)}")
    command = [sys.executable, "-m", f"tests.interop.run_{tool}", str(ssp), repr(step), repr(end), str(out)]
    return subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=False, timeout=1200)


def forces(tool: str, ssp: Path, step: float, end: float, out: Path) -> dict[str, np.ndarray]:
    """Forces (steps, 2) of each component after each step, without the tool's lag."""
    done = start(tool, ssp, step, end, out)
    said = done.stdout[-2000:] + done.stderr[-2000:]
    assert done.returncode == 0, f"{tool} ended with {done.returncode}: {said}"
    with np.load(out) as file:
        return {str(n): file["forces"][:, i] for i, n in enumerate(file["names"])}
