"""The command: errors of the input, exit statuses, and a run on the small train."""

import json
import re
import signal
import subprocess
import sysconfig
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from orchestrator.case import prepare
from orchestrator.case.request import RunRequest
from orchestrator.cli.main import app
from orchestrator.outcome import INPUT_ERROR, Outcome
from orchestrator.results.manifest import MANIFEST
from orchestrator.results.record_files import read_record
from orchestrator.results.result import Result, Timing
from rotor_fmu.train.file import load_train
from tests.faults import fault
from tests.orchestrator.results import synthetic_record

pytestmark = pytest.mark.usefixtures("counted")
SHORT = """\
train = "small"
end = 0.02
[event]
wheel = "wheel-2"
unbalance = 0.05
time = 0.01
"""


@pytest.fixture
def here(tmp_path, monkeypatch):
    """An empty working folder on a terminal wide enough not to break lines."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    monkeypatch.setenv("TERM", "dumb")
    return tmp_path


def call(*arguments):
    return CliRunner().invoke(app, list(arguments), prog_name="bladeloss")


def files(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


def start(folder, *arguments):
    """Run the installed command in a folder, as a user would."""
    command = [str(Path(sysconfig.get_path("scripts")) / "bladeloss"), *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def refused(here, *arguments):
    """Text of an input error that left nothing behind."""
    before = files(here)
    result = call(*arguments)
    assert result.exit_code == INPUT_ERROR, result.output
    assert "Traceback" not in result.output
    assert files(here) == before
    return re.sub(r"\s+", " ", re.sub(r"[│╭╮╰╯─]", " ", result.output))


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (("run", "--depth", "v9"), ("--depth", "v9", "v1")),
        (("run", "--coupling", "strong"), ("--coupling", "strong")),
        (("run", "--depth-at", "LP2-front"), ("--depth-at", "LP2-front", "NAME=DEPTH", "v1, v2, ")),
        (("run", "--depth-at", "LP2-front=v9"), ("--depth-at", "v9", "v1, v2, ")),
        (("run", "--depth-at", "LP9=v2"), ("LP9", "HP-front")),
        (("run", "--bearing", "LP9"), ("--bearing LP9", "HP-front")),
        (("run", "small", "--end", "-1"), ("end", "-1")),
        (("run", "small", "--step", "0"), ("step", "0")),
        (("run", "small", "--end", "soon"), ("--end", "number")),
        (("run", "nowhere.toml"), ("nowhere.toml", "paper")),
        (("run", "--dept", "v1"), ("--dept", "--depth")),
        (("build", "--train", "none"), ("none", "turbine")),
    ],
)
def test_wrong_arguments_are_named_with_what_is_allowed(here, arguments, named):
    text = refused(here, *arguments)
    for word in named:
        assert word in text


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("end = 0.02", "ende = 0.02", ("bad.toml", "ende", "end")),
        ("wheel-2", "wheel-9", ("bad.toml", "wheel-9", "wheel-1")),
        ("unbalance = 0.05", "unbalance = -0.05", ("bad.toml", "unbalance", "-0.05")),
        ('"small"', '"large"', ("bad.toml", "large", "turbine")),
        ("[event]", "[event", ("bad.toml", "TOML")),
    ],
)
def test_mistakes_in_a_scenario_name_file_key_and_value(here, old, new, named):
    (here / "bad.toml").write_text(SHORT.replace(old, new))
    text = refused(here, "run", "bad.toml")
    for word in named:
        assert word in text


@fault(
    "input",
    "--out that names a folder with other files in it",
    "exit 2; the folder, `no earlier result`; nothing is written",
    guard="orchestrator.case.prepare:prepare",
)
def test_alien_folders_are_not_written_to(here, monkeypatch):
    monkeypatch.setattr(prepare, "ensure_fmus", lambda *_: pytest.fail("went on"))
    (here / "thesis.tex").write_text("")
    assert "no earlier result" in refused(here, "run", "small", "--out", ".")


def test_fmus_that_cannot_be_built_are_an_input_error(here):
    (here / "taken").write_text("")
    assert "taken" in refused(here, "run", "small", "--fmus", "taken")


@pytest.fixture(scope="module")
def short_run(tmp_path_factory):
    """A short run of the small train, as a user would start it."""
    folder = tmp_path_factory.mktemp("cli")
    (folder / "short.toml").write_text(SHORT)
    done = start(folder, "run", "short.toml", "--depth-at", "rear=v2", "--out", "out", "--fmus", "fmus")
    assert done.returncode == 0, done.stderr
    return folder, done.stdout


def test_a_run_leaves_everything_and_says_where(short_run):
    folder, said = short_run
    names = (
        "all-bearings",
        "deformed-train",
        "film",
        "forces-and-moments",
        "least-gap",
        "normal-stress",
        "orbits",
        "spectra",
        "vibration-amplitude",
        "waterfall",
    )
    figures = [f"figures/{name}.png" for name in names]
    others = [MANIFEST, "record.csv", "record.nc", "scenario.toml", "summary.json", "summary.txt"]
    assert files(folder / "out") == sorted(figures + others)
    assert sorted(path.name for path in folder.iterdir()) == ["fmus", "out", "short.toml"]
    built = [name.partition("-")[0] for name in files(folder / "fmus")]
    assert built == ["bearing_v1", "bearing_v2", "rotor_small"]
    assert "Built" in said and "100 %" in said and said.rstrip().endswith("Figures in out/figures")


def test_a_run_is_what_was_asked_for(short_run):
    folder, said = short_run
    record = read_record(folder / "out")
    assert float(record["time"][-1]) == pytest.approx(0.02)
    assert dict(zip(record["bearing"].values, record["depth"].values, strict=True)) == {
        "front": "v1",
        "rear": "v2",
    }
    summary = json.loads((folder / "out" / "summary.json").read_text())
    assert summary["outcome"] == "finished" and summary["finished"] is True
    assert summary["depth"] == {"front": "v1", "rear": "v2"}
    assert summary["steps"] == record.attrs["accepted_steps"] < 200, "the default coupling has rates"
    weight = load_train("small").mass * 9.80665
    # Before the event the bearings carry the weight: mean over one revolution, unbalance averages out.
    carried = sum(row["force_mean"] for row in summary["bearings"] if row["phase"] == "before")
    assert carried == pytest.approx(weight, rel=0.02)
    reduction = record.attrs["reduction_used"]
    assert reduction == "none; the shaft has 68 degrees of freedom, 220 may be kept"
    assert record.attrs["reduction"] == "irs" and f"Reduction: {reduction}\n" in said
    assert "v1; v2 at rear" in (folder / "out" / "summary.txt").read_text()
    assert "rear v2" in said


def test_the_scenario_as_run_gives_the_same_run(short_run, monkeypatch):
    """Also in another process than the first."""
    folder, _ = short_run
    monkeypatch.chdir(folder)
    again = call("run", "out/scenario.toml", "--out", "again", "--no-figures", "--fmus", "fmus")
    assert again.exit_code == 0, again.output
    assert "Built" not in again.output and "Figures" not in again.output
    assert not (folder / "again" / "figures").exists()
    one, two = read_record(folder / "out"), read_record(folder / "again")
    np.testing.assert_array_equal(one["force"].values, two["force"].values)


def test_an_interrupted_run_keeps_what_was_simulated(short_run):
    folder, _ = short_run
    command = [str(Path(sysconfig.get_path("scripts")) / "bladeloss"), "run", "short.toml", "--end", "100"]
    with subprocess.Popen(
        [*command, "--out", "cut", "--no-figures"],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        for said in process.stdout:
            if said.startswith("time loop"):
                break
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate()
    assert process.returncode == Outcome.INTERRUPTED.status, errors
    assert "interrupted" in errors and "Traceback" not in errors
    assert not (folder / "cut").exists()
    if (folder / "cut-partial").exists():  # absent when the signal came before the second record
        assert "interrupted" in (folder / "cut-partial" / "PARTIAL.txt").read_text()


def failing(outcome, end):
    def execute(_case, _progress, _execution):
        record = synthetic_record.record(end=end)
        return Result(record, outcome, "front: the gap closed", Timing(1, 1, 1, 1, 1, 1, 1), 11000, 22000)

    return execute


def test_a_partial_run_is_marked_and_replaces_nothing(here, monkeypatch):
    monkeypatch.setattr("orchestrator.case.carry_out.execute", failing(Outcome.STEP_REFUSED, 1.1))
    monkeypatch.setattr(prepare, "ensure_fmus", lambda *_: [])
    result = call("run", "--out", "out", "--no-figures")
    assert result.exit_code == Outcome.STEP_REFUSED.status
    assert "the gap closed" in result.output
    assert [path.name for path in here.iterdir()] == ["out-partial"]
    assert (
        "step-refused at t = 1.1 s\nfront: the gap closed"
        in (here / "out-partial" / "PARTIAL.txt").read_text()
    )
    assert json.loads((here / "out-partial" / "summary.json").read_text())["finished"] is False


def test_a_run_that_never_began_leaves_nothing(here, monkeypatch):
    def execute(*_):
        import xarray as xr

        return Result(
            xr.Dataset(), Outcome.NO_EQUILIBRIUM, "front: residual", Timing(0, 0, 0, 0, 0, 0, 0), 0, 0
        )

    monkeypatch.setattr("orchestrator.case.carry_out.execute", execute)
    monkeypatch.setattr(prepare, "ensure_fmus", lambda *_: [])
    result = call("run", "small")
    assert result.exit_code == Outcome.NO_EQUILIBRIUM.status
    assert list(here.iterdir()) == []


def test_the_default_folder_names_scenario_and_depth():
    from orchestrator.scenario.file import load_scenario

    def default_folder(source, scenario):
        return prepare.result_folder_of(RunRequest(source), scenario)

    assert default_folder("small", load_scenario("small")) == Path("results/small-v1")
    mixed = load_scenario("small", {"depth": "v2", "depth_at": {"rear": "v3"}})
    assert default_folder("a/b.toml", mixed) == Path("results/b-v2-mixed")
    assert default_folder("a/b.ssp", mixed) == Path("results/b")
