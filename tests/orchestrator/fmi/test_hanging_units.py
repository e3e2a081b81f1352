"""A unit that does not come back from a call ends the run by name, with what was recorded until then."""

import ctypes
import json
import shutil
import threading
import time
from types import SimpleNamespace

import pytest

from orchestrator.fmi import watchdog
from orchestrator.fmi.watchdog import Watchdog
from orchestrator.outcome import Outcome
from orchestrator.results.record_files import read_record
from tests.faults import fault
from tests.orchestrator.process import done

HUNG = (
    "exit 12, `unit-hung`; unit, call, time; the record up to there in `-partial`, nothing extracted remains"
)


@pytest.fixture
def run(faulty, small_fmus, tmp_path):
    """Run the small train with the bearing; exit status, stderr, folder of the results."""
    (tmp_path / "short.toml").write_text(
        'train = "small"\nend = 0.01\nstep = 1e-4\n[record]\ninterval = 1e-4\n'
    )
    room = tmp_path / "room"
    room.mkdir()

    def start(how, *options):
        status, _, errors = done(
            *("run", tmp_path / "short.toml", "--depth", "v3", "--depth-at", f"rear={faulty}", "--trust"),
            *("--fmus", small_fmus, "--out", tmp_path / "out", "--no-figures", *options),
            env={"FAULT": how, "TMPDIR": str(room)},
        )
        return status, errors

    return start


@pytest.mark.parametrize(
    ("how", "options"),
    [
        pytest.param(
            "sleep",
            (),
            marks=fault(
                "unit",
                "an FMU that waits for ever in a step",
                HUNG,
                guard="orchestrator.fmi.watchdog:Watchdog._watch",
            ),
        ),
        pytest.param(
            "loop",
            ("--threads", 2),
            marks=fault(
                "unit",
                "an FMU in an endless loop, on a thread of its own",
                HUNG,
                guard="orchestrator.fmi.unit:Unit.do_step",
            ),
        ),
    ],
)
def test_a_unit_that_hangs_in_a_step(how, options, run, tmp_path):
    status, errors = run(how, "--budget", 1, *options)
    assert status == Outcome.UNIT_HUNG.status == 12, errors
    assert "unit-hung (exit status 12)" in errors and "rear: fmi2DoStep has not come back for 1" in errors
    partial = tmp_path / "out-partial"
    assert "unit-hung at t = 0.00" in (partial / "PARTIAL.txt").read_text()
    record = read_record(partial)
    assert record.attrs["status"] == "unit-hung" and record["time"].values[-1] == pytest.approx(0.0015)
    assert json.loads((partial / "summary.json").read_text())["finished"] is False
    assert not list((tmp_path / "room").glob("bladeloss_*"))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out-partial", "room", "short.toml"]


@fault(
    "unit",
    "an FMU that hangs before the first step",
    "exit 12, `unit-hung`; unit and call, after ten times the budget, for films may have to be compiled",
    guard="orchestrator.fmi.watchdog:PATIENCE",
)
def test_a_unit_that_hangs_before_the_first_step(run, tmp_path):
    status, errors = run("start", "--budget", 0.2)
    assert status == 12, errors
    assert "rear: " in errors and "has not come back for 2" in errors
    assert not (tmp_path / "out-partial").exists()  # there is nothing to record


@fault(
    "unit",
    "a native FMU that hangs and does not let go of Python's lock",
    "exit 1 after twice the budget; a traceback with the call",
    guard="orchestrator.fmi.watchdog:_arm_last_resort",
)
def test_a_unit_that_keeps_the_lock(run, tmp_path):
    status, errors = run("lock", "--budget", 0.2)
    assert status == 1, errors
    assert "Timeout" in errors and "in do_step" in errors
    assert not (tmp_path / "out").exists()


@fault(
    "unit",
    "a native FMU, which Python's lock would keep the watchdog from watching",
    "it is called without the lock",
    guard="orchestrator.fmi.file:FmuFile.library",
)
def test_native_units_are_called_without_the_lock(store, toy_fmus, tmp_path):
    assert isinstance(store.open(toy_fmus / "spring_damper.fmu").library, ctypes.PyDLL)
    shutil.copy(toy_fmus / "spring_damper.fmu", tmp_path / "native.fmu")
    native = store.open(tmp_path / "native.fmu")
    (native.folder / "resources" / "slavemodule.txt").unlink()
    assert type(native.library) is ctypes.CDLL


def watched(budget, given_up):
    """A watchdog in the time loop, and the unit that it watches."""
    unit = SimpleNamespace(name="rear", call=None)
    dog = Watchdog(budget, given_up.append)
    dog.patience, dog.partial, dog.units = 1.0, str, lambda: [unit]
    return dog, unit


@fault(
    "process",
    "a run that is suspended, or a computer that sleeps, for longer than the budget",
    "the run goes on",
    guard="orchestrator.fmi.watchdog:Watchdog._watch",
)
def test_the_time_of_a_suspended_process_does_not_count(monkeypatch):
    asleep, given_up = threading.Event(), []
    clock = time.monotonic
    monkeypatch.setattr(watchdog.time, "monotonic", lambda: clock() + 1e3 * asleep.is_set())
    dog, unit = watched(3.0, given_up)
    with dog:
        unit.call = ["fmi2DoStep"]
        time.sleep(0.6)
        asleep.set()
        time.sleep(0.6)
        assert not dog.tripped
    assert given_up == []


def test_calls_that_come_back_do_not_add_up():
    given_up = []
    dog, unit = watched(0.4, given_up)
    with dog:
        for _ in range(8):
            unit.call = ["fmi2DoStep"]
            time.sleep(0.1)
    assert given_up == []


def test_one_call_that_lasts_adds_up():
    given_up = []
    dog, unit = watched(0.4, given_up)
    with dog:
        unit.call = ["fmi2DoStep"]
        time.sleep(1.0)
    assert len(given_up) == 1 and "rear: fmi2DoStep has not come back for 0." in given_up[0]
