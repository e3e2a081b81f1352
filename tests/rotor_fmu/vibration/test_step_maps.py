"""The maps of a step against closed forms and an independent integrator."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rotor_fmu.vibration.modal_shaft import to_modal
from rotor_fmu.vibration.state_space import state_matrix, step_maps
from tests.rotor_fmu.small_shafts import gyroscopic, matrix_rotor, no_law, run, unbalance, unreduced


def oscillator(*, mass=2.0, stiffness=800.0, damping=3.0, speed=15.0, amount=0.1, phase=0.4):
    eye = np.eye(4)
    matrices = mass * eye, damping * eye, 0.0 * eye, stiffness * eye
    return matrix_rotor(*unreduced(*matrices), unbalance([amount], [phase]), gravity=0.0, speed=speed)


@pytest.mark.parametrize("speed", [0.0, 15.0, 20.0, -7.0])
def test_damped_oscillator_under_unbalance_and_a_constant_force(speed):
    m, k, c, U, phi, force = 2.0, 800.0, 3.0, 0.1, 0.4, 5.0
    rotor = oscillator(mass=m, stiffness=k, damping=c, speed=speed, amount=U, phase=phi)
    rotor.start_from_law(*no_law(1), orbit=False)
    F0, K, C = no_law(1)
    F0[0, 0] = force
    H, steps = 0.01, 300
    run(rotor, (F0, K, C), H, steps, speed=speed)

    t = H * steps
    X = U * speed**2 * np.exp(1j * phi) / (k - m * speed**2 + 1j * speed * c)
    decay = -c / (2 * m)
    damped = np.sqrt(k / m - decay**2)
    at_rest = -X.real - force / k
    rate = (-(1j * speed * X).real - decay * at_rest) / damped
    free = np.exp(decay * t) * (at_rest * np.cos(damped * t) + rate * np.sin(damped * t))
    exact = (X * np.exp(1j * speed * t)).real + force / k + free
    assert rotor.kinematics()[0, 0] == pytest.approx(exact, abs=1e-13)


def test_undamped_oscillator_at_its_critical_speed_grows_linearly():
    m, k, U = 2.0, 800.0, 0.1
    speed = np.sqrt(k / m)
    rotor = oscillator(mass=m, stiffness=k, damping=0.0, speed=speed, amount=U, phase=0.0)
    rotor.start_from_law(*no_law(1), orbit=False)
    H, steps = 0.01, 100
    run(rotor, no_law(1), H, steps, speed=speed)
    # x'' + Omega^2 x = (U Omega^2 / m) cos(Omega t) from rest: x = U Omega t sin(Omega t) / (2 m).
    t = H * steps
    assert rotor.kinematics()[0, 0] == pytest.approx(U * speed * t / (2 * m) * np.sin(speed * t), rel=1e-12)


def modal_shaft():
    _, reduced = unreduced(*gyroscopic(), bearings=(0, 2), wheels=(0, 1))
    return to_modal(reduced), reduced


def test_modal_coordinates_describe_the_same_shaft():
    shaft, reduced = modal_shaft()
    assert np.count_nonzero(shaft.omega == 0.0) == 4
    modes = shaft.T  # T of the reduced shaft is the identity here
    np.testing.assert_allclose(modes.T @ reduced.M @ modes, np.eye(shaft.size), atol=1e-12)
    np.testing.assert_allclose(modes.T @ reduced.K @ modes, np.diag(shaft.omega**2), atol=1e-9)


def test_maps_are_exact_for_wrenches_linear_in_time_and_harmonic_unbalance():
    shaft, _ = modal_shaft()
    m, speed, H, angle = shaft.size, 12.0, 0.05, 0.7
    rng = np.random.default_rng(2)
    x0, w0, w1 = rng.normal(size=2 * m), rng.normal(size=8), rng.normal(size=8)
    force = unbalance([0.02, 0.01], [0.3, -1.0]).nominal_force(shaft, speed)
    maps = step_maps(shaft, speed, H, force)
    turn = np.array([np.cos(angle), np.sin(angle)])
    end = maps.free @ np.concatenate([x0, w0, turn]) + maps.wrench_end @ w1

    A = state_matrix(shaft, speed)

    def rate(t, x):
        theta = angle + speed * t
        pull = force @ np.array([np.cos(theta), np.sin(theta)])
        return A @ x + np.concatenate([np.zeros(m), shaft.bearing.T @ (w0 + (w1 - w0) * t / H) + pull])

    reference = solve_ivp(rate, (0.0, H), x0, method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    np.testing.assert_allclose(end, reference, rtol=0, atol=1e-10 * np.abs(reference).max())


def test_compliance_is_the_journals_answer_to_the_wrench_at_the_end():
    shaft, _ = modal_shaft()
    maps = step_maps(shaft, 12.0, 0.05, np.zeros((shaft.size, 2)))
    m = shaft.size
    for bearing in range(2):
        rows = shaft.bearing[4 * bearing : 4 * bearing + 4]
        np.testing.assert_allclose(maps.compliance.end[bearing, :4], rows @ maps.wrench_end[:m], rtol=1e-13)
        np.testing.assert_allclose(maps.compliance.end[bearing, 4:], rows @ maps.wrench_end[m:], rtol=1e-13)
        own = maps.compliance.end[bearing, :4, 4 * bearing : 4 * bearing + 4]
        np.testing.assert_array_equal(maps.compliance.own[bearing], own.T)


def test_a_step_is_two_half_steps():
    shaft, _ = modal_shaft()
    force = unbalance([0.02, 0.01], [0.3, -1.0]).nominal_force(shaft, 12.0)
    whole, half = (step_maps(shaft, 12.0, H, force).free for H in (0.02, 0.01))
    n = 2 * shaft.size
    scale = np.abs(whole[:, :n]).max()
    np.testing.assert_allclose(whole[:, :n], half[:, :n] @ half[:, :n], rtol=0, atol=1e-12 * scale)


def test_a_rigid_free_body_coasts_and_falls():
    mass, H = 3.0, 0.1
    eye = np.eye(4)
    _, reduced = unreduced(mass * eye, 0 * eye, 0 * eye, 0 * eye)
    shaft = to_modal(reduced)
    maps = step_maps(shaft, 0.0, H, np.zeros((4, 2)))
    place, speed, force = 0.2, -0.5, 6.0
    x0 = np.sqrt(mass) * np.concatenate([[place, 0, 0, 0], [speed, 0, 0, 0]])
    w = np.array([force, 0, 0, 0])
    end = maps.free @ np.concatenate([x0, w, [0, 0]]) + maps.wrench_end @ w
    np.testing.assert_allclose(
        (end / np.sqrt(mass))[[0, 4]],
        [place + speed * H + force / mass * H**2 / 2, speed + force / mass * H],
        rtol=1e-14,
    )
