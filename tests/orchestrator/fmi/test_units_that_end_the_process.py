"""Trusted units that end the process or change it: no success without results, and no results elsewhere."""

import pytest

from orchestrator.results.record_files import read_record
from tests.faults import fault
from tests.orchestrator.process import done

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
@pytest.mark.parametrize(("how", "status"), [("os._exit", 5), ("exit", 5), ("end", 8)])
def test_no_success_without_results(how, status, faulty, small_fmus, tmp_path):
    code, said, errors = run(how, faulty, small_fmus, tmp_path)
    assert code == status, said + errors
    assert errors.startswith("error: ") and "Traceback" not in errors and not (tmp_path / "out").exists()


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
