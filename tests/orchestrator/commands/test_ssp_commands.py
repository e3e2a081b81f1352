"""SSP on the command line: out of a scenario, and back into a run."""

import json
import shutil
import signal
import time

import numpy as np
import pytest
from typer.testing import CliRunner

from orchestrator.case.checkpoint_folder import checkpoint_folder
from orchestrator.cli.main import app
from orchestrator.observers import checkpoint
from orchestrator.outcome import INPUT_ERROR
from orchestrator.results.record_files import read_record
from tests.faults import fault
from tests.orchestrator.process import command

SCENARIO = """\
train = "small"
depth = "v3"
end = 0.01
"""


def call(*arguments):
    return CliRunner().invoke(app, [str(a) for a in arguments], prog_name="bladeloss", env={"COLUMNS": "200"})


@pytest.fixture(scope="module")
def exported(small_fmus, tmp_path_factory):
    """Folder with short.toml, short.ssp and short_force.ssp."""
    folder = tmp_path_factory.mktemp("command")
    (folder / "short.toml").write_text(SCENARIO)
    out = call("export-ssp", folder / "short.toml", "--out", folder / "short.ssp", "--fmus", small_fmus)
    assert out.exit_code == 0, out.output
    assert "affine law" in out.output and "force only" in out.output
    return folder


@pytest.fixture(scope="module")
def both(exported, small_fmus):
    """Folders of a run of the export and of one of the scenario, both certified."""
    options = ("--no-figures", "--fmus", small_fmus, "--trust", "--certify")
    for source, out in (("short.ssp", "ssp"), ("short.toml", "direct")):
        ran = call("run", exported / source, *options, "--out", exported / out)
        assert ran.exit_code == 0, ran.output
    return exported / "ssp", exported / "direct"


def test_a_run_of_the_export_is_the_run_of_the_scenario(both):
    back, direct = map(read_record, both)
    np.testing.assert_array_equal(back["force"].values, direct["force"].values)
    assert back.attrs["ssp"].startswith("short.ssp sha256 ")


def test_an_export_has_the_certificate_and_ledger_of_the_scenario(both):
    summaries = [json.loads((folder / "summary.json").read_text()) for folder in both]
    certified = [(summary["certificate"], summary["ledger"]) for summary in summaries]
    assert certified[0][0]["differences"] and certified[0][1]["unbalance"] > 0.0
    assert certified[0] == certified[1]


def checkpoint_time(folder):
    return checkpoint.read(folder).time if (folder / checkpoint.FILE).is_file() else 0.0


LONG = ("--step", "1e-6", "--end", "2e-3")
"""Enough steps to be killed in their midst."""


@pytest.fixture(scope="module")
def killed(exported, small_fmus, tmp_path_factory):
    """Folder with an SSP, whose run was killed behind its first checkpoint in the time loop."""
    folder = tmp_path_factory.mktemp("killed")
    shutil.copy(exported / "short.ssp", folder / "mine.ssp")
    options = (
        "--fmus",
        small_fmus,
        "--out",
        folder / "out",
        "--no-figures",
        "--trust",
        "--checkpoint",
        "2e-4",
    )
    process = command("run", folder / "mine.ssp", *options, *LONG)
    saved = checkpoint_folder(folder / "out")
    while process.poll() is None and not (saved.is_dir() and checkpoint_time(saved) > 0.0):
        time.sleep(0.02)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    assert process.returncode == -signal.SIGKILL and 0.0 < checkpoint_time(saved) < 2e-3
    return folder


@fault(
    "process",
    "a checkpoint of an SSP that has changed since",
    "exit 2; both digests, `put that file back, or start anew`; the checkpoint is kept",
    guard="orchestrator.case.prepare:_ssp_case",
)
def test_a_run_of_another_ssp_is_not_resumed(exported, killed):
    shutil.copy(exported / "short_force.ssp", killed / "mine.ssp")
    resumed = call("resume", killed / "out")
    shutil.copy(exported / "short.ssp", killed / "mine.ssp")
    assert resumed.exit_code == INPUT_ERROR, resumed.output
    assert "made with another" in resumed.stderr and "mine.ssp (sha256 " in resumed.stderr
    assert resumed.stderr.count("\n") == 1 and not (killed / "out").exists()
    assert checkpoint_folder(killed / "out").exists()


def test_a_killed_run_goes_on_to_the_same_record(killed, small_fmus):
    options = ("--fmus", small_fmus, "--no-figures", "--trust", *LONG)
    whole = call("run", killed / "mine.ssp", *options, "--out", killed / "whole")
    assert whole.exit_code == 0, whole.output
    resumed = call("resume", killed / "out")
    assert resumed.exit_code == 0, resumed.output
    assert "Going on from t = 0.00" in resumed.output
    assert read_record(killed / "out").identical(read_record(killed / "whole"))
    assert not checkpoint_folder(killed / "out").exists()


@pytest.mark.parametrize(
    "arguments, words",
    [
        (("export-ssp", "short.toml", "--out", "short.zip"), ("--out short.zip", "ends in .ssp")),
        (("export-ssp", "shorter.toml"), ("no such scenario",)),
        (("run", "short.ssp", "--depth", "v2"), ("--depth is for scenarios", "--end, --step, --coupling")),
        (("run", "short.ssp", "--bearing", "raer", "--trust"), ("raer", "front, rear")),
        (("run", "none.ssp"), ("none.ssp", "no such file")),
    ],
    ids=["suffix", "no scenario", "foreign option", "no bearing", "no file"],
)
def test_what_is_wrong_is_said_and_nothing_written(arguments, words, exported, small_fmus, monkeypatch):
    monkeypatch.chdir(exported)
    before = sorted(exported.rglob("*"))
    refused = call(*arguments, "--fmus", small_fmus)
    assert refused.exit_code == INPUT_ERROR, refused.output
    assert all(word in " ".join(refused.output.split()) for word in words), refused.output
    assert sorted(exported.rglob("*")) == before
