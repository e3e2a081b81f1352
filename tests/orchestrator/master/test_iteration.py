"""Couplings that repeat a step: Newton and interface quasi-Newton, against exact answers."""

import numpy as np
import pytest
from scipy.linalg import expm

from orchestrator.fmi.unit import Unit
from orchestrator.master.coupling import (
    GaussSeidel,
    IqnIls,
    LinearImplicit,
    Newton,
    NotConverged,
    make_scheme,
)
from orchestrator.master.coupling.secant_law import secant_laws
from orchestrator.master.graph import Connection, Graph
from tests.orchestrator.master.loop import Loop
from tests.orchestrator.oscillator import DISPLACEMENT, exact_motion, motion, released
from tests.orchestrator.units.loop_matrices import Z0, closed

END = 0.02
CUBIC = {"stiffness": 1e6, "cubic": 4e12}


def errors(make, store, folder, steps, **bearing):
    result = []
    for step in steps:
        scheme = make()
        system = released(store, folder, scheme.wiring, **bearing)
        times = step * np.arange(round(END / step) + 1)
        result.append(np.max(np.abs(motion(scheme, system, step, END) - exact_motion(times, **bearing))))
        system.close()
    return np.array(result) / DISPLACEMENT


STEPS = END / np.array([20, 40, 80])


def test_newton_is_of_second_order_and_closer_than_linear_implicit(store, toy_fmus):
    newton = errors(lambda: Newton(1e-10), store, toy_fmus, STEPS, **CUBIC)
    assert np.log2(newton[-2] / newton[-1]) == pytest.approx(2.0, abs=0.1)
    once = errors(LinearImplicit, store, toy_fmus, STEPS, **CUBIC)
    assert np.all(newton < 0.6 * once)


def test_on_a_linear_bearing_newton_is_linear_implicit(store, toy_fmus):
    paths = []
    for scheme in (Newton(), LinearImplicit()):
        system = released(store, toy_fmus)
        paths.append(motion(scheme, system, 1e-3, END))
        system.close()
    np.testing.assert_array_equal(*paths)


def test_newton_takes_few_passes_and_ends_within_its_tolerance(store, toy_fmus):
    system = released(store, toy_fmus, **CUBIC)
    scheme = Newton(1e-8)
    passes = []
    for k in range(20):
        advance = scheme.advance(system, k * 1e-3, 1e-3)
        passes.append(advance.iterations)
        assert system.relative(advance.defect) <= 1e-8
    assert 2 <= np.mean(passes) <= 5
    system.close()


def test_newton_says_when_it_does_not_converge(store, toy_fmus):
    system = released(store, toy_fmus, **CUBIC)
    with pytest.raises(NotConverged, match="after 2 passes, allowed is 1e-12"):
        Newton(1e-12, limit=2).advance(system, 0.0, 1e-3)
    system.close()


def test_a_secant_law_meets_both_ends_and_keeps_the_tangent_of_the_rest():
    rng = np.random.default_rng(7)
    tangent = rng.normal(size=(2, 4, 8)) * 10.0 ** rng.integers(3, 9, size=(2, 1, 8))
    q0, q1, w0, w1 = (rng.normal(size=(2, n)) for n in (8, 8, 4, 4))
    law = np.empty((2, 36))
    secant_laws((q0, w0), (q1, w1), tangent, np.ones((2, 4)), law)
    L = np.concatenate([law[:, 4:20].reshape(2, 4, 4), law[:, 20:].reshape(2, 4, 4)], axis=2)
    for q, w in ((q0, w0), (q1, w1)):
        np.testing.assert_allclose(law[:, :4] - np.einsum("bij,bj->bi", L, q), w, rtol=0, atol=1e-6)
    for b in range(2):
        assert np.linalg.matrix_rank((L - tangent)[b], tol=1e-6 * np.abs(tangent).max()) <= 1


def test_a_secant_law_at_rest_is_the_tangent():
    tangent = np.ones((1, 4, 8)) * 1e9
    law = np.empty((1, 36))
    rest = np.full((1, 8), 1e-4), np.full((1, 4), 1e6)
    secant_laws(rest, rest, tangent, np.full((1, 4), 1e6), law)
    np.testing.assert_array_equal(law[0, 4:], 1e9)


STIFF = {"stiffness": 8e8, "damping": 1e6}


@pytest.mark.parametrize("bearing", [{}, CUBIC, STIFF], ids=["soft", "cubic", "stiff"])
def test_iqn_ils_converges_where_passing_on_does_not(bearing, store, toy_fmus):
    error = errors(IqnIls, store, toy_fmus, STEPS, **bearing)
    assert error[-1] < 0.6 * error[-2] or error[-1] < 1e-3
    assert error[-1] < 0.1


def test_iqn_ils_profits_from_earlier_steps(store, toy_fmus):
    mean = {}
    for reuse in (0, 8):
        scheme = IqnIls(reuse=reuse)
        system = released(store, toy_fmus, scheme.wiring, stiffness=8e7, damping=1e5)
        mean[reuse] = np.mean([scheme.advance(system, k * 5e-4, 5e-4).iterations for k in range(2, 30)])
        system.close()
    assert mean[8] < 0.8 * mean[0]


def test_iqn_ils_goes_on_from_its_memory(store, toy_fmus):
    paths = []
    for interrupted in (False, True):
        scheme = IqnIls()
        system = released(store, toy_fmus, scheme.wiring, stiffness=8e7, damping=1e5)
        path = []
        for k in range(12):
            if interrupted and k == 6:
                arrays = {name: array.copy() for name, array in scheme.memory.items()}
                scheme = IqnIls()
                scheme.memory = arrays
            scheme.advance(system, k * 5e-4, 5e-4)
            path.append(system.journals.copy())
        paths.append(path)
        system.close()
    np.testing.assert_array_equal(*paths)


def loop(store, folder):
    units = []
    for name, given, returned in (("lag", "u", "y"), ("gain", "y", "u")):
        names = [[f"{letter}{k}" for k in range(3)] for letter in (given, returned)]
        units.append((Unit(store.open(folder / f"{name}.fmu"), name), *names))
    connections = [Connection("lag", f"y{k}", "gain", f"y{k}") for k in range(3)]
    connections += [Connection("gain", f"u{k}", "lag", f"u{k}") for k in range(3)]
    made = Loop(Graph(units, connections), [["lag"], ["gain"]])
    made.begin()
    return made


def output(scheme, store, folder, steps, end=0.2):
    made = loop(store, folder)
    for k in range(steps):
        scheme.advance(made, k * end / steps, end / steps)
    y = made.graph.outputs[:3].copy()
    made.close()
    return y


def test_iqn_ils_solves_an_unsymmetric_loop_with_feedthrough(store, loop_fmus):
    rates, of_z = closed()
    exact = of_z @ expm(rates * 0.2) @ Z0
    scale = np.max(np.abs(exact))
    error = [np.max(np.abs(output(IqnIls(1e-10), store, loop_fmus, n) - exact)) / scale for n in (20, 40, 80)]
    assert np.log2(error[-2] / error[-1]) == pytest.approx(1.0, abs=0.1)  # the input holds its end value
    assert error[-1] < 0.05
    with np.errstate(over="ignore", invalid="ignore"):
        passed_on = output(GaussSeidel(), store, loop_fmus, 40)
    assert not np.max(np.abs(passed_on)) < 1e3 * scale


def test_a_linear_loop_takes_as_many_passes_as_it_has_unknowns(store, loop_fmus):
    made, scheme = loop(store, loop_fmus), IqnIls(1e-9)
    passes = [scheme.advance(made, 0.01 * k, 0.01).iterations for k in range(6)]
    made.close()
    assert passes[0] <= 3 + 4
    assert max(passes[1:]) <= 3


def test_schemes_are_made_fresh_with_their_tolerance():
    assert make_scheme("newton", 1e-3) == Newton(1e-3)
    assert make_scheme("iqn-ils", 1e-4).tolerance == 1e-4
    assert make_scheme("iqn-ils") is not make_scheme("iqn-ils")
    assert make_scheme("jacobi", 1e-3).name == "jacobi"
