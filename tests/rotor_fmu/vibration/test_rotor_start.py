"""Starts of the rotor: static equilibrium, orbits, and the state as a value."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotor_fmu.train.file import load_train
from rotor_fmu.vibration.rotor import Rotor
from rotor_fmu.vibration.state import RotorState
from tests.rotor_fmu.small_shafts import linear_bearings, no_law, run, small_rotor

GRAVITY = 9.80665
SPEED = 12.0


@pytest.fixture(scope="module")
def train():
    return load_train("small")


def springs(rotor, stiffness=1e8, damping=1e5):
    n_b = rotor.shaft.bearings
    K, C = (np.zeros((n_b, 4, 4)) for _ in range(2))
    K[:, 0, 0], K[:, 1, 1], K[:, 0, 1], K[:, 1, 0] = stiffness, 1.5 * stiffness, stiffness / 4, -stiffness / 2
    C[:, 0, 0], C[:, 1, 1] = damping, 2 * damping
    return np.zeros((n_b, 4)), K, C


def dense_equilibrium(model, F0, K):
    stiffness, load = model.K.toarray(), GRAVITY * model.gravity
    for dofs, f, k in zip(model.bearing_dofs, F0, K, strict=True):
        stiffness[np.ix_(dofs, dofs)] += k
        load[dofs] += f
    return np.linalg.solve(stiffness, load)


@pytest.mark.parametrize("reduction", ["irs", "guyan", "craig-bampton", "none"])
def test_static_equilibrium_is_that_of_the_unreduced_shaft(train, reduction):
    rotor = Rotor.of_train(train, reduction=reduction)
    F0, K, C = springs(rotor)
    F0[:, 1], F0[0, 2] = 2e4, 1e3
    rotor.start_from_law(F0, K, C, orbit=False)
    expected = dense_equilibrium(rotor.model, F0, K)
    static = rotor.get_state().static
    np.testing.assert_allclose(static.shape, expected, rtol=0, atol=1e-10 * np.abs(expected).max())
    journals = expected[rotor.model.bearing_dofs]
    np.testing.assert_allclose(rotor.kinematics()[:, :4], journals, atol=1e-10 * np.abs(expected).max())
    wrench = F0 - np.einsum("bij,bj->bi", K, journals)
    np.testing.assert_allclose(rotor.static_wrench(), wrench, atol=1e-8 * np.abs(wrench).max())
    assert rotor.static_wrench()[:, 1].sum() == pytest.approx(GRAVITY * train.mass, rel=1e-10)


@pytest.mark.parametrize("reduction", ["irs", "guyan"])
def test_a_shaft_in_static_equilibrium_stays_at_rest(train, reduction):
    rotor = Rotor.of_train(train, reduction=reduction, unbalance=np.zeros(len(train.wheels)))
    law = springs(rotor)
    rotor.start_from_law(*law, orbit=True)
    start = rotor.kinematics()
    run(rotor, law, 1e-4, 200, speed=train.speed)
    np.testing.assert_allclose(rotor.kinematics()[:, :4], start[:, :4], rtol=0, atol=1e-15)
    assert np.abs(rotor.kinematics()[:, 4:]).max() < 1e-12


def test_weak_springs_find_the_rigid_position_under_given_loads(train):
    """As at the alignment: loads given, the shape found, the springs nearly without force."""
    rotor = Rotor.of_train(train)
    z = np.array(train.z)[[b.node for b in train.bearings]]
    model = rotor.model
    weight, moment = GRAVITY * train.mass, -GRAVITY * (tilted(model) @ model.gravity)
    rear = (moment - weight * z[0]) / (z[1] - z[0])
    F0, K, C = (np.zeros_like(a) for a in springs(rotor))
    F0[:, 1] = weight - rear, rear
    K[:, 0, 0] = K[:, 1, 1] = 1e4
    rotor.start_from_law(F0, K, C, orbit=False)
    np.testing.assert_allclose(rotor.static_wrench(), F0, atol=1e-9 * weight)


def tilted(model):
    """Displacements y = z of a rigid shaft; their work with a load is its moment about z = 0."""
    tilt = np.zeros(model.size)
    tilt[1::4] = model.z
    tilt[2::4] = -1.0
    return tilt


def test_steady_vibration_without_bearing_forces_goes_on_exactly():
    rotor = small_rotor(ground=50.0)
    rotor.start_from_law(*no_law(), orbit=True)
    start = rotor.modal_state()
    turns, steps = 3, 300
    run(rotor, no_law(), 2 * np.pi * turns / SPEED / steps, steps)
    np.testing.assert_allclose(rotor.modal_state(), start, rtol=0, atol=1e-12 * np.abs(start).max())


def test_orbit_in_linear_bearings_is_the_harmonic_solution_of_the_coupled_system():
    rotor = small_rotor()
    F0, K, C = linear_bearings()
    rotor.start_from_law(F0, K, C, orbit=True)
    model, u = rotor.model, rotor.unbalance
    stiffness, damping = model.K.toarray(), (model.D + SPEED * model.G).toarray()
    for dofs, k, c in zip(model.bearing_dofs, K, C, strict=True):
        stiffness[np.ix_(dofs, dofs)] += k
        damping[np.ix_(dofs, dofs)] += c
    f = np.zeros(model.size, dtype=complex)
    pull = u.amount * SPEED**2 * np.exp(1j * u.phase)
    f[model.wheel_dofs] = np.stack([pull, -1j * pull], axis=-1)
    X = np.linalg.solve(stiffness - SPEED**2 * model.M.toarray() + 1j * SPEED * damping, f)
    orbit = X[model.bearing_dofs]
    static = rotor.get_state().static.journals.reshape(-1, 4)
    y = rotor.kinematics()
    np.testing.assert_allclose(y[:, :4] - static, orbit.real, rtol=0, atol=1e-12 * np.abs(orbit).max())
    np.testing.assert_allclose(y[:, 4:], (1j * SPEED * orbit).real, rtol=0, atol=1e-11 * np.abs(orbit).max())


def test_starting_on_the_orbit_stays_on_it_with_second_order():
    law = linear_bearings()
    drift = []
    for steps in (100, 200, 400):
        rotor = small_rotor()
        rotor.start_from_law(*law, orbit=True)
        start = rotor.kinematics()
        run(rotor, law, 2 * np.pi / SPEED / steps, steps)
        drift.append(np.abs(rotor.kinematics() - start).max() / np.abs(start).max())
    assert drift[0] < 1e-3
    np.testing.assert_allclose(np.array(drift[:-1]) / drift[1:], 4.0, rtol=0.05)


@pytest.mark.parametrize("time", [0.0, 0.37])
def test_start_from_the_positions_of_an_orbit_is_the_start_from_its_law(train, time):
    by_law, by_positions = Rotor.of_train(train), Rotor.of_train(train)
    law = springs(by_law)
    by_law.start_from_law(*law, orbit=True, time=time)
    quarter = np.pi / 2 / train.speed
    at_zero, later = Rotor.of_train(train), Rotor.of_train(train)
    at_zero.start_from_law(*law, orbit=True)
    later.start_from_law(*law, orbit=True, time=quarter)
    static = by_law.get_state().static.journals.reshape(-1, 4)
    cos, sin = (r.kinematics()[:, :4] - static for r in (at_zero, later))
    by_positions.start_from_positions(static, cos, sin, time=time)
    a, b = by_law.get_state(), by_positions.get_state()
    np.testing.assert_allclose(b.motion, a.motion, rtol=0, atol=1e-10 * np.abs(a.motion).max())
    sag = np.abs(a.static.shape).max()
    np.testing.assert_allclose(b.static.shape, a.static.shape, rtol=0, atol=1e-12 * sag)
    np.testing.assert_allclose(by_positions.static_wrench(), by_law.static_wrench(), rtol=0, atol=1e-5)


def test_prescribed_positions_are_taken_exactly(train):
    rotor = Rotor.of_train(train)
    rng = np.random.default_rng(0)
    static, cos, sin = (scale * rng.normal(size=(rotor.shaft.bearings, 4)) for scale in (1e-3, 1e-5, 1e-5))
    rotor.start_from_positions(static, cos, sin)
    y = rotor.kinematics()
    np.testing.assert_allclose(y[:, :4], static + cos, rtol=0, atol=1e-14)
    np.testing.assert_allclose(y[:, 4:], train.speed * sin, rtol=0, atol=1e-11)


def test_laws_that_do_not_hold_the_shaft_are_refused(train):
    rotor = Rotor.of_train(train)
    F0, K, C = springs(rotor)
    with pytest.raises(ValueError, match="not held"):
        rotor.start_from_law(F0, 0 * K, C, orbit=False)
    K[1] = 0.0
    K[0, 2:] = 0.0
    with pytest.raises(ValueError, match="not held"):
        rotor.start_from_law(F0, K, C, orbit=False)


def test_a_step_repeated_from_a_kept_state_is_the_same_bit_by_bit():
    rotor, law = small_rotor(), linear_bearings()
    rotor.start_from_law(*law, orbit=True)
    run(rotor, law, 0.01, 5)
    kept = rotor.get_state()
    image = kept.motion.copy()
    run(rotor, law, 0.01, 7, start=5)
    first, y = rotor.get_state(), rotor.kinematics()
    rotor.set_state(kept)
    run(rotor, law, 0.005, 3, start=10)
    assert np.array_equal(kept.motion, image)
    rotor.set_state(kept)
    run(rotor, law, 0.01, 7, start=5)
    assert np.array_equal(rotor.get_state().motion, first.motion)
    assert rotor.get_state().angle == first.angle
    assert np.array_equal(rotor.kinematics(), y)


def test_state_as_bytes_continues_another_rotor_bit_by_bit():
    law = linear_bearings()
    one, other = small_rotor(gravity=GRAVITY), small_rotor(gravity=GRAVITY)
    one.start_from_law(*law, orbit=True)
    run(one, law, 0.01, 5)
    other.set_state(RotorState.from_bytes(one.get_state().to_bytes()))
    for rotor in (one, other):
        run(rotor, law, 0.01, 5, start=5)
    assert one.get_state().to_bytes() == other.get_state().to_bytes()
    assert np.array_equal(one.kinematics(), other.kinematics())


SPOILT = [lambda b: b[:-8], lambda b: b"x" + b[1:], lambda b: b[:20], lambda b: b + b"\0" * 8]


@pytest.mark.parametrize("spoil", SPOILT)
def test_bytes_that_are_not_a_state_are_refused(spoil):
    data = small_rotor().get_state().to_bytes()
    with pytest.raises(ValueError, match="rotor state"):
        RotorState.from_bytes(spoil(data))


def test_a_state_of_another_shaft_is_refused(train):
    with pytest.raises(ValueError, match="allowed are"):
        Rotor.of_train(train).set_state(small_rotor().get_state())


@pytest.mark.parametrize("stepped", [False, True], ids=["modal", "whirl"])
def test_a_state_in_other_eigenvectors_is_refused(train, stepped):
    """As another kind of processor finds them: the numbers would mean another motion."""
    rotor = Rotor.of_train(train)
    if stepped:
        rotor.step(0.0, 1e-4, np.zeros((2, 4)), np.zeros((2, 4, 4)), np.zeros((2, 4, 4)), train.speed)
    state = RotorState.from_bytes(rotor.get_state().to_bytes())
    assert (state.speed is not None) == stepped
    rotor.set_state(state)
    kept = rotor.kinematics()
    with pytest.raises(ValueError, match="kind of processor"):
        rotor.set_state(replace(state, basis=bytes(16)))
    assert np.array_equal(rotor.kinematics(), kept)


def test_rotors_of_one_train_share_the_shaft_but_nothing_that_changes(train):
    alone, other = (
        Rotor.of_train(train),
        Rotor.of_train(train, unbalance=np.full(len(train.wheels), 0.1), gravity=0.0),
    )
    assert alone.shaft is other.shaft
    law = springs(alone)
    alone.start_from_law(*law, orbit=True)
    start = alone.get_state()
    run(alone, law, 1e-4, 5, speed=train.speed)
    expected = alone.get_state().to_bytes()
    alone.set_state(start)
    other.start_from_law(*law, orbit=True)
    for k in range(5):
        for rotor in (alone, other):
            rotor.step(k * 1e-4, 1e-4, *law, train.speed)
    assert alone.get_state().to_bytes() == expected
    assert other.get_state().to_bytes() != expected
