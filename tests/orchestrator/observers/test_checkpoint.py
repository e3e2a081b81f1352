"""A run that is killed at any moment goes on from its checkpoint to the same record, bit for bit."""

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from orchestrator.case import record_so_far
from orchestrator.case.checkpoint_folder import checkpoint_folder, discard
from orchestrator.case.simulate import Execution, simulate
from orchestrator.observers import checkpoint
from orchestrator.observers.checkpoint import CheckpointError, Checkpoints
from orchestrator.outcome import Outcome
from orchestrator.results.growing_record import HEAD_FILE, ROWS_FILE
from orchestrator.results.record_files import read_record
from tests.faults import fault
from tests.orchestrator.foreign import call
from tests.orchestrator.observers.killed import BLADE, Killed, killed_at
from tests.orchestrator.toy_train import toy_scenario

CASES = {
    "plain": {},
    "controlled": {"coupling": "gauss-seidel", "tolerance": 0.015},
    "newton": {"coupling": "newton", "ledger": True},
    "iqn-ils": {"coupling": "iqn-ils"},
    "multirate": {"coupling": "multirate", "tolerance": 3e-6, "ledger": True},
}


@pytest.mark.parametrize("change", CASES.values(), ids=CASES)
def test_a_resumed_run_has_the_record_of_an_uninterrupted_one(change, toy, tmp_path, monkeypatch):
    interval = {"interval": 3e-3}
    scenario = toy_scenario(tmp_path, event=BLADE, record=interval, **change)
    whole = simulate(scenario, toy)
    assert whole.outcome is Outcome.FINISHED, whole.message
    assert (whole.counts.rejected > 0) == ("tolerance" in change)
    folder = tmp_path / "saved"
    with pytest.raises(Killed):
        simulate(scenario, toy, killed_at(0.013), Execution(Checkpoints(folder, 4e-3, {})))
    saved = checkpoint.read(folder)
    assert saved.time == pytest.approx(0.012)
    with pytest.raises(Killed):
        simulate(scenario, toy, killed_at(0.025), Execution(Checkpoints(folder, 4e-3, {}), saved))
    saved = checkpoint.read(folder)
    monkeypatch.setattr(record_so_far, "HELD", 0)  # everything is written as it is complete
    result = simulate(scenario, toy, None, Execution(None, saved))
    assert result.record.identical(whole.record)
    assert (result.steps, result.evaluations) == (whole.steps, whole.evaluations)
    assert result.counts == whole.counts


def test_a_checkpoint_is_there_from_the_start_on(toy, tmp_path):
    scenario = toy_scenario(tmp_path, event=BLADE)
    with pytest.raises(Killed):
        simulate(scenario, toy, killed_at(0.0), Execution(Checkpoints(tmp_path / "saved", 1.0, {"a": 1})))
    saved = checkpoint.read(tmp_path / "saved")
    assert (saved.time, saved.about) == (0.0, {"a": 1})
    names = [path.name for path in sorted((tmp_path / "saved").iterdir())]
    assert names == [checkpoint.FILE, HEAD_FILE, ROWS_FILE]
    result = simulate(scenario, toy, None, Execution(None, saved))
    assert result.record.identical(simulate(scenario, toy).record)


@fault(
    "machine",
    "a full disk while a checkpoint is written",
    "the checkpoint before stays whole",
    guard="orchestrator.observers.checkpoint:write",
)
def test_a_write_that_fails_leaves_the_last_checkpoint(tmp_path, monkeypatch):
    path = tmp_path / checkpoint.FILE
    meta = {"step": 1, "level": 0, "counts": {}, "evaluations": [], "fmus": [], "about": {}}
    checkpoint.write(path, {"version": checkpoint.VERSION, "time": 1.0} | meta, {"x": np.arange(3.0)})
    before = path.read_bytes()

    def fail(*_args, **_kwargs):
        raise OSError("disk full")

    monkeypatch.setattr(np, "savez", fail)
    with pytest.raises(OSError, match="disk full"):
        checkpoint.write(path, {"version": checkpoint.VERSION, "about": {}, "time": 2.0}, {})
    assert path.read_bytes() == before
    assert checkpoint.read(tmp_path).time == 1.0


@fault(
    "process",
    "no checkpoint, or one of another version",
    "exit 2; file, what it is and what is read",
    guard="orchestrator.observers.checkpoint:read",
)
def test_missing_and_damaged_checkpoints_are_said(tmp_path):
    with pytest.raises(CheckpointError, match="only a run with --checkpoint can be resumed"):
        checkpoint.read(tmp_path)
    (tmp_path / checkpoint.FILE).write_bytes(b"half a file")
    with pytest.raises(CheckpointError, match="not a readable checkpoint"):
        checkpoint.read(tmp_path)
    checkpoint.write(tmp_path / checkpoint.FILE, {"version": 99}, {})
    with pytest.raises(CheckpointError, match="of version 99"):
        checkpoint.read(tmp_path)


@fault(
    "process",
    "a checkpoint of other FMUs than those at hand",
    "CheckpointError; FMU, its GUID and the one found",
    guard="orchestrator.observers.checkpoint:Checkpoint.restore_units",
)
def test_a_checkpoint_of_other_fmus_is_refused(toy, tmp_path):
    scenario = toy_scenario(tmp_path)
    with pytest.raises(Killed):
        simulate(scenario, toy, killed_at(0.0), Execution(Checkpoints(tmp_path / "saved", 1.0, {})))
    saved = checkpoint.read(tmp_path / "saved")
    saved.meta["fmus"][0] = "another"
    with pytest.raises(CheckpointError, match=r"made with another rotor_toy\.fmu \(another"):
        simulate(scenario, toy, None, Execution(None, saved))


def command(*arguments):
    code = "import sys; from orchestrator.cli.main import main; sys.argv[0] = 'bladeloss'; main()"
    root = Path(__file__).parents[3]
    return subprocess.Popen(
        [sys.executable, "-c", code, *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": str(root)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


@pytest.mark.parametrize("own", [None, "notes.txt", "checkpoint.npz.old.part"])
def test_a_finished_run_removes_what_killed_ones_had_half_written(own, tmp_path):
    place = checkpoint_folder(tmp_path / "out")
    place.mkdir()
    written = [checkpoint.FILE, f"{checkpoint.FILE}.4711.part", f"{checkpoint.FILE}.12.part"]
    for name in [*written, *filter(None, [own])]:
        (place / name).touch()
    discard(tmp_path / "out")
    assert place.exists() == bool(own)
    assert not own or [path.name for path in place.iterdir()] == [own]


@pytest.mark.slow
def test_kill_at_random_moments_of_the_small_train(train_fmus, tmp_path):
    """Three times SIGKILL, wherever it strikes: in a step, a record, or the writing of a checkpoint."""
    options = ["small", "--depth", "v2", "--end", "0.2", "--no-figures", "--fmus", train_fmus]
    assert call("run", *options, "--out", tmp_path / "whole").exit_code == 0
    out = tmp_path / "killed"
    saved = checkpoint_folder(out) / checkpoint.FILE
    process = command("run", *options, "--out", out, "--checkpoint", "0.005")
    chance = random.Random(5)
    for kill in range(3):
        before = saved.stat().st_mtime_ns if saved.exists() else 0
        while not (saved.exists() and saved.stat().st_mtime_ns > before) and process.poll() is None:
            time.sleep(0.02)
        time.sleep(chance.uniform(0.0, 0.15))
        assert process.poll() is None
        process.send_signal(signal.SIGKILL)
        process.wait()
        if kill < 2:
            process = command("resume", out, "--fmus", train_fmus)
    assert call("resume", out, "--fmus", train_fmus).exit_code == 0
    assert read_record(out).identical(read_record(tmp_path / "whole"))
    assert not saved.parent.exists()
    assert Outcome.FINISHED.value == read_record(out).attrs["status"]
