"""The energy ledger: closed forms on the oscillator, and what the couplings make of it on the small train."""

import numpy as np
import pytest

from orchestrator.case.simulate import simulate
from orchestrator.master.coupling import LinearImplicit
from orchestrator.master.stepping import Stepper
from orchestrator.observers.ledger import Ledger
from orchestrator.outcome import Outcome
from orchestrator.results.summary import summarise
from orchestrator.results.summary_table import to_text
from orchestrator.scenario.file import load_scenario
from tests.orchestrator.oscillator import DISPLACEMENT, released


@pytest.fixture(scope="module")
def fmus(train_fmus):
    return train_fmus


def ledger_of(fmus, outcome=Outcome.FINISHED, **change):
    base = {"depth": "v3", "end": 12e-3, "event": {"time": 4.1e-3}, "ledger": True}
    result = simulate(load_scenario("small", {**base, **change}), fmus)
    assert result.outcome is outcome, result.message
    return summarise(result).ledger


def test_the_work_of_a_spring_is_what_its_potential_loses(store, toy_fmus):
    """Without damping W = k/2 (q0^2 - q1^2); a linear law leaves the coupling nothing to create."""
    system = released(store, toy_fmus, stiffness=1e6, damping=0.0)
    ledger = Ledger(system)
    stepper = Stepper(system, LinearImplicit(), None, lambda t, end, a: ledger.watch(t, end, a))
    ledger.begin(stepper)
    for k in range(40):
        stepper.cross(k * 2e-4, (k + 1) * 2e-4, 2e-4)
    balance = ledger.balance()
    lost = 0.5e6 * (DISPLACEMENT**2 - system.journals[0, 0] ** 2)
    assert balance.bearings[0, 0] == pytest.approx(lost, rel=5e-5)  # the journal's path as a cubic
    np.testing.assert_allclose(balance.residue, 0.0, atol=1e-12 * balance.exchanged)
    assert not balance.bearings[1].any()
    system.close()


def test_the_ledger_closes_with_linear_implicit_coupling(fmus):
    coarse, fine = (ledger_of(fmus, step=step) for step in (1e-4, 5e-5))
    assert abs(coarse.relative_gap) < 1e-4
    assert abs(fine.relative_gap) < 0.3 * abs(coarse.relative_gap)
    assert coarse.gap == pytest.approx(sum(row.residue for row in coarse.bearings), rel=0.1)
    assert coarse.unbalance > 0.0 and coarse.damping > 0.0


def test_the_ledger_closes_best_with_newton(fmus):
    assert abs(ledger_of(fmus, coupling="newton").relative_gap) < 1e-6


def test_the_ledger_shows_what_explicit_coupling_creates(fmus):
    """And the run says itself that its numbers mean nothing."""
    explicit = ledger_of(fmus, Outcome.UNRESOLVED, coupling="gauss-seidel", step=2e-5, end=6e-3)
    assert explicit.relative_gap > 0.1
    assert all(row.residue > 0.0 for row in explicit.bearings)


def test_the_summary_tells_the_balance(fmus):
    scenario = load_scenario("small", {"depth": "v3", "end": 4e-3, "event": None, "ledger": True})
    summary = summarise(simulate(scenario, fmus))
    assert "% of the work exchanged; most at" in to_text(summary)
    assert '"relative_gap"' in summary.to_json()
    plain = simulate(load_scenario("small", {"depth": "v3", "end": 4e-3, "event": None}), fmus)
    assert summarise(plain).ledger is None
    np.testing.assert_array_equal(plain.record["force"], simulate(scenario, fmus).record["force"])
