"""Every coupling converges to the holistic model of the small train, through its fracture, with its order."""

import numpy as np
import pytest

from orchestrator.case.simulate import simulate
from orchestrator.fmi.file import FmuStore
from orchestrator.master.assembly import assemble
from orchestrator.master.coupling import SCHEMES
from orchestrator.master.start.equilibrium import find_start
from orchestrator.outcome import Outcome
from orchestrator.scenario.file import load_scenario, train_of
from tests.marks import slow
from tests.monolithic.holistic import holistic_model
from tests.monolithic.integrate import integrate

END, INTERVAL = 6e-3, 4e-4  # s
RUN = {"end": END, "event": {"time": 2.13e-3}, "record": {"interval": INTERVAL}}
TIMES = INTERVAL * np.arange(round(END / INTERVAL) + 1)

STEPS = {"jacobi": (2e-6, 1e-6), "gauss-seidel": (4e-6, 2e-6)}
"""Of the explicit couplings: of first order, and stable only where the films' damping allows it [s]."""

IMPLICIT_STEPS = (1e-4, 5e-5, 2.5e-5)  # s


def small(**overrides):
    return load_scenario("small", {**RUN, **overrides})


@pytest.fixture(scope="module")
def fmus(train_fmus):
    return train_fmus


@pytest.fixture(scope="module")
def model(fmus):
    scenario = small()
    train = train_of(scenario)
    with FmuStore() as store:
        system = assemble(scenario, train, fmus, store)
        start = find_start(system, train, train.speed)
        system.close()
    return holistic_model(scenario, train, start)


@pytest.fixture(scope="module")
def reference(model):
    return integrate(model, TIMES, rtol=1e-8)


def rms(values):
    return float(np.sqrt(np.mean(values**2)))


def force_error(forces, reference):
    """RMS error of the bearing forces against the RMS of their vibration."""
    return rms(forces - reference.forces) / rms(reference.forces - reference.forces[0])


def test_the_jacobian_is_the_derivative_of_the_rates(model, reference):
    x = reference.states[-1]
    scale = model.state_scale()
    jacobian = model.jacobian(x).copy()
    for k in range(0, len(x), 7):
        step = 1e-5 * scale[k] * np.eye(len(x))[k]
        difference = model.rates(0.0, x + step, True) - model.rates(0.0, x - step, True)
        column = difference / (2e-5 * scale[k])
        np.testing.assert_allclose(jacobian[:, k], column, rtol=0, atol=1e-6 * np.abs(column).max())


def test_the_start_is_in_equilibrium(model):
    """Without the unbalance nothing accelerates."""
    at_rest = np.zeros_like(model.start)
    m = model.shaft.size
    wrench = model.responses(at_rest[None])[0, :, :4].ravel()
    missing = model.shaft.bearing.T @ (wrench - model.static.wrench)
    assert np.abs(missing).max() < 1e-7 * np.abs(model.shaft.bearing.T @ model.static.wrench).max()
    rates = model.rates(0.0, model.start, False)
    np.testing.assert_array_equal(rates[:m], model.start[m:])


def test_two_integrators_and_tolerances_agree(model, reference):
    assert force_error(integrate(model, TIMES, rtol=1e-6).forces, reference) < 1e-4
    assert force_error(integrate(model, TIMES, rtol=1e-6, method="BDF").forces, reference) < 1e-3


@pytest.mark.parametrize(
    "name",
    [slow(name) if name in STEPS else name for name, scheme in SCHEMES.items() if not scheme.many_rates],
)
def test_every_coupling_converges_to_the_holistic_model(name, fmus, reference):
    steps = STEPS.get(name, IMPLICIT_STEPS)
    errors = []
    for step in steps:
        result = simulate(small(coupling=name, step=step), fmus)
        assert result.outcome is Outcome.FINISHED, result.message
        errors.append(force_error(result.record["force"].values, reference))
    order = np.log2(errors[-2] / errors[-1])
    if name in STEPS:
        assert order == pytest.approx(1.0, abs=0.03)
    else:  # what is of first order in an iterated force does not show yet at these steps
        assert order == pytest.approx(2.0, abs=0.1)
    assert errors[-1] < (2e-4 if name in ("linear-implicit", "newton") else 2e-3)


def test_many_rates_are_of_second_order(fmus, reference):
    """The error goes with the tolerance, which goes with the square of the steps.

    Tolerances by factors of four: intervals go up and down by the factor two. At a hundred times the coarsest
    a bearing is evaluated some thirty times in all, which has no order yet.
    """
    errors, evaluations = [], []
    tolerances = [2.0**-k * 1e-3 for k in (9, 11, 13)]
    for tolerance in tolerances:
        result = simulate(small(coupling="multirate", tolerance=tolerance), fmus)
        assert result.outcome is Outcome.FINISHED, result.message
        errors.append(force_error(result.record["force"].values, reference))
        evaluations.append(result.evaluations)
    assert np.polyfit(np.log(tolerances), np.log(errors), 1)[0] == pytest.approx(1.0, abs=0.05)
    assert np.polyfit(np.log(evaluations), np.log(errors), 1)[0] == pytest.approx(-2.0, abs=0.1)
    assert errors[-1] < 2e-6


@pytest.mark.parametrize("name", STEPS)
def test_explicit_coupling_has_a_step_limit_far_below_what_accuracy_asks_for(name, fmus, reference):
    """At 2e-5 s it is off by more than all vibration, or fails; ten times that serves linear-implicit."""
    explicit = simulate(small(coupling=name, step=2e-5), fmus)
    if explicit.outcome is Outcome.FINISHED:
        assert force_error(explicit.record["force"].values, reference) > 1.0
    implicit = simulate(small(coupling="linear-implicit", step=2e-4), fmus)
    assert force_error(implicit.record["force"].values, reference) < 0.01
