"""Trusted units that end the process or change it: no success without results, and no results elsewhere."""

import signal

import pytest

from orchestrator.results.record_files import read_record
from tests.faults import fault
from tests.marks import slow
from tests.orchestrator.process import command, done

SHORT = 'train = "small"\nend = 0.003\ndepth = "v3"\n[record]\ninterval = 1e-3\n'


def run(how, faulty, small_fmus, folder):
    (folder / "s.toml").write_text(SHORT)
    options = ("--fmus", small_fmus, "--depth-at", f"rear={faulty}", "--trust", "--no-figures")
    return done("run", "s.toml", *options, "--out", "out", cwd=folder, env={"FAULT": how})


@fault(
    "unit",
    "a trusted unit that ends the process with status 0",
    "exit 8, or 5 with `unit-failed`; never 0",
    guard="orchestrator.case.own_process:undisturbed",
)
@pytest.mark.parametrize(("how", "status"), [("os._exit", 5), slow("exit", 5), ("end", 8)])
def test_no_success_without_results(how, status, faulty, small_fmus, tmp_path):
    code, said, errors = run(how, faulty, small_fmus, tmp_path)
    assert code == status, said + errors
    assert errors.startswith("error: ") and "Traceback" not in errors and not (tmp_path / "out").exists()


@fault(
    "unit",
    "a trusted unit whose native code calls `_exit(0)`, or crashes",
    "exit 8 by the parent process, which loads no unit",
    guard="orchestrator.case.watched:part",
)
@pytest.mark.parametrize(("how", "said"), [("_exit", "with status 0"), ("signal", "by signal 11")])
def test_no_end_past_all_guards(how, said, faulty, small_fmus, tmp_path):
    code, _, errors = run(how, faulty, small_fmus, tmp_path)
    assert code == 8
    assert errors == f"error: a unit ended the process of the run {said}; there are no results\n"
    assert not (tmp_path / "out").exists()


PARTED = """
import signal, sys, time
from orchestrator.case import watched
with watched.command():
    watched.part()
    def end(sent, _):
        sys.exit(128 + sent)
    for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(sent, end)
    print("begun", flush=True)
    time.sleep(20)
"""


@pytest.mark.parametrize(
    "sent",
    [signal.SIGTERM, slow(signal.SIGINT), slow(signal.SIGHUP)],
)
def test_signals_reach_the_run_behind_its_parent(sent, tmp_path):
    process = command(code=PARTED, cwd=tmp_path)
    assert process.stdout.readline() == "begun\n"
    process.send_signal(sent)
    said, errors = process.communicate(timeout=20)
    assert (process.returncode, said, errors) == (128 + sent, "", "")


@fault(
    "unit",
    "a trusted unit that changes the working folder and the mask of files",
    "the results lie where they were to go",
    guard="orchestrator.case.own_process:undisturbed",
)
def test_results_go_where_they_were_to_go(faulty, small_fmus, tmp_path):
    code, said, errors = run("folder", faulty, small_fmus, tmp_path)
    assert code == 0, said + errors
    assert read_record(tmp_path / "out").attrs["status"] == "finished"
    assert not (tmp_path / "out" / "record.nc").stat().st_mode & 0o002
