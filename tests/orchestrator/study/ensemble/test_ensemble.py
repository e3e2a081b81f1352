"""Studies of functions: whatever a run does, the study ends with a row of each, and the same rows."""

import signal
import time
from contextlib import contextmanager

import numpy as np
import pytest

pytest.importorskip("distributed", reason="studies run on Dask, which is not installed")

import bladeloss

from orchestrator.errors import OrchestratorError
from orchestrator.master.interrupt import handled, raise_at_once
from orchestrator.results.ensemble.files import RUNS
from orchestrator.study.ensemble import conduct as conducting
from orchestrator.study.ensemble.running import attendant, crowd
from tests.faults import fault
from tests.orchestrator.study.ensemble import functions

GRID = {"parameters": {"a": {"key": "a", "grid": [1.0, 2.0, 3.0]}, "b": {"key": "b", "grid": [10.0, 20.0]}}}


@fault(
    "process",
    "a run of a study that crashes, hangs, or ends its process",
    "a row with its outcome, after a second try where it may be the machine; the others go on",
    guard="orchestrator.study.ensemble.running.attendant:Attendant.carry_out",
)
def test_whatever_a_run_does_is_a_row(tmp_path):
    (tmp_path / "tries").mkdir()
    study = {
        "parameters": {
            "x": {"key": "x", "grid": [0, 1, 2, 3, 4, 5]},
            "folder": {"key": "folder", "values": [str(tmp_path / "tries")]},
        }
    }
    data = bladeloss.study(study, function=functions.fails, jobs=2, limit=1.0, out=tmp_path / "study")
    outcomes = dict(zip(data["x"].values.astype(int).tolist(), data["outcome"].values[:, 0], strict=True))
    assert outcomes == dict(
        enumerate(["finished", "refused", "process-died", "over-limit", "process-died", "finished"])
    )
    messages = data["message"].values[:, 0]
    assert messages[1] == "ValueError: out of luck"
    assert messages[2] == "the process of the run ended by SIGKILL (twice)"
    assert messages[3] == "took longer than 1 s (twice)"
    assert messages[4] == "the process of the run ended with exit code 77 (twice)"
    tries = [len(list((tmp_path / "tries").glob(f"{x}-*"))) for x in range(6)]
    assert tries == [1, 1, 2, 2, 2, 2]
    np.testing.assert_array_equal(data["value"].values[:, 0], [0.0, *[np.nan] * 4, 5.0])


def test_a_study_goes_on_with_what_is_missing_and_gives_the_same_bytes(tmp_path, monkeypatch):
    folder = tmp_path / "study"
    data = bladeloss.study(GRID, function=functions.total, out=folder)
    np.testing.assert_array_equal(data["total"].values[:, 0], [11.0, 21.0, 12.0, 22.0, 13.0, 23.0])
    files, written = sorted((folder / RUNS).iterdir()), (folder / "study.nc").read_bytes()
    assert len(files) == 6
    files[0].unlink()
    files[1].write_text("half a fi")
    kept = {path: path.stat().st_mtime_ns for path in files[2:]}
    bladeloss.study(GRID, function=functions.total, out=folder, jobs=1)
    assert (folder / "study.nc").read_bytes() == written
    assert {path: path.stat().st_mtime_ns for path in files[2:]} == kept and files[0].is_file()
    monkeypatch.setattr(conducting, "crowd", None)  # nothing is left for it to do
    bladeloss.study(GRID, function=functions.total, out=folder)
    assert (folder / "study.nc").read_bytes() == written
    assert (folder / "samples.csv").read_text().splitlines()[1] == "0,1.0,10.0"


@fault(
    "process",
    "Ctrl-C in a study",
    "it ends at once, what is done is kept, and the same command goes on from there; exit 130",
    guard="orchestrator.study.ensemble.conduct:conduct",
)
def test_a_study_that_is_stopped_goes_on_from_there(tmp_path, monkeypatch):
    """Runs under way, which would take a minute, are not waited for."""
    monkeypatch.setattr(crowd, "close_all", attendant.close_all)
    (tmp_path / "s.toml").write_text("[parameters.x]\nkey = 'x'\ngrid = [0.0, 0.1, 0.2, 60.0]\n")
    seen = []

    @contextmanager
    def stops(*_):
        yield lambda row: seen.append(row) or (len(seen) == 3 and signal.raise_signal(signal.SIGINT))

    folder = tmp_path / "study"
    with monkeypatch.context() as patch:
        patch.setattr(conducting, "show_tally", stops)
        begin = time.monotonic()
        with pytest.raises(KeyboardInterrupt), handled(raise_at_once):
            bladeloss.study(tmp_path / "s.toml", function=functions.sleeps, out=folder, jobs=2)
        assert time.monotonic() - begin < 50.0
    assert len(list((folder / RUNS).glob("*.json"))) == 3 and not (folder / "study.nc").exists()
    data = bladeloss.study(tmp_path / "s.toml", function=functions.sleeps, out=folder, limit=0.5)
    assert data["outcome"].values[:, 0].tolist() == ["finished"] * 3 + ["over-limit"]


def test_the_second_stage_runs_where_the_first_says_so():
    study = {
        "depths": ["coarse"],
        "parameters": {"x": {"key": "x", "grid": [1.0, 2.0, 3.0]}},
        "refine": {"depths": ["fine"], "figure": "gap", "below": 2.5},
    }
    data = bladeloss.study(study, function=functions.of_depth)
    assert data["outcome"].sel(depth="fine").values.tolist() == ["finished", "finished", "not-refined"]
    np.testing.assert_allclose(data["gap"].sel(depth="fine"), [1.1, 2.2, np.nan])
    assert data.attrs["refined_where"] == "gap at depth coarse below 2.5, or none"


def test_sobol_indices_of_a_closed_form():
    """Ishigami and Homma (1990): a = 7, b = 0.1; each index within its 95 % bound, which is narrow."""
    pytest.importorskip("SALib", reason="designs are drawn by SALib, which is not installed")
    uniform = {"distribution": "uniform", "arguments": {"loc": -np.pi, "scale": 2.0 * np.pi}}
    study = {
        "seed": 3,
        "parameters": {name: {"key": name, **uniform} for name in ("x1", "x2", "x3")},
        "sampling": {"method": "sensitivity-sobol", "count": 256},
    }
    data = bladeloss.study(study, function=functions.ishigami).sel(figure="y").isel(depth=0)
    a, b = 7.0, 0.1
    one, two = 0.5 * (1.0 + b * np.pi**4 / 5.0) ** 2, a**2 / 8.0
    mixed = b**2 * np.pi**8 * (1.0 / 18.0 - 1.0 / 50.0)
    whole = one + two + mixed
    for name, exact in (
        ("sobol_first", np.array([one, two, 0.0]) / whole),
        ("sobol_total", np.array([one + mixed, two, mixed]) / whole),
    ):
        bound = data[f"{name}_bound"].values
        assert (np.abs(data[name].values - exact) < bound).all() and (bound < 0.25).all()


def test_ten_thousand_samples_are_no_burden_before_they_run(tmp_path):
    """They are drawn, known and gathered in seconds; running them is a longer proof."""
    begin = time.process_time()
    from orchestrator.study.ensemble.gathering.gather import Rows, dataset_of
    from orchestrator.study.ensemble.running.row import Row, Value
    from orchestrator.study.ensemble.sampling.file import read_study_file

    study = {"parameters": {"x": {"key": "x", "grid": {"start": 0.0, "stop": 1.0, "count": 10_000}}}}
    file = read_study_file(study, of_runs=False)
    plan = conducting.plan_of(file, conducting.Means(tmp_path), functions.total)
    digests = plan.digests(plan.first())
    assert len(set(digests.values())) == 10_000
    rows = {run: Row("finished", values={"total": Value((), 1.0)}) for run in digests}
    assert float(dataset_of(plan.study, plan.samples, Rows([""], rows))["total"].sum()) == 10_000.0
    assert time.process_time() - begin < 20.0


def test_a_folder_of_something_else_is_left_alone(tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(OrchestratorError, match="holds files that are no earlier study"):
        bladeloss.study(GRID, function=functions.total, out=tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_no_scheduler_is_said(tmp_path, monkeypatch):
    monkeypatch.setattr(crowd, "CONNECTING", 0.5)
    with pytest.raises(bladeloss.Error, match=r"--scheduler tcp://127\.0\.0\.1:9: no Dask scheduler there"):
        bladeloss.study(GRID, function=functions.total, out=tmp_path / "s", scheduler="tcp://127.0.0.1:9")
