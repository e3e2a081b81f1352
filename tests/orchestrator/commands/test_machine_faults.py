"""Full disks and folders that cannot be written to: said before the run, or survived, or an outcome."""

import pytest

from orchestrator.case import conclude as conclude_case
from orchestrator.case import record_so_far
from orchestrator.case.checkpoint_folder import checkpoint_folder
from orchestrator.commands import campbell as campbell_command
from orchestrator.commands import run as run_command
from orchestrator.observers import checkpoint
from orchestrator.outcome import INPUT_ERROR, Outcome
from orchestrator.results import files as result_files
from orchestrator.results import folder as result_folder
from orchestrator.results.growing_record import HEAD_FILE, ROWS_FILE
from orchestrator.results.record_files import read_record
from tests.faults import fault
from tests.orchestrator.foreign import call
from tests.orchestrator.limits import under_limit
from tests.orchestrator.process import done

NOT_WRITTEN = Outcome.NOT_WRITTEN.status


@pytest.fixture
def short(tmp_path):
    text = 'train = "small"\nend = 0.01\ndepth = "v3"\n[record]\ninterval = 1e-4\n'
    (tmp_path / "short.toml").write_text(text)
    return tmp_path / "short.toml"


def run(short, fmus, *options):
    out = short.parent / "out"
    return call("run", short, "--fmus", fmus, "--out", out, *options), out


@fault(
    "machine",
    "a full disk when the results are written",
    "exit 13, `not-written`; folder, needed and free room; no folder; the checkpoint is kept",
    guard="orchestrator.results.files:room_for",
)
def test_a_full_disk_at_the_end_of_a_run(short, small_fmus, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr(conclude_case, "write_all", under_limit(10_000, conclude_case.write_all))
        result, out = run(short, small_fmus, "--no-figures", "--checkpoint", 0.004)
    assert result.exit_code == NOT_WRITTEN == 13, result.output
    assert f"not-written (exit status 13): {out}: results not written: File too large" in result.stderr
    assert "MB are needed" in result.stderr and "MB are free" in result.stderr
    names = sorted(path.name for path in short.parent.iterdir())
    assert names == ["out-checkpoint", "short.toml"]
    assert "bladeloss resume" in result.stderr and "out-running" not in result.stderr
    assert call("resume", out).exit_code == 0
    assert read_record(out).attrs["status"] == "finished" and not checkpoint_folder(out).exists()


@fault(
    "machine",
    "a full disk at the end of a long run without checkpoints",
    "exit 13, `not-written`; the record stays beside, can be read, and goes with the next run",
    guard="orchestrator.commands.run:run_case",
)
def test_a_record_that_grew_outlives_a_full_disk(short, small_fmus, monkeypatch):
    monkeypatch.setattr(record_so_far, "HELD", 10_000)
    with monkeypatch.context() as patch:
        patch.setattr(conclude_case, "write_all", under_limit(10_000, conclude_case.write_all))
        result, out = run(short, small_fmus, "--no-figures")
    assert result.exit_code == NOT_WRITTEN, result.output
    running = out.with_name("out-running")
    assert f"The record is kept in {running}" in result.stderr
    kept = read_record(running)
    assert kept.sizes["time"] == 101
    assert run(short, small_fmus, "--no-figures")[0].exit_code == 0
    assert not running.exists() and read_record(out)["force"].identical(kept["force"])


@fault(
    "machine",
    "a full disk when the figures are drawn",
    "exit 13, `not-written`; record and summary are there, PARTIAL.txt says that the figures are not",
    guard="orchestrator.results.files:data_then_figures",
)
def test_a_full_disk_while_figures_are_drawn(short, small_fmus, monkeypatch):
    monkeypatch.setattr(result_files, "add_figures", under_limit(1000, result_files.add_figures))
    result, out = run(short, small_fmus)
    assert result.exit_code == NOT_WRITTEN, result.output
    assert (out / "PARTIAL.txt").read_text() == result_files.NO_FIGURES
    assert read_record(out).attrs["status"] == "finished" and not (out / "figures").exists()


@fault(
    "machine",
    "a disk that is full for HDF5, which ends the process when it cannot close a file",
    "HDF5 does not learn of it: an error, and no file",
    guard="orchestrator.results.record_files:write_record",
)
def test_hdf5_does_not_end_the_process(tmp_path):
    code = """
import sys, pathlib, numpy, xarray
from orchestrator.results.record_files import write_record
from tests.orchestrator.limits import largest_file
record = xarray.Dataset({"x": ("time", numpy.random.default_rng(1).random(100_000))})
try:
    with largest_file(40_000):
        write_record(record, pathlib.Path(sys.argv[1]))
except OSError as error:
    print(error.strerror)
"""
    status, said, errors = done(tmp_path / "out", code=code)
    assert (status, said) == (0, "File too large\n"), errors
    assert list((tmp_path / "out").iterdir()) == []


@fault(
    "machine",
    "a disk that is full for some time while checkpoints are written",
    "a warning with file, time and reason; the checkpoint before stays whole, and the run goes on",
    guard="orchestrator.observers.checkpoint:Checkpoints.save",
)
def test_a_checkpoint_that_cannot_be_written(short, small_fmus, monkeypatch):
    write, times = checkpoint.write, []

    def short_of_room(path, meta, arrays):
        (under_limit(1000, write) if 0.003 < meta["time"] < 0.007 else write)(path, meta, arrays)
        times.append(meta["time"])

    monkeypatch.setattr(checkpoint, "write", short_of_room)
    monkeypatch.setattr(run_command, "discard", lambda _: None)
    result, out = run(short, small_fmus, "--no-figures", "--checkpoint", 0.002)
    assert result.exit_code == 0, result.output
    assert times == pytest.approx([0.0, 0.002, 0.008, 0.01])
    assert (
        "warning:" in result.stderr and "no checkpoint at t = 0.004 s, the one before stays" in result.stderr
    )
    names = {path.name for path in checkpoint_folder(out).iterdir()}
    assert names == {checkpoint.FILE, HEAD_FILE, ROWS_FILE}


@fault(
    "machine",
    "a place for checkpoints that is no folder, or cannot be written to",
    "exit 2 before the run; path",
    guard="orchestrator.case.prepare:prepare",
)
def test_checkpoints_that_could_never_be_written(short, small_fmus):
    (short.parent / "out-checkpoint").write_text("mine")
    result, _ = run(short, small_fmus, "--checkpoint", 0.002)
    assert result.exit_code == INPUT_ERROR, result.output
    assert "out-checkpoint: is a file" in result.stderr and "loading" not in result.output


@fault(
    "machine",
    "a read-only folder for the results",
    "exit 2 before the run; folder and reason",
    guard="orchestrator.results.folder:check_writable",
)
def test_results_that_could_never_be_written(short, small_fmus):
    result = call("run", short, "--fmus", small_fmus, "--out", "/proc/out")
    assert result.exit_code == INPUT_ERROR, result.output
    assert "/proc/out: nothing can be written in /proc: " in result.stderr and "loading" not in result.output


@fault(
    "machine",
    "a disk that has less room than the record will need",
    "exit 2 before the run; folder, needed and free room",
    guard="orchestrator.results.folder:check_room",
)
@pytest.mark.parametrize("command", ["run", "compare"])
def test_a_disk_with_too_little_room(command, short, small_fmus, monkeypatch):
    monkeypatch.setattr(result_folder, "free_room", lambda _: 1000)
    out = short.parent / "out"
    result = call(command, short, "--fmus", small_fmus, "--out", out)
    assert result.exit_code == INPUT_ERROR, result.output
    assert f"{out}: the record takes 0." in result.stderr and "0.001 are free" in result.stderr
    assert "loading" not in result.output and not out.exists()


@fault(
    "machine",
    "a read-only folder for the FMUs",
    "exit 2; folder, `FMUs cannot be built there`, reason",
    guard="orchestrator.fmi.folder:ensure_fmus",
)
def test_fmus_that_cannot_be_built(short):
    result, _ = run(short, "/proc/fmus")
    assert result.exit_code == INPUT_ERROR, result.output
    assert "/proc/fmus: FMUs cannot be built there: " in result.stderr


@fault(
    "machine",
    "a full disk when an investigation of the linearised train is written",
    "exit 13; folder, needed and free room; no folder",
    guard="orchestrator.linear.case:write_results",
)
def test_a_full_disk_at_the_end_of_a_linear_command(tmp_path, monkeypatch):
    monkeypatch.setattr(campbell_command, "write_results", under_limit(100, campbell_command.write_results))
    result = call("campbell", "small", "--count", 2, "--out", tmp_path / "out")
    assert result.exit_code == NOT_WRITTEN, result.output
    assert f"{tmp_path / 'out'}: results not written: File too large" in result.stderr
    assert list(tmp_path.iterdir()) == []
