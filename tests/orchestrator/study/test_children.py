"""Runs side by side in processes: how many at once, how they end, also those that die."""

import signal
import time

import pytest
from rich.console import Console

from orchestrator.errors import OrchestratorError
from orchestrator.results.record_files import read_record
from orchestrator.study.children import DIED, Child, Ended, run_children
from orchestrator.study.progress import show_runs
from tests.faults import fault
from tests.orchestrator.study.child_command import COMMAND

GUARD = "orchestrator.study.children:run_children"


def run(folder, jobs, show=lambda *_: None, **hows):
    """Run stand-ins of these names, each doing what its value says."""
    children = [Child(name, (how,), folder / name) for name, how in hows.items()]
    return run_children(children, jobs, show, command=COMMAND)


def test_every_run_tells_its_progress_and_its_end(tmp_path):
    heard = []
    ended = run(tmp_path, 2, lambda *said: heard.append(said), v1="finishes", v2="finishes")
    finished = Ended("finished", "", "The run reached its end time.", 0.3, 1.0)
    assert ended == {"v1": finished, "v2": finished} and finished.ok and finished.status == 0
    for name in ended:
        said = [said for who, said in heard if who == name]
        assert said == ["time loop ...", "  50 %  0.150 of 0.3 s", finished]


@fault(
    "process",
    "a process that dies in `compare`",
    "`process-died` with signal or exit code, exit 8; the others go on",
    guard="orchestrator.study.children:_Process.ended",
)
def test_a_process_that_dies_is_an_outcome_and_the_others_go_on(tmp_path):
    hows = {"v1": "finishes", "v2": "killed", "v3": "exits", "v4": "crashes"}
    ended = run(tmp_path, 4, **hows)
    assert [end.outcome for end in ended.values()] == ["finished", DIED, DIED, DIED]
    assert "ended by SIGKILL" in ended["v2"].message and "with exit code 77" in ended["v3"].message
    assert "with exit code 1: Fatal: out of luck" in ended["v4"].message
    assert ended["v2"].simulated == 0.1 and "--jobs 1" in ended["v2"].advice and ended["v2"].status == 8


@pytest.mark.parametrize(("jobs", "most"), [(1, "1"), (2, "2")])
def test_no_more_runs_at_once_than_asked_for(jobs, most, tmp_path):
    run(tmp_path, jobs, v1="counts", v2="counts", v3="counts")
    assert max(path.read_text() for path in tmp_path.glob("*-count")) == most


@fault(
    "process",
    "wrong input that only a run of `compare` finds",
    "exit 2 with its message; the other runs are ended",
    guard="orchestrator.study.children:_Process.ended",
)
def test_wrong_input_found_by_a_run_is_an_error(tmp_path):
    begin = time.monotonic()
    with pytest.raises(OrchestratorError, match=r"^short\.toml: bearing = 'middle': no such bearing$"):
        run(tmp_path, 2, v1="waits", v2="refuses")
    assert time.monotonic() - begin < 30.0
    assert not (tmp_path / "v1").exists()


@fault(
    "machine",
    "a full disk in one run of `compare`",
    "that run is `not-written`, with folder and reason; the others go on",
    guard="orchestrator.study.children:_Process.ended",
)
def test_a_run_that_cannot_write(tmp_path):
    ended = run(tmp_path, 2, v1="cannot-write", v2="finishes")
    assert [end.outcome for end in ended.values()] == ["not-written", "finished"]
    assert (
        ended["v1"].message == f"{tmp_path / 'v1'}: File too large. Make room." and ended["v1"].status == 13
    )


@pytest.mark.parametrize(
    ("number", "outcome", "status"),
    [
        pytest.param(
            signal.SIGINT,
            "interrupted",
            130,
            marks=fault(
                "process",
                "Ctrl-C in `compare`",
                "the runs under way end between two steps, no other starts; exit 130",
                guard=GUARD,
            ),
        ),
        pytest.param(
            signal.SIGTERM,
            "terminated",
            143,
            marks=fault(
                "process", "SIGTERM in `compare`", "as Ctrl-C, but `terminated`, exit 143", guard=GUARD
            ),
        ),
    ],
)
def test_a_signal_ends_the_runs_between_steps_and_starts_no_more(
    number, outcome, status, tmp_path, monkeypatch
):
    monkeypatch.setattr("orchestrator.master.interrupt.TOGETHER", 0.0)  # the last test's signal was just now

    def ask(_name, said):
        if said == "listening ...":
            signal.raise_signal(number)

    before = signal.getsignal(number)
    ended = run(tmp_path, 1, ask, v1="waits", v2="finishes")
    assert [(end.outcome, end.status) for end in ended.values()] == [(outcome, status)] * 2
    assert (ended["v1"].message, ended["v1"].simulated) == ("at t = 0.1 s", 0.1)
    assert ended["v2"].message == "not started" and not (tmp_path / "v2").exists()
    assert signal.getsignal(number) is before


@fault(
    "unit",
    "a unit that hangs in a run of `compare`",
    "that run is `unit-hung`, with its record; the others go on",
    guard="orchestrator.study.children:_Process.ended",
)
def test_a_hanging_unit_ends_the_process_of_its_run(faulty, small_fmus, tmp_path, monkeypatch):
    monkeypatch.setenv("FAULT", "sleep")
    (tmp_path / "short.toml").write_text('train = "small"\nend = 0.005\n[record]\ninterval = 1e-4\n')
    plain = (str(tmp_path / "short.toml"), "--depth", "v3", "--fmus", str(small_fmus), "--no-figures")
    hangs = (*plain, "--depth-at", f"rear={faulty}", "--trust", "--budget", "1")
    children = [Child("v1", hangs, tmp_path / "v1"), Child("v3", plain, tmp_path / "v3")]
    ended = run_children(children, 2, lambda *_: None)
    assert (ended["v1"].outcome, ended["v3"].outcome) == ("unit-hung", "finished")
    assert "rear: fmi2DoStep has not come back" in ended["v1"].message and ended["v1"].status == 12
    assert read_record(children[0].results).attrs["status"] == "unit-hung"


def say(show):
    for name in ("v1", "v2"):
        for line in ("Built fmus", "loading FMUs ...", "time loop ...", "  50 %  0.150 of 0.3 s, 2 s left"):
            show(name, line)
    show("v1", Ended("finished", simulated=0.3))
    show("v2", Ended("step-refused", "front: gap", "", 0.15, 1.0))


def test_progress_in_lines_names_the_run(tmp_path):
    with (tmp_path / "log").open("w+") as log:
        with show_runs(("v1", "v2"), Console(file=log, width=120)) as show:
            say(show)
        log.seek(0)
        text = log.read()
    assert "v1  loading FMUs ..." in text and "v2    50 %  0.150 of 0.3 s, 2 s left" in text
    assert "v1  finished at t = 0.3 s" in text and "v2  step-refused at t = 0.15 s: front: gap" in text
    assert "Built" not in text


def test_progress_on_a_terminal_has_a_bar_each(tmp_path):
    with (tmp_path / "log").open("w+") as log:
        console = Console(file=log, width=120, force_terminal=True, color_system=None)
        with show_runs(("v1", "v2"), console) as show:
            say(show)
        log.seek(0)
        text = log.read()
    assert "v1" in text and "v2" in text and "0.150 of 0.3 s" in text and "step-refused" in text
