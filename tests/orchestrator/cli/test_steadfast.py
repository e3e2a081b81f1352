"""What is said never costs a result: few letters, a closed pipe, a full disk behind standard output."""

import os
import subprocess
import sys

import pytest

from orchestrator.results.record_files import read_record
from tests.faults import fault
from tests.marks import slow
from tests.orchestrator.process import ROOT

SHORT = """
title = 'Welle $\\frac{$ µ²'
train = "small"
end = 0.004
depth = "v3"
[record]
interval = 1e-3
"""
CODE = "import sys; from orchestrator.cli.main import main; sys.argv[0] = 'bladeloss'; main()"


@fault(
    "machine",
    "standard output of ASCII letters, a pipe that is closed, a full disk",
    "the run goes to its end, its results are written, exit 0",
    guard="orchestrator.cli.steadfast:Steadfast.write",
)
@pytest.mark.parametrize("how", ["ascii", "closed", slow("full")])
def test_what_is_said_costs_no_result(how, small_fmus, tmp_path):
    (tmp_path / "s.toml").write_text(SHORT, encoding="utf-8")
    options = ["run", "s.toml", "--fmus", str(small_fmus), "--out", "out", "--no-figures"]
    reading, writing = os.pipe()
    stream = {"ascii": subprocess.DEVNULL, "closed": writing, "full": subprocess.DEVNULL}[how]
    if how == "full":
        stream = os.open("/dev/full", os.O_WRONLY)
    os.close(reading)
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "ascii", "LC_ALL": "C"}
    done = subprocess.run(
        [sys.executable, "-c", CODE, *options],
        cwd=tmp_path,
        env=environment,
        stdout=stream,
        stderr=subprocess.PIPE,
        check=False,
    )
    os.close(writing)
    assert done.returncode == 0, done.stderr.decode()
    assert read_record(tmp_path / "out").attrs["status"] == "finished"
