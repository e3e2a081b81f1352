"""Macro steps of the rotor: affine law, unbalance, fracture, speed, step size."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from rotor_fmu.vibration.affine_step import NoFiniteResult
from rotor_fmu.vibration.map_cache import CAPACITY
from tests.rotor_fmu.small_shafts import linear_bearings, no_law, run, small_rotor, unbalance

SPEED = 12.0
NODES = np.array([0, 1, 2, 3, 8, 9, 10, 11])  # journals of the small rotor
WHEELS = np.array([0, 1, 4, 5])


def unbalance_pull(amount, phase, speed, theta):
    pull = amount * speed**2
    return np.stack([pull * np.cos(theta + phase), pull * np.sin(theta + phase)], axis=-1).ravel()


def direct(rotor, law, T, speed=lambda t: SPEED, breaks=()):
    """The same rotor on its linear bearings as one system in physical coordinates, by DOP853."""
    F0, K, C = law
    M, D, G, stiffness = (a.toarray() for a in (rotor.model.M, rotor.model.D, rotor.model.G, rotor.model.K))
    n, u = len(M), rotor.unbalance
    static = rotor.get_state().static
    q, p = static.shape, rotor.modal_state()
    modes = rotor.shaft.T
    x0 = np.concatenate([q + modes @ p[:n], modes @ p[n:]])
    weight = static_load(rotor)

    def rate(t, x, broken, omega, theta0, t0):
        q, v = x[:n], x[n:]
        f = weight - (D + omega * G) @ v - stiffness @ q
        journals = F0 - np.einsum("bij,bj->bi", K, q[NODES].reshape(-1, 4))
        journals = journals - np.einsum("bij,bj->bi", C, v[NODES].reshape(-1, 4))
        f[NODES] += journals.ravel()
        theta = theta0 + omega * (t - t0)
        f[WHEELS] += unbalance_pull(u.amount, u.phase, omega, theta)
        if broken:
            f[WHEELS] += unbalance_pull(u.blade_amount, u.blade_phase, omega, theta)
        return np.concatenate([v, np.linalg.solve(M, f)])

    x, theta = x0, 0.0
    for start, end in zip([0.0, *breaks], [*breaks, T], strict=True):
        omega = speed(start)
        extra = (start >= u.fracture_time, omega, theta, start)
        x = solve_ivp(rate, (start, end), x, method="DOP853", rtol=1e-12, atol=1e-14, args=extra).y[:, -1]
        theta += omega * (end - start)
    return np.hstack([x[NODES].reshape(-1, 4), x[n + NODES].reshape(-1, 4)])


def static_load(rotor):
    """Gravity, from the balance of the start: K q = g + B.T w."""
    static = rotor.get_state().static
    g = rotor.model.K @ static.shape
    g[NODES] -= static.wrench
    return g


def test_unbalance_matches_an_independent_integrator():
    """Without a law the wrench is constant, so that the steps must be exact."""
    rotor = small_rotor(ground=50.0)
    rotor.start_from_law(*no_law(), orbit=False)
    H, law = 0.05, no_law()
    law[0][:, 1] = 0.3
    expected = direct(rotor, law, 0.5, lambda t: SPEED, ())
    for k in range(10):
        rotor.step(k * H, H, *law, SPEED)
    scale = np.abs(expected).max()
    np.testing.assert_allclose(rotor.kinematics(), expected, rtol=0, atol=1e-10 * scale)


def test_the_law_holds_at_both_ends_and_is_linear_between():
    """One step again by hand: exact maps of the shaft with the wrenches read off the law."""
    rotor = small_rotor()
    F0, K, C = linear_bearings()
    rotor.start_from_law(F0 + 0.1, K, C, orbit=False)
    before, state = rotor.kinematics(), rotor.get_state()
    H = 0.02
    rotor.step(0.0, H, F0, K, C, SPEED)
    after = rotor.kinematics()
    law = np.concatenate([K, C], axis=2)
    w0, w1 = (F0 - np.einsum("bij,bj->bi", law, y) for y in (before, after))
    static = state.static.wrench
    maps = rotor._maps.step(SPEED, H)
    entry = np.concatenate([state.motion, w0.ravel() - static, [1.0, 0.0, 0.0, 0.0]])
    expected = maps.free @ entry + maps.wrench_end @ (w1.ravel() - static)
    np.testing.assert_allclose(rotor.modal_state(), expected, rtol=0, atol=1e-13 * np.abs(expected).max())


def test_linear_bearings_converge_with_second_order_to_the_coupled_system():
    F0, K, C = linear_bearings()
    errors = []
    for steps in (20, 40, 80):
        rotor = small_rotor()
        rotor.start_from_law(F0 + 0.5, K, C, orbit=True)
        if not errors:
            exact = coupled_by_exponential(rotor, (F0, K, C), 0.2)
        run(rotor, (F0, K, C), 0.2 / steps, steps)
        errors.append(np.abs(rotor.kinematics() - exact).max() / np.abs(exact).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(orders, 2.0, atol=0.1)
    assert errors[-1] < 1e-3


def coupled_by_exponential(rotor, law, T):
    """Rotor and bearings as one linear system: exp of it, augmented by the constant and the rotation."""
    F0, K, C = law
    M, D, G, stiffness = (a.toarray() for a in (rotor.model.M, rotor.model.D, rotor.model.G, rotor.model.K))
    n, u = len(M), rotor.unbalance
    for b in range(2):
        here = np.ix_(NODES[4 * b : 4 * b + 4], NODES[4 * b : 4 * b + 4])
        stiffness[here] += K[b]
        D[here] += C[b]
    constant, cosine, sine = static_load(rotor), np.zeros(n), np.zeros(n)
    constant[NODES] += F0.ravel()
    cosine[WHEELS] = unbalance_pull(u.amount, u.phase, SPEED, 0.0)
    sine[WHEELS] = unbalance_pull(u.amount, u.phase, SPEED, math.pi / 2)
    A = np.zeros((2 * n + 3, 2 * n + 3))
    A[:n, n : 2 * n] = np.eye(n)
    A[n : 2 * n, :n] = -np.linalg.solve(M, stiffness)
    A[n : 2 * n, n : 2 * n] = -np.linalg.solve(M, D + SPEED * G)
    A[n : 2 * n, 2 * n :] = np.linalg.solve(M, np.stack([constant, cosine, sine], axis=1))
    A[-2, -1], A[-1, -2] = -SPEED, SPEED
    state = rotor.get_state()
    modes = rotor.shaft.T
    p = rotor.modal_state()
    x0 = [state.static.shape + modes @ p[:n], modes @ p[n:], [1.0, 1.0, 0.0]]
    x = expm(A * T) @ np.concatenate(x0)
    return np.hstack([x[NODES].reshape(-1, 4), x[n + NODES].reshape(-1, 4)])


def broken_rotor(fracture_time):
    rotor = small_rotor(
        ground=50.0, excitation=unbalance([0.02, 0.01], [0.3, -1.0], [0.5, 0.2], [2.0, -0.6], fracture_time)
    )
    rotor.start_from_law(*no_law(), orbit=True)
    return rotor


def test_a_fracture_inside_a_step_is_exact():
    rotor = broken_rotor(0.113)
    expected = direct(rotor, no_law(), 0.3, breaks=(0.113,))
    run(rotor, no_law(), 0.05, 6)
    np.testing.assert_allclose(rotor.kinematics(), expected, rtol=0, atol=1e-10 * np.abs(expected).max())


def test_a_fracture_inside_a_step_equals_steps_split_at_the_event():
    whole, split = broken_rotor(0.113), broken_rotor(0.113)
    run(whole, no_law(), 0.05, 3)
    run(split, no_law(), 0.05, 2)
    split.step(0.1, 0.013, *no_law(), SPEED)
    split.step(0.113, 0.037, *no_law(), SPEED)
    one, other = whole.modal_state(), split.modal_state()
    np.testing.assert_allclose(one, other, rtol=0, atol=1e-12 * np.abs(one).max())
    unbroken = run(broken_rotor(math.inf), no_law(), 0.05, 3)
    assert (
        np.abs(whole.kinematics() - unbroken.kinematics()).max() > 0.1 * np.abs(unbroken.kinematics()).max()
    )


@pytest.mark.parametrize("instant", [0.1, 0.15])
def test_a_fracture_at_a_communication_point_acts_from_there(instant):
    """Exactly one of the two steps that meet there may bring it in, and as a whole."""
    rotor = run(broken_rotor(instant), no_law(), 0.05, 6)
    expected = direct(broken_rotor(instant), no_law(), 0.3, breaks=(instant,))
    np.testing.assert_allclose(rotor.kinematics(), expected, rtol=0, atol=1e-10 * np.abs(expected).max())


def test_step_size_may_change_at_will():
    F0, K, C = no_law()
    F0[:, 0] = 0.2
    a, b = (small_rotor(ground=50.0) for _ in range(2))
    for rotor in (a, b):
        rotor.start_from_law(*no_law(), orbit=True)
    a.step(0.0, 0.06, F0, K, C, SPEED)
    for t, H in ((0.0, 0.01), (0.01, 0.03), (0.04, 0.02)):
        b.step(t, H, F0, K, C, SPEED)
    np.testing.assert_allclose(a.modal_state(), b.modal_state(), rtol=0, atol=1e-13)
    assert a.get_state().angle == pytest.approx(b.get_state().angle, rel=1e-15)


def test_maps_are_kept_for_noisy_step_sizes_and_not_for_ever():
    cache = small_rotor()._maps
    decimal, odd = cache.step(SPEED, 1e-4), cache.step(SPEED, 1e-3 / 7, 1.0)
    assert cache.step(SPEED, 5.0001 - 5.0, 5.0001) is decimal
    assert cache.step(SPEED, (5.0 + 1e-3 / 7) - 5.0, 5.0) is odd
    assert cache.step(SPEED, 1e-4 * (1 + 1e-9), 0.1) is not decimal
    assert cache.step(SPEED + 1e-9, 1e-4) is not decimal
    for k in range(CAPACITY):
        cache.step(SPEED, 0.01 * (k + 1))
    assert len(cache._steps) == CAPACITY
    again = cache.step(SPEED, 1e-4)
    assert again is not decimal
    assert np.array_equal(again.free, decimal.free)


@pytest.mark.parametrize("H", [0.0, -1e-4, math.nan, math.inf])
def test_a_step_that_does_not_go_forward_is_refused(H):
    rotor = small_rotor()
    with pytest.raises(ValueError, match="H > 0"):
        rotor.step(0.0, H, *linear_bearings(), SPEED)


def test_a_law_that_is_not_a_number_fails_and_leaves_the_state():
    rotor = small_rotor()
    F0, K, C = linear_bearings()
    rotor.start_from_law(F0, K, C, orbit=True)
    before = rotor.get_state()
    K = K.copy()
    K[1, 2, 2] = math.nan
    with pytest.raises(NoFiniteResult, match="no finite result"):
        rotor.step(0.0, 0.01, F0, K, C, SPEED)
    assert rotor.get_state() is before
