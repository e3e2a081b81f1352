"""Signals, kills and two runs at once: what is on disk is whole, or says that it is not."""

import os
import signal
import time

import pytest

from orchestrator.case.checkpoint_folder import checkpoint_folder
from orchestrator.observers import checkpoint
from orchestrator.observers.checkpoint import CheckpointError
from orchestrator.outcome import INPUT_ERROR, Outcome
from orchestrator.results.folder import ResultFolderError
from orchestrator.results.folder_lock import lock_folder
from orchestrator.results.record_files import read_record
from orchestrator.results.replacing import result_folder
from tests.faults import fault
from tests.orchestrator.foreign import call
from tests.orchestrator.process import command, done

SCENARIO = 'train = "small"\nend = 0.1\ndepth = "v3"\n[record]\ninterval = 1e-3\n'


@pytest.fixture(scope="module")
def whole(small_fmus, tmp_path_factory):
    """The record of a run that nothing disturbs."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "short.toml").write_text(SCENARIO)
    options = ("--fmus", small_fmus, "--out", folder / "out", "--no-figures")
    result = call("run", folder / "short.toml", *options)
    assert result.exit_code == 0, result.output
    return read_record(folder / "out")


@pytest.mark.parametrize(
    ("number", "outcome"),
    [
        pytest.param(
            signal.SIGINT,
            Outcome.INTERRUPTED,
            marks=[
                pytest.mark.slow,
                fault(
                    "process",
                    "Ctrl-C in a run with checkpoints",
                    "exit 130, `interrupted`; the record in `-partial`; `resume` from that very step gives "
                    "the record of an undisturbed run, to the bit",
                    guard="orchestrator.master.time_loop:run",
                ),
            ],
        ),
        pytest.param(
            signal.SIGTERM,
            Outcome.TERMINATED,
            marks=fault(
                "process",
                "SIGTERM in a run with checkpoints, as batch systems send it",
                "exit 143, `terminated`; otherwise as Ctrl-C",
                guard="orchestrator.master.interrupt:SIGNALS",
            ),
        ),
    ],
)
def test_a_signal_ends_a_run_that_can_go_on(number, outcome, whole, small_fmus, tmp_path):
    (tmp_path / "short.toml").write_text(SCENARIO)
    out = tmp_path / "out"
    options = ("--fmus", small_fmus, "--out", out, "--no-figures", "--checkpoint", 10)
    process = command("run", tmp_path / "short.toml", *options)
    saved = checkpoint_folder(out) / checkpoint.FILE
    while not saved.exists() and process.poll() is None:
        time.sleep(0.01)
    process.send_signal(number)
    said, errors = process.communicate(timeout=60)
    assert process.returncode == outcome.status, said + errors
    assert f"{outcome.value} (exit status {process.returncode})" in errors
    reached = checkpoint.read(saved.parent).time
    assert 0.0 < reached < 0.1
    partial = tmp_path / "out-partial"
    if partial.exists():  # absent when the signal came before the second record
        assert f"{outcome.value} at t = {reached:.6g} s" in (partial / "PARTIAL.txt").read_text()
        assert read_record(partial)["time"].values[-1] == reached
    assert call("resume", out, "--fmus", small_fmus).exit_code == 0
    assert read_record(out).identical(whole)


@fault(
    "process",
    "SIGTERM before the time loop, as when FMUs are built or films compiled",
    "exit 143, `terminated; nothing was written`; what was extracted is removed",
    guard="orchestrator.cli.options:guarded",
)
def test_a_signal_before_the_run(small_fmus, tmp_path):
    code = """
import os, signal, sys
from orchestrator.fmi import folder as fmu_folder
from orchestrator.cli.main import main
fmu_folder.builder.refresh = lambda *_: os.kill(os.getpid(), signal.SIGTERM)
sys.argv[0] = "bladeloss"
main()
"""
    status, _, errors = done("run", "small", "--out", tmp_path / "out", code=code)
    assert status == 143, errors
    assert errors.strip() == "error: terminated; nothing was written" and not list(tmp_path.iterdir())


@fault(
    "process",
    "two runs to one folder at once",
    "exit 2 for the second; folder, `another run`; the first is not disturbed",
    guard="orchestrator.results.folder_lock:lock_folder",
)
def test_two_runs_to_one_folder(small_fmus, tmp_path):
    out = tmp_path / "out"
    (tmp_path / "short.toml").write_text(SCENARIO)
    with lock_folder(out):
        result = call("run", tmp_path / "short.toml", "--fmus", small_fmus, "--out", out, "--no-figures")
        assert result.exit_code == INPUT_ERROR, result.output
        assert f"{out}: another run is writing to it; --out takes a folder of its own" in result.stderr
        assert not out.exists()
    assert [path.name for path in tmp_path.iterdir()] == ["short.toml"]


def test_a_claim_ends_with_its_run(tmp_path):
    for _ in range(2):
        with lock_folder(tmp_path / "a" / "out"):
            with pytest.raises(ResultFolderError, match="another run"), lock_folder(tmp_path / "a" / "out"):
                pass
            with lock_folder(tmp_path / "a" / "other"):
                pass
    assert list(tmp_path.iterdir()) == []


def killed_in(work):
    """Carry out work in a process that is killed on its way; it must be."""
    child = os.fork()
    if child == 0:
        try:
            work()
        finally:
            os._exit(0)
    _, status = os.waitpid(child, 0)
    assert os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGKILL


def write(folder, text):
    (folder / "scenario.toml").write_text(text)
    (folder / "summary.json").write_text(text)
    (folder / "record.nc").write_text(text)


def results(folder, text):
    with result_folder(folder) as fresh:
        write(fresh, text)


@fault(
    "process",
    "kill -9 while results are written",
    "the earlier results stay as they are; the next run removes what was half-written",
    guard="orchestrator.results.folder_lock:lock_folder",
)
def test_a_kill_while_results_are_written(tmp_path):
    out = tmp_path / "out"
    results(out, "old")

    def work():
        with result_folder(out) as fresh:
            write(fresh, "new")
            os.kill(os.getpid(), signal.SIGKILL)

    killed_in(work)
    assert (out / "record.nc").read_text() == "old" and not (out / "PARTIAL.txt").exists()
    assert len(list(out.glob(".out-writing-*"))) == 1
    with lock_folder(out):
        pass
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


@pytest.mark.parametrize("damage", ["cut short", "a bit flipped", "empty", "other text"])
@fault(
    "process",
    "a checkpoint that is cut short, changed or empty",
    "exit 2; file, `not a readable checkpoint`",
    guard="orchestrator.observers.checkpoint:read",
)
def test_a_damaged_checkpoint(damage, tmp_path):
    import numpy as np

    path = tmp_path / "out-checkpoint" / checkpoint.FILE
    checkpoint.write(path, {"version": 1, "about": {}, "time": 1.0}, {"x": np.arange(300.0)})
    data = bytearray(path.read_bytes())
    if damage == "a bit flipped":
        data[len(data) // 2] ^= 4
    changed = {"cut short": data[: len(data) // 2], "empty": b"", "other text": b"text"}
    path.write_bytes(changed.get(damage, data))
    with pytest.raises(CheckpointError, match="not a readable checkpoint"):
        checkpoint.read(path.parent)
    result = call("resume", tmp_path / "out")
    assert result.exit_code == INPUT_ERROR
    assert f"{path}: not a readable checkpoint" in result.stderr
