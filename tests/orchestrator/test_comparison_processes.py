"""Runs side by side in processes: how many at once, how they end, also those that die."""

import os
import signal
import time
from pathlib import Path

import pytest
from rich.console import Console

from orchestrator.case.simulate import Stage
from orchestrator.commands.compare import status_of
from orchestrator.errors import OrchestratorError
from orchestrator.outcome import Outcome
from orchestrator.scenario.file import load_scenario
from orchestrator.study.paper.processes import DIED, cores, run_all
from orchestrator.study.paper.progress import show_runs
from orchestrator.study.paper.worker import Ended, Progressed, Task
from tests.faults import fault

FINISHED = Ended("finished", "", "", 0.3, 1.0)


def tasks(folder, *names):
    scenario = load_scenario("small")
    return [Task(name, scenario, Path("fmus"), folder / name) for name in names]


# What a process does; importable, since it starts afresh.


def finishes(_task, connection, _stop):
    connection.send(Progressed(Stage.RUN, 0.1))
    connection.send(FINISHED)


def two_die(task, connection, stop):
    connection.send(Progressed(Stage.RUN, 0.1))
    if task.name == "v2":
        os.kill(os.getpid(), signal.SIGKILL)
    if task.name == "v3":
        os._exit(3)
    finishes(task, connection, stop)


def counts_others(task, connection, stop):
    """Leaves a mark while it runs and tells how many marks there are."""
    task.folder.mkdir(parents=True)
    time.sleep(0.3)
    alive = len(list(task.folder.parent.iterdir()))
    task.folder.rmdir()
    connection.send(Ended("finished", str(alive), "", 0.3, 1.0))


def refuses(_task, connection, _stop):
    connection.send(OrchestratorError("front: no such bearing"))


def waits_for_the_end(_task, connection, stop):
    connection.send(Progressed(Stage.RUN, 0.1))
    stop.wait(60.0)
    connection.send(Ended(Outcome.INTERRUPTED.value, "", "", 0.1, 1.0))


def names_its_threads(_task, connection, _stop):
    connection.send(Ended("finished", os.environ["OMP_NUM_THREADS"], "", 0.3, 1.0))


def test_every_run_tells_its_progress_and_its_end(tmp_path):
    heard = []
    ended = run_all(tasks(tmp_path, "v1", "v2"), 2, lambda *said: heard.append(said), work=finishes)
    assert ended == {"v1": FINISHED, "v2": FINISHED}
    for name in ended:
        assert [said for who, said in heard if who == name] == [Progressed(Stage.RUN, 0.1), FINISHED]


@fault(
    "process",
    "a worker that dies in `compare`",
    "`process-died` with signal or exit code, exit 8; the others go on",
    guard="orchestrator.study.paper.processes:run_all",
)
def test_a_process_that_dies_is_an_outcome_and_the_others_go_on(tmp_path):
    ended = run_all(tasks(tmp_path, "v1", "v2", "v3"), 3, lambda *_: None, work=two_die)
    assert [end.outcome for end in ended.values()] == ["finished", DIED, DIED]
    assert "SIGKILL" in ended["v2"].message and "exit code 3" in ended["v3"].message
    assert ended["v2"].simulated == 0.1 and ended["v2"].advice and not ended["v2"].ok


def test_no_more_runs_at_once_than_asked_for(tmp_path):
    ended = run_all(tasks(tmp_path, "v1", "v2"), 1, lambda *_: None, work=counts_others)
    assert [end.message for end in ended.values()] == ["1", "1"]


@fault(
    "process",
    "wrong input that only a worker of `compare` finds",
    "exit 2 with its message; the other workers are ended",
    guard="orchestrator.study.paper.processes:run_all",
)
def test_wrong_input_found_by_a_run_is_an_error(tmp_path):
    with pytest.raises(OrchestratorError, match="no such bearing"):
        run_all(tasks(tmp_path, "v1", "v2"), 2, lambda *_: None, work=refuses)


@fault(
    "process",
    "Ctrl-C in `compare`",
    "the runs under way end between two steps, no other starts; exit 130",
    guard="orchestrator.study.paper.processes:run_all",
)
def test_an_interrupt_ends_the_runs_between_steps_and_starts_no_more(tmp_path):
    def interrupt(_name, message):
        if isinstance(message, Progressed):
            signal.raise_signal(signal.SIGINT)

    before = signal.getsignal(signal.SIGINT)
    ended = run_all(tasks(tmp_path, "v1", "v2"), 1, interrupt, work=waits_for_the_end)
    assert [end.outcome for end in ended.values()] == ["interrupted", "interrupted"]
    assert ended["v2"].message == "not started"
    assert signal.getsignal(signal.SIGINT) is before


@fault(
    "process",
    "SIGTERM in `compare`",
    "as Ctrl-C, but `terminated`, exit 143",
    guard="orchestrator.study.paper.processes:run_all",
)
def test_a_request_to_terminate_ends_the_runs_by_that_name(tmp_path):
    def terminate(_name, message):
        if isinstance(message, Progressed):
            signal.raise_signal(signal.SIGTERM)

    ended = run_all(tasks(tmp_path, "v1", "v2"), 1, terminate, work=waits_for_the_end)
    assert [end.outcome for end in ended.values()] == ["terminated", "terminated"]
    assert status_of(ended["v1"]) == 143 and "SIGTERM" in ended["v1"].advice


def test_processes_share_the_cores(tmp_path, monkeypatch):
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    (end,) = run_all(tasks(tmp_path, "v1"), 1, lambda *_: None, work=names_its_threads).values()
    assert end.message == str(cores())
    assert "OMP_NUM_THREADS" not in os.environ


def say(show):
    for name in ("v1", "v2"):
        show(name, Progressed(Stage.LOAD, 0.0))
        show(name, Progressed(Stage.RUN, 0.0))
        show(name, Progressed(Stage.RUN, 0.15))
    show("v1", FINISHED)
    show("v2", Ended("step-refused", "front: gap", "", 0.15, 1.0))


def test_progress_in_lines_names_the_run(tmp_path):
    with (tmp_path / "log").open("w+") as log:
        with show_runs(("v1", "v2"), 0.3, Console(file=log, width=120)) as show:
            say(show)
        log.seek(0)
        text = log.read()
    assert "v1  loading FMUs ..." in text and "v2    50 %  0.150 of 0.3 s" in text
    assert "v1  finished at t = 0.3 s" in text and "v2  step-refused at t = 0.15 s: front: gap" in text


def test_progress_on_a_terminal_has_a_bar_each(tmp_path):
    with (tmp_path / "log").open("w+") as log:
        console = Console(file=log, width=120, force_terminal=True, color_system=None)
        with show_runs(("v1", "v2"), 0.3, console) as show:
            say(show)
        log.seek(0)
        text = log.read()
    assert "v1" in text and "v2" in text and "step-refused" in text
