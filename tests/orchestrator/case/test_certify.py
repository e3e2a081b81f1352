"""The certificate: the same run at half the step, and what changes."""

import json
from dataclasses import replace
from io import StringIO

import pytest
from rich.console import Console

from orchestrator.case.case import folder_case
from orchestrator.case.certify import at_half_step, certify
from orchestrator.case.simulate import execute, simulate
from orchestrator.commands.run import RunRequest, run_case
from orchestrator.outcome import Outcome
from orchestrator.results.record_files import read_record
from orchestrator.results.summary import summarise
from orchestrator.scenario.file import train_of
from tests.faults import fault
from tests.orchestrator.toy_train import toy_fmu_folder, toy_scenario

BLADE = {"wheel": "wheel", "unbalance": 0.1, "time": 0.0205}


@pytest.fixture(scope="module")
def fmus(toy_fmus, tmp_path_factory):
    return toy_fmu_folder(toy_fmus, tmp_path_factory.mktemp("named"))


def test_half_the_step_is_recorded_at_the_same_instants(tmp_path):
    scenario = toy_scenario(tmp_path, record={"interval": 2.4e-3}, tolerance=1e-3)
    half = at_half_step(scenario)
    assert (half.step, half.record.interval, half.tolerance) == (5e-4, 2e-3, 2.5e-4)
    assert half.end == scenario.end


def test_every_number_of_the_summary_is_compared(fmus, tmp_path):
    scenario = toy_scenario(tmp_path, event=BLADE, end=0.1)
    summary, half = (summarise(simulate(s, fmus)) for s in (scenario, at_half_step(scenario)))
    certificate = certify(summary, half)
    assert certificate.step == 5e-4
    row, other = summary.bearings[0], half.bearings[0]
    found = next(
        d
        for d in certificate.differences
        if (d.quantity, d.bearing, d.phase) == ("force_max", row.bearing, row.phase)
    )
    assert (found.value, found.at_half_step) == (row.force_max, other.force_max)
    assert found.difference == row.force_max - other.force_max
    assert found.relative == pytest.approx(abs(found.difference) / max(row.force_max, other.force_max))
    assert 0.0 < certificate.largest("force_max").relative < 0.05
    numbers = len(vars(row)) - 2, len(vars(summary.shaft[0])) - 1
    expected = numbers[0] * len(summary.bearings) + numbers[1] * len(summary.shaft)
    assert len(certificate.differences) == expected


def test_a_run_equals_itself(fmus, tmp_path):
    summary = summarise(simulate(toy_scenario(tmp_path, event=BLADE), fmus))
    assert all(not d.difference for d in certify(summary, summary).differences)


def certified(fmus, tmp_path, **changes):
    """Certificate of a run that half the step would change by these factors."""
    summary = summarise(simulate(toy_scenario(tmp_path, event=BLADE), fmus))
    rows = [
        replace(row, **{name: factor * getattr(row, name) for name, factor in changes.items()})
        for row in summary.bearings
    ]
    return certify(summary, replace(summary, bearings=tuple(rows)))


def test_a_change_of_more_than_a_tenth_is_a_doubt(fmus, tmp_path):
    assert certified(fmus, tmp_path).doubt == ""
    assert certified(fmus, tmp_path, force_max=1.10).doubt == ""
    doubt = certified(fmus, tmp_path, force_max=1.12).doubt
    assert (
        doubt.startswith("at half the step force max (") and "a change of 10.7 %; allowed are 10 %" in doubt
    )


def test_what_is_next_to_nothing_may_double(fmus, tmp_path):
    """A least gap counts by the mean gap, a small moment by the largest of the run."""
    summary = summarise(simulate(toy_scenario(tmp_path, event=BLADE), fmus))
    touching = replace(summary.bearings[0], least_gap_min=1e-7)
    pair = [
        replace(summary, bearings=(replace(touching, least_gap_min=gap), *summary.bearings[1:]))
        for gap in (1e-7, 2e-7)
    ]
    assert certify(*pair).doubt == ""
    apart = replace(touching, least_gap_min=-0.2 * touching.least_gap_mean)
    assert (
        "least gap min" in certify(pair[0], replace(summary, bearings=(apart, *summary.bearings[1:]))).doubt
    )


@fault(
    "process",
    "half the step changes what a run says by more than a tenth",
    "unresolved, exit 10; quantity, bearing, both values; in summary and record, too",
    guard="orchestrator.case.conclude:_certified",
)
def test_a_run_that_half_the_step_contradicts_is_no_success(fmus, tmp_path, monkeypatch):

    def harder_at_half(case, *arguments):
        result = execute(case, *arguments)
        if case.scenario.step < 1e-3:
            harder = result.record.assign(force_magnitude_max=1.64 * result.record["force_magnitude_max"])
            result = replace(result, record=harder)
        return result

    monkeypatch.setattr("orchestrator.case.carry_out.execute", harder_at_half)
    said = StringIO()
    request = RunRequest("toy", out=tmp_path / "out", fmus=fmus, formats=(), certify=True)
    with folder_case(toy_scenario(tmp_path, event=BLADE), train_of(toy_scenario(tmp_path)), fmus) as case:
        assert run_case(case, request, Console(quiet=True), Console(file=said, width=200)) == 10
    assert "unresolved (exit status 10): the certificate: at half the step force max" in said.getvalue()
    left = tmp_path / "out-partial"
    assert json.loads((left / "summary.json").read_text())["exit_status"] == 10
    assert read_record(left).attrs["status"] == "unresolved"


def test_the_command_writes_the_certificate(fmus, tmp_path):
    scenario = toy_scenario(tmp_path, event=BLADE, end=0.1, ledger=True)
    out, console = tmp_path / "out", Console(quiet=True)
    request = RunRequest("toy", out=out, fmus=fmus, formats=(), certify=True)
    with folder_case(scenario, train_of(scenario), fmus) as case:
        assert run_case(case, request, console, console) == 0
    text = (out / "summary.txt").read_text()
    assert "at half the step, 0.5 ms: largest changes force mean" in " ".join(text.split())
    data = json.loads((out / "summary.json").read_text())
    assert data["certificate"]["outcome"] == "finished"
    assert data["ledger"]["bearings"][0]["bearing"] == "front"
    assert read_record(out).attrs["half_step_force_max"] < 0.05


@fault(
    "process",
    "the certificate's run at half the step fails",
    "the results are written; exit status of that run, and that it was the certificate's",
    guard="orchestrator.case.conclude:conclude",
)
def test_a_failed_certificate_is_no_success(fmus, tmp_path, monkeypatch):

    def failing_at_half(case, *arguments):
        result = execute(case, *arguments)
        failed = {"outcome": Outcome.TOLERANCE_MISSED, "message": "at t = 0.02 s: too far"}
        return replace(result, **failed) if case.scenario.step < 1e-3 else result

    monkeypatch.setattr("orchestrator.case.carry_out.execute", failing_at_half)
    scenario = toy_scenario(tmp_path, event=BLADE, end=0.05)
    said = StringIO()
    request = RunRequest("toy", out=tmp_path / "out", fmus=fmus, formats=(), certify=True)
    with folder_case(scenario, train_of(scenario), fmus) as case:
        status = run_case(case, request, Console(quiet=True), Console(file=said, width=200))
    assert status == 9
    assert "tolerance-missed (exit status 9): the certificate's run at half the step" in said.getvalue()
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["outcome"] == "finished"
