"""A record is on the disk as it grows, and what is lost of it is said."""

import os
from dataclasses import replace

import numpy as np
import pytest

from orchestrator.case import record_so_far
from orchestrator.case.simulate import Execution, simulate
from orchestrator.errors import NotWrittenError
from orchestrator.observers import checkpoint
from orchestrator.observers.checkpoint import CheckpointError, Checkpoints
from orchestrator.observers.recorder import Recorder
from orchestrator.report.source import load_results
from orchestrator.results import growing_record
from orchestrator.results.growing_record import HEAD_FILE, ROWS_FILE, open_growing
from orchestrator.results.record_files import read_record, write_record
from tests.faults import fault
from tests.orchestrator.observers.killed import BLADE, Killed, killed_at
from tests.orchestrator.toy_train import toy_scenario


def test_the_record_is_written_as_it_goes(toy, tmp_path):
    """Killed twice, gone on with once: the files are the record up to there, and go on to be it."""
    scenario = toy_scenario(tmp_path, event=BLADE, record={"interval": 3e-3, "revolutions": True}, end=0.1)
    whole = simulate(scenario, toy).record
    folder = tmp_path / "saved"
    with pytest.raises(Killed):
        simulate(scenario, toy, killed_at(0.053), Execution(Checkpoints(folder, 2e-2, {})))
    with (folder / ROWS_FILE).open("ab") as file:
        file.write(b"of a block that was not finished")
    saved = checkpoint.read(folder)
    with pytest.raises(Killed):
        simulate(scenario, toy, killed_at(0.088), Execution(Checkpoints(folder, 2e-2, {}), saved))
    found = read_record(folder)
    assert found.attrs["status"] == "running"
    assert (found.sizes["time"], found.sizes["revolution"]) == (28, 1)
    before = whole.isel(time=slice(28), revolution=slice(1))
    for name in set(whole.variables) - {name for name in whole.variables if "of_run" in name}:
        assert found[name].dims == whole[name].dims
        np.testing.assert_array_equal(found[name].values, before[name].values, err_msg=name)
    (source,) = load_results([folder])
    assert source.record.sizes["time"] == 28


def test_what_is_written_is_not_in_memory(toy, tmp_path, monkeypatch):
    """Record, table and what is read of single series are those of a run in memory, to the bit."""
    scenario = toy_scenario(tmp_path, event=BLADE, record={"interval": 1e-3, "revolutions": True}, end=0.2)
    whole = simulate(scenario, toy).record
    monkeypatch.setattr(record_so_far, "HELD", 20_000)
    lines = []
    execution = Execution(record=tmp_path / "running", warn=lines.append)
    found = simulate(scenario, toy, None, execution).record
    growing = open_growing(tmp_path / "running")
    assert len(growing.blocks) > 5 and not lines
    assert growing.counts == (201, whole.sizes["revolution"])
    assert found["force"].variable._in_memory is False
    for key in (
        {"bearing": 0},
        {"time": [3, 150, 20]},
        {"time": slice(190, 3, -40), "axis": 1},
        {"time": -1},
    ):
        np.testing.assert_array_equal(found["force"].isel(key).values, whole["force"].isel(key).values)
    write_record(found, tmp_path / "one")
    write_record(whole, tmp_path / "other")
    assert read_record(tmp_path / "one").identical(whole)
    one, other = ((tmp_path / name / "record.csv").read_bytes() for name in ("one", "other"))
    assert one == other


@fault(
    "machine",
    "the record so far of a long run is removed while it goes on",
    "exit 13, `not-written`; file and bytes that are gone",
    guard="orchestrator.case.record_so_far:RecordSoFar",
)
def test_a_record_so_far_that_is_removed(toy, tmp_path, monkeypatch):
    monkeypatch.setattr(record_so_far, "HELD", 0)
    scenario = toy_scenario(tmp_path, event=BLADE, record={"interval": 1e-3}, end=0.05)

    def remove(_, time):
        if time > 0.03:
            (tmp_path / "running" / ROWS_FILE).unlink(missing_ok=True)

    with pytest.raises(NotWrittenError, match=r"record-rows\.bin: has 0 bytes of \d+"):
        simulate(scenario, toy, remove, Execution(record=tmp_path / "running"))


def test_a_run_that_hangs_between_evaluations(toy, tmp_path, monkeypatch):
    """With many rates, some rows written, some complete, some waiting: the record is of the complete ones."""
    monkeypatch.setattr(record_so_far, "HELD", 5_000)
    scenario = toy_scenario(
        tmp_path, event=BLADE, record={"interval": 1e-3}, end=0.05, coupling="multirate", tolerance=1e-4
    )
    execution, found = Execution(record=tmp_path / "running"), []

    def hang(_, time):
        if time > 0.0135 and not found:
            assert open_growing(tmp_path / "running").counts == (10, 0)
            found.append(execution.watchdog.partial("it hangs").record.load())

    whole = simulate(scenario, toy, hang, execution).record
    (record,) = found
    assert record["time"].values[-1] == pytest.approx(0.012)  # two rows wait
    for name in ("time", "force", "force_magnitude_max", "least_gap_min"):
        same = whole[name].values[: record.sizes["time"]]
        np.testing.assert_array_equal(record[name].values, same, err_msg=name)


def test_a_copy_of_what_is_kept_stays_as_it_is_though_the_run_goes_on(toy, tmp_path, monkeypatch):
    """As where a unit that was given up comes back."""
    scenario = toy_scenario(tmp_path, event=BLADE, end=0.05, coupling="multirate", tolerance=1e-4)
    execution, copies, sizes, made = Execution(), [], [], Recorder.copy
    monkeypatch.setattr(Recorder, "copy", lambda self: copies.append(made(self)) or copies[-1])

    def hang(_, time):
        if time > 0.0135 and not sizes:
            execution.watchdog.partial("it hangs")
            sizes.append(len(copies[0].times))

    simulate(scenario, toy, hang, execution)
    assert len(copies[0].times) == len(copies[0].speeds) == sizes[0] > 2


@fault(
    "process",
    "a checkpoint whose record so far is gone, cut off, or another run's",
    "exit 2; file, what it holds, what the checkpoint goes on from",
    guard="orchestrator.case.record_so_far:RecordSoFar.go_on",
)
@pytest.mark.parametrize(
    ("harm", "said"),
    [
        (lambda folder: (folder / HEAD_FILE).unlink(), "no record of a run that goes on"),
        (lambda folder: (folder / HEAD_FILE).write_bytes(b"PK"), "no record of a run that goes on"),
        (lambda folder: (folder / ROWS_FILE).unlink(), "has 0 bytes of"),
        (lambda folder: os.truncate(folder / ROWS_FILE, 1000), "has 1000 bytes of"),
        (lambda folder: _other_series(folder), "is of a record with other series"),
        (lambda folder: _other_rows(folder), "none of which ends at the 5 and 0 that are asked for"),
    ],
)
def test_a_record_so_far_that_does_not_fit_is_refused(harm, said, toy, tmp_path):
    scenario, folder = toy_scenario(tmp_path, event=BLADE, record={"interval": 1e-3}), tmp_path / "saved"
    with pytest.raises(Killed):
        simulate(scenario, toy, killed_at(0.0041), Execution(Checkpoints(folder, 2e-3, {})))
    saved = checkpoint.read(folder)
    harm(folder)
    with pytest.raises(CheckpointError, match=said) as caught:
        simulate(scenario, toy, None, Execution(None, saved))
    assert str(folder) in str(caught.value) and "put the files back, or start anew" in str(caught.value)


def _other_series(folder):
    growing = open_growing(folder)
    replace(growing, rest=growing.rest.drop_vars("moment")).write_head()


def _other_rows(folder):
    growing = open_growing(folder)
    replace(growing, blocks=growing.blocks[1:]).write_head()


@fault(
    "machine",
    "a full disk while the record is written as it goes",
    "the run goes on, says so, and holds the instants until they can be written",
    guard="orchestrator.case.record_so_far:RecordSoFar.write",
)
def test_a_file_that_cannot_be_written_is_made_up_for(toy, tmp_path, monkeypatch):
    scenario, folder, told = toy_scenario(tmp_path, event=BLADE), tmp_path / "saved", []
    made, failing = growing_record._without_rows, iter([False, True])

    def without_rows(data):
        if next(failing, False):
            raise OSError("disk full")
        return made(data)

    monkeypatch.setattr(growing_record, "_without_rows", without_rows)
    with pytest.raises(Killed):
        simulate(scenario, toy, killed_at(0.0141), Execution(Checkpoints(folder, 4e-3, {}), warn=told.append))
    assert len(told) == 1
    assert "disk full" in told[0]
    np.testing.assert_allclose(read_record(folder)["time"], 1e-3 * np.arange(13), atol=1e-12)
