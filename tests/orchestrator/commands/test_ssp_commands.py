"""SSP on the command line: out of a scenario, and back into a run."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

from orchestrator import exit_status
from orchestrator.cli.main import app
from orchestrator.results.record_files import read_record

SCENARIO = """\
train = "small"
depth = "v3"
end = 0.01
"""


def call(*arguments):
    return CliRunner().invoke(app, [str(a) for a in arguments], prog_name="bladeloss", env={"COLUMNS": "200"})


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    """Folder with short.toml, short.ssp, short_force.ssp and the FMUs they were made with."""
    folder = tmp_path_factory.mktemp("command")
    (folder / "short.toml").write_text(SCENARIO)
    done = call("export-ssp", folder / "short.toml", "--out", folder / "short.ssp", "--fmus", folder / "fmus")
    assert done.exit_code == 0, done.output
    assert "affine law" in done.output and "force only" in done.output
    return folder


def test_a_run_of_the_export_is_the_run_of_the_scenario(exported, tmp_path):
    options = ("--no-figures", "--fmus", exported / "fmus", "--trust")
    for source, out in (("short.ssp", "ssp"), ("short.toml", "direct")):
        done = call("run", exported / source, *options, "--out", tmp_path / out)
        assert done.exit_code == 0, done.output
    back, direct = read_record(tmp_path / "ssp"), read_record(tmp_path / "direct")
    np.testing.assert_array_equal(back["force"].values, direct["force"].values)
    assert back.attrs["ssp"].startswith("short.ssp sha256 ")


def test_an_export_has_the_certificate_and_ledger_of_the_scenario(exported, tmp_path):
    options = ("--no-figures", "--fmus", exported / "fmus", "--trust", "--certify")
    certified = []
    for source, out in (("short.ssp", "ssp"), ("short.toml", "direct")):
        done = call("run", exported / source, *options, "--out", tmp_path / out)
        assert done.exit_code == 0, done.output
        summary = json.loads((tmp_path / out / "summary.json").read_text())
        certified.append((summary["certificate"], summary["ledger"]))
    assert certified[0][0]["differences"] and certified[0][1]["unbalance"] > 0.0
    assert certified[0] == certified[1]


@pytest.mark.parametrize(
    "arguments, words",
    [
        (("export-ssp", "short.toml", "--out", "short.zip"), ("--out short.zip", "ends in .ssp")),
        (("export-ssp", "shorter.toml"), ("no such scenario",)),
        (("run", "short.ssp", "--depth", "v2"), ("--depth is for scenarios", "--end, --step, --coupling")),
        (("run", "short.ssp", "--bearing", "raer", "--trust"), ("raer", "front, rear")),
        (("run", "short.ssp", "--checkpoint", "0.1"), ("--checkpoint", "SSP cannot be resumed")),
        (("run", "none.ssp"), ("none.ssp", "no such file")),
    ],
    ids=["suffix", "no scenario", "foreign option", "no bearing", "no resuming", "no file"],
)
def test_what_is_wrong_is_said_and_nothing_written(arguments, words, exported, monkeypatch):
    monkeypatch.chdir(exported)
    before = sorted(exported.rglob("*"))
    done = call(*arguments, "--fmus", exported / "fmus")
    assert done.exit_code == exit_status.INPUT_ERROR, done.output
    assert all(word in " ".join(done.output.split()) for word in words), done.output
    assert sorted(exported.rglob("*")) == before
