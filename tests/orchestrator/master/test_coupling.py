"""Coupling schemes on an oscillator split in two units, against its exact motion."""

import numpy as np
import pytest

from orchestrator.master.coupling import SCHEMES, GaussSeidel, LinearImplicit, make_scheme
from orchestrator.master.system import Wiring
from tests.orchestrator.oscillator import DISPLACEMENT, exact_motion, motion, released

END = 0.02  # s; the modes have 15.7 and 48 Hz and more


def errors(scheme, store, folder, steps, **bearing):
    """Largest error of x over the run for each step, relative to the initial displacement."""
    result = []
    for step in steps:
        system = released(store, folder, scheme.wiring, **bearing)
        times = step * np.arange(round(END / step) + 1)
        result.append(np.max(np.abs(motion(scheme, system, step, END) - exact_motion(times, **bearing))))
        system.close()
    return np.array(result) / DISPLACEMENT


def orders(errors, ratio=2.0):
    return np.log(errors[:-1] / errors[1:]) / np.log(ratio)


STEPS = END / np.array([20, 40, 80, 160])


def test_linear_implicit_is_of_second_order_on_a_nonlinear_bearing(store, toy_fmus):
    error = errors(LinearImplicit(), store, toy_fmus, STEPS, stiffness=1e6, cubic=4e12)
    assert orders(error)[-1] == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("name", SCHEMES)
def test_a_stiff_bearing_upsets_explicit_couplings_only(store, toy_fmus, name):
    """At omega H = 2.8; this rotor lets the wrench run linearly, which is stable up to 2 sqrt(3)."""
    stiff = {"stiffness": 8e8, "damping": 1e6}
    scheme = make_scheme(name)
    system = released(store, toy_fmus, scheme.wiring, **stiff)
    path = motion(scheme, system, 1e-3, END)
    system.close()
    if scheme.wiring is Wiring.LAW or scheme.iterates:
        assert np.max(np.abs(path)) <= DISPLACEMENT
    else:
        assert np.max(np.abs(path)) > 1e6 * DISPLACEMENT


def test_the_defect_vanishes_where_the_law_is_exact(store, toy_fmus):
    system = released(store, toy_fmus)
    force = 0.0
    for k in range(5):
        advance = LinearImplicit().advance(system, k * 1e-3, 1e-3)
        force = max(force, np.max(np.abs(system.forces)))
        assert np.max(np.abs(advance.defect)) < 1e-12 * force
    system.close()


def test_the_defect_of_a_nonlinear_bearing_is_second_order_of_the_motion(store, toy_fmus):
    """For F = -k q - k3 q^3 it is -k3 (q1^3 - q0^3 - 3 q0^2 (q1 - q0))."""
    cubic = 4e12
    system = released(store, toy_fmus, stiffness=1e6, cubic=cubic)
    before = DISPLACEMENT
    for k in range(5):
        defect = LinearImplicit().advance(system, k * 1e-3, 1e-3).defect[0, 0]
        now = system.journals[0, 0]
        expected = -cubic * (now**3 - before**3 - 3.0 * before**2 * (now - before))
        assert defect == pytest.approx(expected, rel=1e-9, abs=1e-9)
        before = now
    system.close()


def test_the_defect_of_explicit_coupling_is_the_change_of_the_force(store, toy_fmus):
    system = released(store, toy_fmus, Wiring.FORCE)
    before = system.forces.copy()
    defect = GaussSeidel().advance(system, 0.0, 1e-3).defect
    np.testing.assert_array_equal(defect, system.forces - before)
    system.close()
