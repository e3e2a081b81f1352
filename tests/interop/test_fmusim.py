"""Each unit alone in fmusim, a native host: the values of fmpy, and no success without a start."""

import subprocess

import fmpy
import numpy as np
import pytest

from tests.interop.tools import REPOSITORY, missing
from tests.native import environment, libpython

H, END = 1e-4, 0.005
WATCHED = {
    "rotor_small": ("bearing[1].journal.y", "bearing[2].journal.x"),
    "bearing_v1": ("wrench.Fy", "h_min"),
    "bearing_v2": ("wrench.Fy", "h_min"),
    "bearing_v3": ("wrench.Fy", "h_min"),
}


@pytest.fixture(scope="module")
def fmusim(fmus):
    """Run a unit; returns the process and its results."""
    if missing("fmusim") or libpython() is None:
        pytest.skip(f"fmusim: {missing('fmusim') or 'this Python has no shared libpython'}")

    def run(name, out, *options):
        command = ["fmusim", "--stop-time", str(END), "--output-interval", str(H), "--logging-on", *options]
        command += ["--output-file", str(out)]
        for variable in WATCHED[name]:
            command += ["--output-variable", variable]
        command.append(str(fmus / f"{name}.fmu"))
        given = environment(str(REPOSITORY))
        done = subprocess.run(command, env=given, capture_output=True, text=True, check=False)
        return done, np.genfromtxt(out, delimiter=",", skip_header=1) if done.returncode == 0 else None

    return run


@pytest.mark.parametrize("name", WATCHED)
def test_the_values_are_those_of_fmpy(fmusim, fmus, name, tmp_path):
    done, found = fmusim(name, tmp_path / "out.csv")
    assert done.returncode == 0, done.stdout + done.stderr
    expected = fmpy.simulate_fmu(
        str(fmus / f"{name}.fmu"), stop_time=END, step_size=H, output_interval=H, output=WATCHED[name]
    )
    assert len(found) == len(expected) == round(END / H) + 1
    for column, variable in enumerate(WATCHED[name], 1):
        np.testing.assert_allclose(found[:, column], expected[variable], rtol=1e-12)


def test_a_failed_start_ends_with_its_reason(fmusim, tmp_path):
    done, _ = fmusim("bearing_v3", tmp_path / "out.csv", "--start-value", "clearance", "-1.0")
    assert done.returncode > 0
    assert "ended without a start: bearing parameter clearance = -1.0" in done.stdout + done.stderr
