"""Every way a run can end has a name, advice and an exit status of its own, and says them everywhere."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from fmus.port import Failure
from orchestrator.case.simulate import simulate
from orchestrator.fmi.unit import Status, UnitError
from orchestrator.master import assembly
from orchestrator.master.coupling import LinearImplicit
from orchestrator.master.journal_in_words import with_state
from orchestrator.master.stepping import NotFinite, StepCounts, Stepper
from orchestrator.master.time_loop import RunEnd
from orchestrator.outcome import INPUT_ERROR, PROCESS_DIED, Outcome, outcome_table
from orchestrator.results.result import Result, Timing
from orchestrator.results.summary import summarise
from orchestrator.results.summary_table import to_text
from tests.faults import fault
from tests.orchestrator.oscillator import released
from tests.orchestrator.results import synthetic_record
from tests.orchestrator.toy_train import toy_fmu_folder, toy_scenario

STATE = r"last state of {}: eccentricity ratio [\d.e-]+, tilts \S+ and \S+ urad, least gap \S+ um"


@pytest.fixture(scope="module")
def fmus(toy_fmus, tmp_path_factory):
    return toy_fmu_folder(toy_fmus, tmp_path_factory.mktemp("named"))


def with_springs(monkeypatch, name, **values):
    """Give the bearing of this name parameters beside those of the train."""
    usual = assembly.bearing_parameters

    def parameters(seat, film):
        return usual(seat, film) | (values if seat.name == name else {})

    monkeypatch.setattr(assembly, "bearing_parameters", parameters)


@fault(
    "unit",
    "an outcome without an exit status, or with that of another",
    "every outcome has a status of its own, and 0 is that of a finished run alone",
    guard="orchestrator.outcome:Outcome.FILM_FAILED",
)
def test_every_outcome_has_its_own_exit_status_and_advice():
    statuses = {outcome.status for outcome in Outcome}
    assert len(statuses) == len(Outcome)
    assert [outcome for outcome in Outcome if outcome.status == 0] == [Outcome.FINISHED]
    assert not {1, INPUT_ERROR, PROCESS_DIED} & statuses
    assert len({outcome.advice for outcome in Outcome}) == len(Outcome)
    for outcome in Outcome:
        assert re.fullmatch(r"[a-z]+(-[a-z]+)*", outcome.value)
        assert outcome.advice.endswith(".")


def test_old_numbers_stay():
    """Scripts rely on them."""
    names = (
        "finished no-equilibrium step-refused unit-failed not-finite tolerance-missed unresolved interrupted"
    )
    found = {outcome.value: outcome.status for outcome in Outcome}
    assert [found[name] for name in names.split()] == [0, 3, 4, 5, 6, 9, 10, 130]


@fault(
    "unit",
    "a unit refuses a step for good",
    "step-refused, exit 4; bearing, time, its reason, its last state",
    guard="orchestrator.fmi.unit_error:UnitError.__init__",
)
def test_a_unit_that_refuses_for_good(fmus, tmp_path, monkeypatch):
    with_springs(monkeypatch, "rear", refuse_after=0.0105)
    result = simulate(toy_scenario(tmp_path), fmus)
    assert result.outcome is Outcome.STEP_REFUSED
    assert "at t = 0.010" in result.message
    assert "rear: fmi2DoStep returned discard: 100% of the travel is used up" in result.message
    assert re.search(STATE.format("rear"), result.message)
    assert result.record.attrs["exit_status"] == 4


@fault(
    "unit",
    "an FMU ends with an error that it cannot recover from",
    "unit-failed, exit 5; bearing, time, last state; record up to there",
    guard="orchestrator.fmi.unit_error:UnitError.__init__",
)
def test_a_unit_that_breaks(fmus, tmp_path, monkeypatch):
    with_springs(monkeypatch, "rear", break_after=0.0105)
    result = simulate(toy_scenario(tmp_path), fmus)
    assert result.outcome is Outcome.UNIT_FAILED
    assert "at t = 0.01 s: rear: fmi2DoStep returned" in result.message
    assert re.search(STATE.format("rear"), result.message)
    assert result.record["time"].values[-1] == pytest.approx(0.01)
    assert result.record.attrs["exit_status"] == 5


@fault(
    "film",
    "a film that fails for one step",
    "the step is taken back and halved, the run finishes; discarded steps are counted",
    guard="orchestrator.master.stepping:Stepper._attempt",
)
def test_a_film_that_fails_for_one_step(fmus, tmp_path, monkeypatch):
    window = {"refuse_from": 0.0102, "refuse_to": 0.0112, "refuse_over": 6e-4}
    with_springs(monkeypatch, "front", **window)
    result = simulate(toy_scenario(tmp_path), fmus)
    assert result.outcome is Outcome.FINISHED, result.message
    assert result.counts.discarded == 1
    assert result.record.attrs["discarded_steps"] == 1
    assert "1 discarded by a unit" in to_text(summarise(result))


@fault(
    "coupling",
    "a step misses its tolerance at every length",
    "tolerance-missed, exit 9; time, the worst bearing and its last state, the defect, what is allowed",
    guard="orchestrator.master.stepping:Stepper._problem",
)
def test_a_tolerance_that_cannot_be_met(fmus, tmp_path):
    blade = {"wheel": "wheel", "unbalance": 0.1, "time": 0.0205}
    result = simulate(toy_scenario(tmp_path, event=blade, tolerance=1e-30), fmus)
    assert result.outcome is Outcome.TOLERANCE_MISSED
    named = re.search(r"at t = \S+ s: (front|rear): relative defect .* allowed is 1e-30", result.message)
    assert named and re.search(STATE.format(named[1]), result.message)
    assert result.record.attrs["status"] == "tolerance-missed"
    assert result.record.attrs["exit_status"] == 9


@fault(
    "coupling",
    "a journal's motion is no longer a number",
    "not-finite, exit 6; the bearing is named, the step taken back",
    guard="orchestrator.master.stepping:Stepper._problem",
)
def test_a_motion_that_is_not_finite_names_the_bearing(store, toy_fmus):
    system = released(store, toy_fmus)
    before = system.journals.copy()
    scheme = LinearImplicit()

    def advance(system, time, step, _common):
        done = LinearImplicit.advance(scheme, system, time, step)
        system.responses[0, 0] = np.nan
        return done._replace(defect=np.full_like(done.defect, np.nan))

    broken = type("Broken", (LinearImplicit,), {"advance": lambda self, *a: advance(*a)})()
    stepper = Stepper(system, broken, None, lambda *_: None)
    with pytest.raises(
        NotFinite, match=f"^{system.bearings[0].name}: the motion of the journal is not finite"
    ):
        stepper.cross(0.0, 1e-3, 1e-3)
    np.testing.assert_array_equal(system.journals, before)
    system.close()


def test_a_rotor_that_fails_shows_the_bearing_farthest_out(store, toy_fmus):
    system = released(store, toy_fmus)
    end = RunEnd(Outcome.STEP_REFUSED, "at t = 0 s: rotor", "rotor", 0.0, StepCounts(), 0.0, 0.0)
    assert re.search(STATE.format(system.bearings[0].name), with_state(end, system, np.zeros((1, 4))))
    stopped = RunEnd(Outcome.INTERRUPTED, "at t = 0 s", "", 0.0, StepCounts(), 0.0, 0.0)
    assert with_state(stopped, system, np.zeros((1, 4))) == "at t = 0 s"
    system.close()


@pytest.mark.parametrize("outcome", [outcome for outcome in Outcome if not outcome.ok])
@fault(
    "process",
    "a run that did not finish is read by a script",
    "summary.json and summary.txt: outcome, exit status, message, advice",
    guard="orchestrator.results.summary:summarise",
)
def test_the_summary_says_outcome_status_message_and_advice(outcome):
    record = synthetic_record.record(end=1.1)
    timing = Timing(1, 1, 1, 1, 1, 1, 1)
    found = summarise(Result(record, outcome, "LP2-front: gap below zero", timing, 11000, 22000))
    data = json.loads(found.to_json())
    assert (data["outcome"], data["exit_status"]) == (outcome.value, outcome.status)
    assert (data["advice"], data["message"]) == (outcome.advice, "LP2-front: gap below zero")
    assert data["finished"] is False
    text = " ".join(to_text(found).split())
    assert f"{outcome.value} (exit status {outcome.status})" in text
    assert outcome.advice in text and "LP2-front: gap below zero" in text


def test_a_unit_error_carries_the_outcome():
    film = UnitError("front", "fmi2DoStep", Status.DISCARD, "front: GAP_CLOSED", Failure.FILM)
    other = UnitError("front", "fmi2DoStep", Status.DISCARD, "film failed, says a message", Failure.STEP)
    broken = UnitError("front", "fmi2DoStep", Status.FATAL, "film failed", Failure.FILM)
    outcomes = [error.outcome for error in (film, other, broken)]
    assert outcomes == [Outcome.FILM_FAILED, Outcome.STEP_REFUSED, Outcome.UNIT_FAILED]


@fault(
    "process",
    "the page for users leaves out a way a run can end",
    "README.md has the table of outcomes and exit statuses, word for word that of the program",
    guard="orchestrator.outcome:Outcome.FINISHED",
)
def test_the_readme_has_every_outcome_with_its_status_and_advice():
    readme = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    table = re.search(r"<!-- outcomes -->\n(.*?)<!-- /outcomes -->", readme, re.DOTALL)
    assert table and table[1].strip() == outcome_table().strip()
