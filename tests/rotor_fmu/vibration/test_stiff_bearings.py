"""Bearings too stiff for a wrench that runs linearly through the step."""

from __future__ import annotations

import numpy as np
import pytest

from rotor_fmu.shaft.condensation import Equilibrium
from rotor_fmu.vibration.affine_step import AffineStep
from rotor_fmu.vibration.coordinates import Compliance
from tests.rotor_fmu.small_shafts import (
    linear_bearings,
    matrix_rotor,
    no_law,
    run,
    small_rotor,
    unbalance,
    unreduced,
)

MASS, H, SPEED = 2.0, 1e-3, 12.0


def on_a_spring(number, steps):
    """Positions of a mass on a spring in x with k H^2 / (6 m) = number, pushed by a step of the force."""
    eye = np.eye(4)
    matrices = MASS * eye, 0.0 * eye, 0.0 * eye, 0.0 * eye
    rotor = matrix_rotor(*unreduced(*matrices), unbalance([0.0], [0.0]), gravity=0.0, speed=1.0)
    F0, K, C = no_law(1)
    k = 6.0 * MASS * number / H**2
    K[0] = np.diag([k, 1e-3, 1e-3, 1e-3])
    rotor.start_from_law(F0, K, C, orbit=False)
    F0[0, 0] = k  # the spring's rest moves to 1
    path = []
    for step in range(steps):
        rotor.step(step * H, H, F0, K, C, 1.0)
        path.append(rotor.kinematics()[0, 0])
    return np.array(path)


@pytest.mark.parametrize("number", [0.5, 1.0, 1.9, 2.1, 10.0, 1e3, 1e6])
def test_swings_do_not_grow_however_stiff(number):
    """The linear acceleration method alone would from 2 on; undamped, x swings between 0 and 2."""
    path = on_a_spring(number, 5000)
    assert np.abs(path - 1.0).max() <= 1.0 + 2e-2
    assert np.abs(path[-2500:] - 1.0).max() > 0.9  # and nothing is damped


def test_the_period_is_that_of_the_mixed_newmark_method():
    """Share c = 1 - 1/s of the mean: beta = 1/6 + c/12; cos(turn) = 1 - w / (2 + 2 beta w), w = k H^2 / m."""
    number = 4.0
    square = 6.0 * number
    beta = 1.0 / 6.0 + (1.0 - 1.0 / number) / 12.0
    cosine = 1.0 - square / (2.0 * (1.0 + beta * square))
    swing = on_a_spring(number, 200) - 1.0
    np.testing.assert_allclose(swing[2:] + swing[:-2], 2.0 * cosine * swing[1:-1], rtol=0, atol=1e-10)


def test_a_bearing_between_its_limits_runs_linearly():
    """Below a stiffness number of 1 the swing is that of linear acceleration, to rounding."""
    number = 0.99
    square = 6.0 * number
    cosine = 1.0 - square / (2.0 * (1.0 + square / 6.0))
    swing = on_a_spring(number, 200) - 1.0
    np.testing.assert_allclose(swing[2:] + swing[:-2], 2.0 * cosine * swing[1:-1], rtol=0, atol=1e-10)


def test_one_stiff_bearing_leaves_the_hold_of_the_other_alone():
    """A step by hand: exact maps with wrenches between the mixed ends at bearing 1, linear at bearing 2."""
    rotor = small_rotor()
    F0, K, C = linear_bearings()
    K[0] *= 2e3
    rotor.start_from_law(F0 + 0.1, K, C, orbit=False)
    before, state = rotor.kinematics(), rotor.get_state()
    step = 0.02
    rotor.step(0.0, step, F0, K, C, SPEED)
    law = np.concatenate([K, C], axis=2)
    w0, w1 = (F0 - np.einsum("bij,bj->bi", law, y) for y in (before, rotor.kinematics()))
    maps = rotor._maps.step(SPEED, step)
    number, soft = maps.compliance.stiffness_numbers(K)
    assert number > 2.0 > 1.0 > soft
    nearer = np.array([[0.5 - 0.5 / number], [0.0]]) * (w1 - w0)
    static = state.static.wrench
    entry = np.concatenate([state.motion, (w0 + nearer).ravel() - static, [1.0, 0.0, 0.0, 0.0]])
    expected = maps.free @ entry + maps.wrench_end @ ((w1 - nearer).ravel() - static)
    np.testing.assert_allclose(rotor.modal_state(), expected, rtol=0, atol=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("number", [0.1, 0.3, 0.9, 3.0, 1e3])
@pytest.mark.parametrize("bearings", [2, 3, 11])
def test_swings_on_springs_that_share_a_mass_do_not_grow(bearings, number):
    """Each spring alone may be soft enough for a linear wrench; all together, two of them unlike, are not."""
    eye, none = np.eye(4), np.zeros((4, 4))
    matrices = unreduced(MASS * eye, none, none, none, bearings=(0,) * bearings)
    rotor = matrix_rotor(*matrices, unbalance([0.0], [0.0]), gravity=0.0, speed=1.0)
    F0, K, C = no_law(bearings)
    K[:] = 6.0 * MASS * number / H**2 * np.diag([1.0, 1e-9, 1e-9, 1e-9])
    K[0] *= 7.0
    rotor.start_from_law(F0, K, C, orbit=False)
    F0[:, 0] = K[:, 0, 0]
    swing = []
    for step in range(3000):
        rotor.step(step * H, H, F0, K, C, 1.0)
        swing.append(abs(rotor.kinematics()[0, 0] - 1.0))
    assert max(swing[-1000:]) > 0.9 and max(swing) < 1.02
    total = 6.0 * number + bearings * number
    assert total < 1.0 or rotor.holds_mean


def test_stiffness_numbers_bound_the_eigenvalues():
    """Of K S, for symmetric K: of random shafts and bearings, scaled by what each bearing may have."""
    rotor, rng = small_rotor(), np.random.default_rng(3)
    compliance = rotor._maps.step(SPEED, 0.02).compliance
    for _ in range(50):
        root = rng.normal(size=(2, 4, 4)) * 10.0 ** rng.uniform(1.5, 3.5, size=(2, 1, 1))
        K = root @ root.transpose(0, 2, 1)
        numbers = compliance.stiffness_numbers(K)
        product = (K @ compliance.mixed.reshape(2, 4, 8)).reshape(8, 8)
        if numbers is None:
            numbers = np.ones(2)
        borne = np.repeat(np.minimum(1.0, 1.0 / numbers), 4)[:, None] * product
        assert np.abs(np.linalg.eigvals(borne)).max() <= 1.0 + 1e-6


def test_stiff_bearings_keep_the_second_order():
    """On the way to a step short enough for linear wrenches the error falls fourfold with half the step."""
    F0, K, C = linear_bearings()
    K *= 50.0
    C *= 30.0

    def end(steps):
        rotor = small_rotor()
        rotor.start_from_law(F0 + 0.5, K, C, orbit=True)
        run(rotor, (F0, K, C), 0.2 / steps, steps)
        return rotor.kinematics()

    exact = end(20000)
    errors = [np.abs(end(steps) - exact).max() for steps in (40, 80, 160, 320, 640)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[0] < np.abs(exact).max()
    assert np.all(orders[1:] > 1.5)
    assert orders[-1] == pytest.approx(2.0, abs=0.1)


class _Mass:
    """Coordinates and maps of a free unit mass in each direction of a bearing."""

    def __init__(self):
        eye, zero = np.eye(4), np.zeros((4, 4))
        self.flow = np.block([[eye, H * eye], [zero, eye]])
        self.of_start = np.vstack([H**2 / 3.0 * eye, H / 2.0 * eye])
        self.of_end = np.vstack([H**2 / 6.0 * eye, H / 2.0 * eye])
        self.compliance = Compliance(self.of_start[None], self.of_end[None])

    def journals(self, motion):
        return motion.copy()

    def coast(self, motion, wrench, rotation):
        return self.flow @ motion + self.of_start @ wrench

    def add_start(self, wrench, motion):
        motion += self.of_start @ wrench

    def add_end(self, wrench, motion):
        motion += self.of_end @ wrench


def test_the_wrenches_of_a_step_are_its_own_whatever_step_came_after():
    """Impulse of the wrenches held is the change of momentum of the unit mass, also asked for later."""
    mass, law = _Mass(), AffineStep(1)
    rest = Equilibrium(np.zeros(4), np.zeros(4), np.zeros(4))
    C, F0, start = np.zeros((1, 4, 4)), np.zeros((1, 4)), np.zeros(8)
    start[:4] = 1e-4
    stiff, soft = (np.eye(4)[None] * number * 6.0 / H**2 for number in (50.0, 0.1))

    def step(K):
        law.set_law(K, C)
        return law.advance(mass, mass, start, start.reshape(1, 8), F0, np.zeros(4), None, rest)

    end, _, nearer, _ = step(stiff)
    assert nearer is not None and step(soft).nearer is None
    law.set_law(stiff, C)
    first, last = law.held(nearer, F0, start, end, rest)
    np.testing.assert_allclose(H / 2.0 * (first + last), end[4:], rtol=1e-12)
    np.testing.assert_allclose(
        mass.of_start[:4] @ first + mass.of_end[:4] @ last + start[:4], end[:4], rtol=1e-10
    )
