"""``bladeloss compare``: on the small train, with a finer check, with runs that die, with wrong input."""

import csv
import io
import json
import re
import subprocess
import sys

import pytest
from rich.console import Console
from typer.testing import CliRunner

from orchestrator.cli.main import app
from orchestrator.commands import compare as compare_command
from orchestrator.commands.compare import CompareRequest
from orchestrator.outcome import INPUT_ERROR, PROCESS_DIED, Outcome
from orchestrator.results.manifest import MANIFEST
from orchestrator.results.record_files import read_record
from orchestrator.scenario.file import load_scenario, train_of
from orchestrator.study.compare import COMPARED, fitting, refine

SHORT = """\
title = "Short"
train = "small"
analysed_bearing = "rear"
end = 0.05
[event]
wheel = "wheel-2"
unbalance = 0.05
time = 0.04
"""
DEPTHS = ("v1", "v3")
RUN = [MANIFEST, "record.csv", "record.nc", "scenario.toml", "summary.json", "summary.txt"]
FIGURES = [
    "all-bearings.png",
    "deformed-train.png",
    "film.png",
    "forces-and-moments.png",
    "least-gap.png",
    "normal-stress.png",
    "orbits.png",
    "spectra.png",
    "vibration-amplitude.png",
    "waterfall.png",
]


def files(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


@pytest.fixture(scope="module")
def compared(tmp_path_factory):
    """A short comparison with its check, as a user would start it."""
    folder = tmp_path_factory.mktemp("compare")
    (folder / "short.toml").write_text(SHORT)
    command = [sys.executable, "-P", "-m", "orchestrator.cli.main", "compare", "short.toml", "--check"]
    command += ["--doublings", "1"]
    command += [word for depth in DEPTHS for word in ("--depth", depth)]
    command += ["--columns", "24", "--rows", "4", "--step", "2e-4", "--out", "out", "--fmus", "fmus"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder, done.stdout


def test_a_comparison_leaves_table_figures_and_runs(compared):
    folder, said = compared
    runs = [f"{depth}/{name}" for depth in DEPTHS for name in RUN]
    others = [MANIFEST, "comparison.csv", "comparison.json", "comparison.txt"] + [
        f"figures/{name}" for name in FIGURES
    ]
    expected = others + [name for run in (*runs, COMPARED) for name in (run, f"check/48x8-0.1ms/{run}")]
    assert files(folder / "out") == sorted(expected)
    assert sorted(path.name for path in folder.iterdir()) == ["fmus", "out", "short.toml"]
    for depth in DEPTHS:
        assert re.search(rf"{depth}  100 %|{depth}   100 %|{depth}  finished", said)
        record = read_record(folder / "out" / depth)
        assert set(record["depth"].values) == {depth}
        assert record.attrs["analysed_bearing"] == "rear"
    assert said.rstrip().endswith("Results in out")


def test_the_check_is_finer_and_told(compared):
    folder, _ = compared
    data = json.loads((folder / "out" / "comparison.json").read_text())
    assert data["settings"] == {"macro_step": 2e-4, "columns": 24, "film_rows": 4, "end": 0.05}
    assert [one["settings"] for one in data["check"]] == [
        {"macro_step": 1e-4, "columns": 48, "film_rows": 8, "end": 0.05}
    ]
    text = (folder / "out" / "comparison.txt").read_text()
    assert "Check: film 48 x 8, macro step 0.1 ms in place of film 24 x 4, macro step 0.2 ms" in text
    force = next(item for item in data["check"][0]["changes"] if item["figure"] == "bearing force, mean")
    assert 0 < abs(force["largest"]) < 1e-3  # the weight is the weight


def test_depths_stand_beside_one_another(compared):
    """Every figure is that of the run's own summary; differences are those to the first depth."""
    folder, _ = compared
    data = json.loads((folder / "out" / "comparison.json").read_text())
    assert data["complete"] and data["analysed_bearing"] == "rear" and "rows" not in data
    found = {(row["phase"], row["figure"]): row for row in data["figures"]}
    for depth in DEPTHS:
        summary = json.loads((folder / "out" / depth / "summary.json").read_text())
        for phase in ("before", "after"):
            (row,) = (r for r in summary["bearings"] if (r["bearing"], r["phase"]) == ("rear", phase))
            (shaft,) = (r for r in summary["shaft"] if r["phase"] == phase)
            for figure, value in (
                ("bearing force, mean", row["force_mean"]),
                ("bearing force, largest", row["force_max"]),
                ("least gap, smallest", row["least_gap_min"]),
                ("time in solid contact", row["contact_share"]),
                ("vibration amplitude, largest", shaft["amplitude_max"]),
                ("normal stress, largest", shaft["stress_max"]),
            ):
                assert found[phase, figure]["values"][depth] == pytest.approx(value, rel=1e-12)
    gap = found["before", "least gap, mean"]
    values, differences = gap["values"], gap["differences"]
    assert values["v1"] < values["v3"]  # the edge is nearer than the centre line
    assert differences == {"v3": pytest.approx(values["v3"] / values["v1"] - 1.0)}
    moments = found["after", "bearing moment, largest"]
    assert moments["values"]["v3"] == 0.0 and moments["differences"]["v3"] == -1.0
    assert found["after", "time in solid contact"]["differences"]["v3"] is None  # of nothing
    assert [item["depth"] for item in data["conclusions"]] == list(DEPTHS)
    table = list(csv.DictReader((folder / "out" / "comparison.csv").open()))
    assert [float(row["v3"]) for row in table] == pytest.approx(
        [row["values"]["v3"] for row in data["figures"]]
    )


def test_another_machine_is_not_held_against_the_paper(compared):
    folder, _ = compared
    text = (folder / "out" / "comparison.txt").read_text()
    assert text.startswith("Short: V1, V3 beside one another\n")
    for word in ("paper", "missed", "verdict", "150.0 N/mm²"):
        assert word not in text
    assert re.search(r"least gap, mean +\d+\.\d µm +\d+\.\d µm +\+\d\d\.\d %", text)


def test_the_runs_start_in_their_steady_state(compared):
    """Static state plus linear unbalance response: the first revolution is like the last before the event."""
    folder, _ = compared
    data = json.loads((folder / "out" / "comparison.json").read_text())
    for run in data["statistics"].values():
        start = run["start"]
        assert start["first"] == pytest.approx({"start": 0.0, "end": 0.02})
        assert start["last"] == pytest.approx({"start": 0.02, "end": 0.04})
        assert start["mean_last"] == pytest.approx(start["mean_first"], rel=5e-3)
        assert start["harmonic_last"] == pytest.approx(start["harmonic_first"], rel=0.05)


COPIES = """
import pathlib, shutil, sys
out = pathlib.Path(sys.argv[-1])
shutil.copytree(pathlib.Path("out") / out.name, out)
"""
"""In place of a run, what the same run of the whole comparison left."""
DIES_AT_V1 = f"""
import os, signal, sys
if "v1" in sys.argv:
    os.kill(os.getpid(), signal.SIGKILL)
{COPIES}"""
IS_REFUSED = """
import sys
sys.exit(print("error: step-refused (exit status 4): front: the gap closed", file=sys.stderr) or 4)
"""


@pytest.fixture
def here(compared, monkeypatch):
    """A folder with the scenario and its FMUs."""
    folder, _ = compared
    monkeypatch.chdir(folder)
    return folder


def run(tmp_path, code, **request):
    """The command with other code for its runs; its status, what it said, and what it said of errors."""
    command = (sys.executable, "-c", code, "run")
    coarse = {"step": 2e-4, "film": {"columns": 24, "rows": 4}}
    with (tmp_path / "said").open("w+") as said, (tmp_path / "errors").open("w+") as errors:
        consoles = Console(file=said, width=200), Console(file=errors, width=200)
        status = compare_command.run(
            CompareRequest("short.toml", coarse, **{"depths": DEPTHS, **request}), *consoles, command=command
        )
        said.seek(0)
        errors.seek(0)
        return status, said.read(), errors.read()


def test_a_run_that_dies_makes_a_partial_comparison(here, tmp_path):
    out = tmp_path / "out"
    status, said, errors = run(tmp_path, DIES_AT_V1, out=out, doublings=2)
    assert status == PROCESS_DIED
    assert "v1 not finished: process-died" in errors and "SIGKILL" in errors
    assert "PARTIAL: V1 process-died" in said and "Check with" not in said
    assert not out.exists()
    partial = tmp_path / "out-partial"
    assert "v1 process-died" in (partial / "PARTIAL.txt").read_text()
    assert files(partial / "figures") == FIGURES
    data = json.loads((partial / "comparison.json").read_text())
    assert data["complete"] is False and data["runs"]["v1"]["outcome"] == "process-died"
    assert all(set(row["values"]) == set(DEPTHS) for row in data["figures"])
    assert all(row["values"]["v1"] is None is not row["values"]["v3"] for row in data["figures"])
    assert sorted(path.name for path in partial.iterdir() if path.is_dir()) == ["figures", "v3"]
    assert data["conclusions"][0]["action"] == "no conclusion"


def test_runs_that_left_nothing_give_the_status_and_no_folder(here, tmp_path):
    status, said, errors = run(tmp_path, IS_REFUSED, out=tmp_path / "out")
    assert status == Outcome.STEP_REFUSED.status
    assert errors.count("step-refused at t = 0 s: front: the gap closed") == len(DEPTHS)
    assert said.count("no conclusion") == len(DEPTHS)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["errors", "said"]


def test_depths_stand_in_their_own_order(here, tmp_path):
    """Whatever the order in which they are asked for: differences are those to the first."""
    status, said, errors = run(tmp_path, COPIES, depths=("v3", "v1"), out=tmp_path / "out", formats=())
    assert status == 0, errors
    assert "V1, V3 beside one another" in said and "V3 to V1" in said
    assert sorted(path.name for path in (tmp_path / "out").iterdir() if path.is_dir()) == ["v1", "v3"]


def test_a_finer_scenario_has_twice_the_film_and_half_the_step():
    found = [(one.film.columns, one.film.rows, one.step) for one in refine(load_scenario("small"), 3)]
    assert found == [(96, 16, 5e-5), (192, 30, 2.5e-5), (384, 30, 1.25e-5)]  # no film has more rows


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--bearing", "middle"], "analysed_bearing = 'middle': no such bearing"),
        (["--columns", "4"], "film.columns = 4"),
        (["--rows", "40"], "film.rows = 40"),
        (["--columns", "512", "--rows", "30", "--check"], "film.columns = 512, film.rows = 30 is the finest"),
        (["--out", "short.toml"], "is a file"),
        (["--jobs", "0"], "--jobs"),
        (["--depth", "v9"], "--depth v9"),
    ],
)
def test_wrong_input_is_refused_before_anything_runs(here, arguments, named):
    before = files(here)
    result = CliRunner().invoke(app, ["compare", "short.toml", *arguments], env={"COLUMNS": "200"})
    assert result.exit_code == INPUT_ERROR
    assert named in result.output
    assert files(here) == before


def test_help_tells_options_and_exit_statuses():
    text = CliRunner().invoke(app, ["compare", "--help"], env={"COLUMNS": "120", "TERM": "dumb"}).output
    options = (
        "--depth --end --step --columns --rows --bearing --jobs --check --doublings --out --fmus --format"
    )
    for option in (*options.split(), "--no-figures"):
        assert option in text
    assert re.search(rf"\b{PROCESS_DIED}  ", text)


@pytest.mark.parametrize(
    ("example", "fit", "said"),
    [
        ("lemon", ["v1", "v2"], "the table film knows the plain bore only; use depth v2"),
        ("tilting", ["v1", "v2"], "v3 left out: "),
        ("fan", ["v1", "v2", "table", "v3"], ""),
    ],
)
def test_depths_that_cannot_have_a_bore_are_left_out_and_told(example, fit, said):
    scenario = load_scenario(f"tests/examples/{example}/{'coast-down' if example == 'fan' else 'loss'}.toml")
    console = Console(record=True, width=200, quiet=False, file=io.StringIO())
    assert fitting(scenario, train_of(scenario), console) == fit
    text = console.export_text()
    assert said in text and bool(text) == bool(said)
