"""Run-up, run-down and losses against independent integrations and closed forms."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as sl
from scipy.integrate import solve_ivp

from rotor_fmu.train.file import load_train
from rotor_fmu.vibration.drive import Drive, course_of
from rotor_fmu.vibration.prepared import prepare_shaft
from rotor_fmu.vibration.state_space import ModalCoordinates
from rotor_fmu.vibration.unbalance import Loss, losses_of
from rotor_fmu.vibration.whirl_coordinates import whirl_coordinates
from tests.rotor_fmu.small_shafts import (
    OMEGA,
    gyroscopic,
    jeffcott,
    linear_bearings,
    matrix_rotor,
    small_rotor,
    unbalance,
    unreduced,
)


def largest(zeta, rate, start, end):
    """Largest amplitude, and the speed ratio there, at constant acceleration between two speed ratios."""
    rotor, law = jeffcott(zeta, start * OMEGA)
    if start:
        rotor.start_from_law(*law, orbit=True)
    else:
        rotor.start_from_positions(*np.zeros((3, 1, 4)))
    step = 2.0 * math.pi / OMEGA / 40
    total = abs(end - start) / rate / OMEGA
    found = (0.0, 0.0)
    for k in range(int(total / step)):
        ratio = start + (end - start) * (k + 1) * step / total
        rotor.step(k * step, step, *law, ratio * OMEGA)
        found = max(found, (math.hypot(*rotor.kinematics()[0, :2]), ratio))
    return found


# Integrated to 1e-10: z'' + 2 zeta z' + z = e^{i phi} (phi'^2 - i phi''), up from rest to 3, or down
# from the steady state at 3; zeta, lambda = alpha / omega^2, then amplitude and speed ratio of both peaks.
PASSAGES = [(0.02, 0.01, 11.3084, 1.1949, 9.9574, 0.8192)]


LONG = [
    (0.0, 0.003, 27.5525, 1.1183, 26.0529, 0.8818),
    (0.01, 0.001, 29.1581, 1.0568, 27.9271, 0.9451),
    (0.05, 0.003, 9.2157, 1.0790, 8.5165, 0.9356),
]


@pytest.mark.parametrize("case", [*PASSAGES, *(pytest.param(case, marks=pytest.mark.slow) for case in LONG)])
def test_passage_through_the_critical_speed(case):
    zeta, rate, up, at_up, down, at_down = case
    assert largest(zeta, rate, 0.0, 1.4) == pytest.approx((up, at_up), rel=5e-3)
    assert largest(zeta, rate, 3.0, 0.6) == pytest.approx((down, at_down), rel=5e-3)


@pytest.mark.parametrize(("ratio", "steady", "peak"), [(0.5, 0.3326, 0.5754), (2.0, 1.3304, 3.2366)])
def test_sudden_unbalance(ratio, steady, peak):
    """Damping ratio 0.05; amplitudes over the eccentricity."""
    nothing = np.zeros((4, 4))
    model, reduced = unreduced(np.eye(4), nothing, nothing, nothing, bearings=(0,), wheels=(0,))
    excitation = unbalance([0.0], [0.0], [1.0], [0.0], fracture_time=0.0)
    rotor = matrix_rotor(model, reduced, excitation, gravity=0.0, speed=ratio * OMEGA)
    law = np.zeros((1, 4)), OMEGA**2 * np.eye(4)[None], 0.1 * OMEGA * np.eye(4)[None]
    rotor.start_from_positions(*np.zeros((3, 1, 4)))
    step = 2.0 * math.pi / OMEGA / 100
    sizes = []
    for k in range(3000):
        rotor.step(k * step, step, *law, ratio * OMEGA)
        sizes.append(math.hypot(*rotor.kinematics()[0, :2]))
    assert max(sizes) == pytest.approx(peak, rel=2e-3)
    assert sizes[-1] == pytest.approx(steady, rel=2e-3)


def whirling(step):
    """A shaft that whirls in both planes, from 5 to 40 rad/s: error of its journals, and gap of its ledger.

    Relative to the largest displacement by Runge and Kutta, and to the work of the unbalance.
    """
    start, end, total = 5.0, 40.0, 0.5
    model, reduced = unreduced(*gyroscopic(), bearings=(0, 2), wheels=(0, 1))
    excitation = unbalance([0.02, 0.01], [0.3, -1.0])
    rotor = matrix_rotor(model, reduced, excitation, gravity=0.0, speed=start, track_work=True)
    _, K, C = linear_bearings()
    law = np.zeros((2, 4)), K, C
    rotor.start_from_law(*law, orbit=True)
    x0, before = rotor.modal_state().copy(), sum(rotor.energy())
    rate = (end - start) / total
    for k in range(round(total / step)):
        rotor.step(k * step, step, *law, start + rate * (k + 1) * step)
    shaft, m = rotor.shaft, rotor.shaft.size
    springs, dampers = (shaft.bearing.T @ sl.block_diag(*A) @ shaft.bearing for A in (K, C))
    pull = excitation.nominal_force(shaft, 1.0)

    def motion(t, x):
        speed, angle = start + rate * t, start * t + 0.5 * rate * t * t
        turned = complex(speed**2, -rate) * complex(math.cos(angle), math.sin(angle))
        p, v = x[:m], x[m:]
        force = pull @ [turned.real, turned.imag] - (shaft.D + speed * shaft.G + dampers) @ v
        return np.concatenate([v, force - (rate * shaft.G + springs) @ p - shaft.omega**2 * p])

    exact = solve_ivp(motion, (0.0, total), x0, method="DOP853", rtol=1e-9, atol=1e-12).y[:m, -1]
    expected = (shaft.bearing @ exact).reshape(-1, 4)
    work = rotor.work()
    gap = sum(rotor.energy()) - before - (work.bearings + work.unbalance - work.damping)
    error = np.abs(rotor.kinematics()[:, :4] - expected).max() / np.abs(expected).max()
    return error, abs(gap) / work.unbalance


def test_gyroscopic_moments_of_a_changing_speed_and_their_energy():
    """Of second order in the step, motion and ledger alike."""
    (error, gap), (finer, closer) = whirling(2e-3), whirling(1e-3)
    assert finer < 6e-5
    assert closer < 6e-6
    assert error / finer == pytest.approx(4.0, rel=0.1)
    assert gap / closer == pytest.approx(4.0, rel=0.2)


@pytest.mark.parametrize("difference", [0.0, 0.9])
def test_the_same_force_in_both_kinds_of_coordinates(difference):
    """A circular shaft off a speed of the grid, stepped in whirl and in modal coordinates."""
    shaft = prepare_shaft(load_train("small"), "irs").modal
    whirl, modal, m = whirl_coordinates(shaft, 314.0), ModalCoordinates(shaft), shaft.size
    state = np.random.default_rng(3).normal(size=2 * m)
    state[:m] /= np.maximum(shaft.omega, 1.0)
    found, power = whirl.detuning(314.0, 2e-4).pushed(whirl.from_modal(state), difference, 30.0)
    expected, same = modal.detuning(314.0, 2e-4).pushed(state, difference, 30.0)
    parts = np.split(whirl.to_modal(found), 2), np.split(expected, 2)
    for one, other in zip(*parts, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-9 * np.abs(other).max())
    assert power == pytest.approx(same, rel=1e-9)
    seen = whirl.reading(np.eye(m))(whirl.from_modal(state))
    np.testing.assert_allclose(seen.ravel(), state, rtol=1e-7, atol=1e-9)


def test_a_constant_speed_takes_no_part_in_it():
    """Steps at one speed are those that they were, bit by bit, also behind a change."""
    one, other = small_rotor(speed=12.0), small_rotor(speed=12.0)
    F0, K, C = linear_bearings()
    for rotor in (one, other):
        rotor.start_from_law(F0, K, C, orbit=True)
    other.set_state(other.get_state().from_bytes(other.get_state().to_bytes()))
    for k in range(20):
        one.step(k * 1e-2, 1e-2, F0, 1.1 * K, C, 12.0)
        other.step(k * 1e-2, 1e-2, F0, 1.1 * K, C, 12.0)
    np.testing.assert_array_equal(one.kinematics(), other.kinematics())
    one.step(0.2, 1e-2, F0, K, C, 13.0)
    assert one.speed == 13.0
    assert type(one.get_state()).from_bytes(one.get_state().to_bytes()).turning == 13.0


@pytest.mark.parametrize("speeds", [(12.0, 12.0), (12.0, 20.0)])
def test_what_is_lost_later_is_lost_as_the_first(speeds):
    """A loss in the list does what it does as the first, and several add up, inside a step, too."""
    times, amounts, phases = (0.103, 0.2), ([0.05, 0.0], [0.0, 0.03]), ([0.2, 0.0], [0.0, -0.4])
    F0, K, C = linear_bearings()

    def ran(first, later):
        blade = unbalance([0.0, 0.0], [0.0, 0.0], amounts[first], phases[first], times[first])
        rest = tuple(Loss(times[k], np.array(amounts[k]), np.array(phases[k])) for k in later)
        rotor = small_rotor(speed=speeds[0], excitation=replace(blade, later=rest))
        rotor.start_from_law(0.0 * F0, K, C, orbit=True)
        for k in range(40):
            end = speeds[0] + (speeds[1] - speeds[0]) * (k + 1) / 40
            rotor.step(k * 1e-2, 1e-2, 0.0 * F0, K, C, end)
        return rotor.kinematics()

    both = ran(0, (1,))
    np.testing.assert_allclose(ran(1, (0,)), both, rtol=1e-9, atol=1e-14)
    np.testing.assert_allclose(ran(0, ()) + ran(1, ()), both, rtol=1e-9, atol=1e-14)


def test_what_is_lost_when_told_is_lost_as_at_the_instant():
    """To the bit, from the step on before which it is told; and what comes after it has its own digit."""
    F0, K, C = linear_bearings()

    def ran(first, second, codes):
        none = unbalance([0.0, 0.0], [0.0, 0.0])
        lost = (
            Loss(first, np.array([0.05, 0.0]), np.zeros(2)),
            Loss(second, np.array([0.0, 0.03]), np.ones(2)),
        )
        rotor = small_rotor(speed=12.0, excitation=replace(none, later=lost))
        rotor.start_from_law(0.0 * F0, K, C, orbit=True)
        for k in range(40):
            rotor.unbalance.lose(codes(k))
            rotor.step(k * 1e-2, 1e-2, 0.0 * F0, K, C, 12.0 + 0.1 * k)
        return rotor.kinematics()

    told = ran(math.inf, math.inf, lambda k: (k >= 20) + 2 * (k >= 30))
    np.testing.assert_array_equal(told, ran(0.2, 0.3, lambda k: 0))


def test_losses_and_courses_as_texts():
    (loss,) = losses_of("[[2.0, 2, 0.5, -0.1]]", 3)
    assert (loss.time, loss.amount.tolist(), loss.phase.tolist()) == (2.0, [0, 0.5, 0], [0, -0.1, 0])
    for text in ("[[1, 4, 0.5, 0]]", "[[1, 0, 0.5, 0]]", "[[1, 1]]", "nothing"):
        with pytest.raises(ValueError, match="a wheel from 1 to 3"):
            losses_of(text, 3)
    assert course_of("") == ()
    assert Drive(course_of("[[0, 10], [2, 30]]")).on_course(0.5) == 15.0
    for text in ("[[1, 2], [1, 3]]", "[]", "[[0, NaN]]", "fast"):
        with pytest.raises(ValueError, match="instant in s, ascending"):
            course_of(text)
