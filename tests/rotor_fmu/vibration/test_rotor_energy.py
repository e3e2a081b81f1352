"""The energy of the shaft changes by the works on it, to rounding."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from rotor_fmu.train.file import load_train
from rotor_fmu.vibration.rotor import Rotor
from tests.rotor_fmu.small_shafts import (
    linear_bearings,
    matrix_rotor,
    no_law,
    run,
    small_rotor,
    unbalance,
    unreduced,
)

GRAVITY = 9.80665
SPEED = 12.0


def balance(rotor, before):
    """Energy gained, and the works that explain it."""
    work = rotor.work()
    return sum(rotor.energy()) - before, work.bearings + work.unbalance - work.damping


def test_energies_are_those_of_the_unreduced_displacements():
    rotor, law = small_rotor(gravity=GRAVITY), linear_bearings()
    rotor.start_from_law(*law, orbit=True)
    state, model = rotor.get_state(), rotor.model
    p, v = np.split(rotor.modal_state(), 2)
    q, rate = state.static.shape + rotor.shaft.T @ p, rotor.shaft.T @ v
    energy = rotor.energy()
    assert energy.kinetic == pytest.approx(rate @ (model.M @ rate) / 2, rel=1e-10)
    assert energy.strain == pytest.approx(q @ (model.K @ q) / 2, rel=1e-10)
    assert energy.gravity == pytest.approx(-GRAVITY * model.gravity @ q, rel=1e-10)


@pytest.mark.parametrize(("stiffer", "rounding"), [(1.0, 1e-11), (3e3, 1e-10)], ids=["film", "contact"])
@pytest.mark.parametrize("fracture_time", [math.inf, 0.113, 0.1])
def test_energy_gained_is_the_work_done(fracture_time, stiffer, rounding):
    """Not in equilibrium, in unsymmetric bearings, across a fracture; in contact the mean is held, too."""
    excitation = unbalance([0.02, 0.01], [0.3, -1.0], [0.5, 0.2], [2.0, -0.6], fracture_time)
    rotor = small_rotor(gravity=GRAVITY, excitation=excitation, track_work=True)
    F0, K, C = linear_bearings()
    K *= stiffer
    rotor.start_from_law(F0, K, C, orbit=True)
    before = sum(rotor.energy())
    run(rotor, (F0 + 3.0 * stiffer, K, C), 0.05, 8)
    assert rotor.holds_mean == (stiffer != 1.0)
    gained, explained = balance(rotor, before)
    works = rotor.work()[:3]  # on the vibration; what brakes the rotation is none
    assert rotor.work()[4:] == (0.0, 0.0)
    assert min(abs(w) for w in works) > 1e-6
    assert gained == pytest.approx(explained, abs=rounding * max(abs(w) for w in works))


def test_works_of_an_oscillator_by_quadrature_of_its_closed_form():
    """Resonant growth from rest with a constant force: each work alone, not their balance."""
    m, k, U, force = 2.0, 800.0, 0.1, 5.0
    speed, eye = math.sqrt(k / m), np.eye(4)
    model, reduced = unreduced(m * eye, 0 * eye, 0 * eye, k * eye)
    rotor = matrix_rotor(model, reduced, unbalance([U], [0.0]), gravity=0.0, speed=speed, track_work=True)
    rotor.start_from_law(*no_law(1), orbit=False)
    F0, K, C = no_law(1)
    F0[0, 0] = force
    T = 0.5
    run(rotor, (F0, K, C), T / 25, 25, speed=speed)
    grow = U * speed / (2 * m)

    def rate(
        t,
    ):  # in x: resonance and the response to the force; y = grow (sin / speed - t cos) resonates too
        return grow * (np.sin(speed * t) + speed * t * np.cos(speed * t)) + force / k * speed * np.sin(
            speed * t
        )

    def rate_y(t):
        return grow * speed * t * np.sin(speed * t)

    pull = U * speed**2
    by_unbalance = quad(
        lambda t: pull * (np.cos(speed * t) * rate(t) + np.sin(speed * t) * rate_y(t)), 0, T, epsabs=1e-13
    )[0]
    by_force = force * quad(rate, 0, T, epsabs=1e-13)[0]
    assert rotor.work().unbalance == pytest.approx(by_unbalance, rel=1e-11)
    assert rotor.work().bearings == pytest.approx(by_force, rel=1e-11)
    assert rotor.work().damping == pytest.approx(0.0, abs=1e-13)


def test_loss_in_damping_is_the_energy_a_free_vibration_loses():
    m, k, c, eye = 2.0, 800.0, 3.0, np.eye(4)
    model, reduced = unreduced(m * eye, c * eye, 0 * eye, k * eye)
    rotor = matrix_rotor(model, reduced, unbalance([0.0], [0.0]), gravity=0.0, speed=SPEED, track_work=True)
    start = np.array([[1e-3, 0, 0, 0]])
    rotor.start_from_positions(0 * start, start, 0 * start)
    F0, K, C = no_law(1)
    run(rotor, (F0, K, C), 0.5, 60)
    assert rotor.work().damping == pytest.approx(k * 1e-6 / 2, rel=1e-10)


@pytest.mark.parametrize("reduction", ["irs", "craig-bampton"])
def test_balance_of_a_train_through_a_blade_fracture(reduction):
    train = load_train("small")
    blade = np.zeros(len(train.wheels))
    blade[0] = 0.5
    rotor = Rotor.of_train(
        train, reduction=reduction, blade_unbalance=blade, fracture_time=1.03e-3, track_work=True
    )
    F0, K, C = (np.zeros((2, 4)), np.zeros((2, 4, 4)), np.zeros((2, 4, 4)))
    K[:, 0, 0], K[:, 1, 1], C[:, 0, 0], C[:, 1, 1] = 1e8, 2e8, 1e5, 2e5
    rotor.start_from_law(F0, K, C, orbit=True)
    before = sum(rotor.energy())
    run(rotor, (F0, K, C), 1e-4, 40, speed=train.speed)
    gained, explained = balance(rotor, before)
    assert rotor.work().unbalance > 1e-3
    assert gained == pytest.approx(explained, abs=1e-9 * max(abs(w) for w in rotor.work()))


def test_works_belong_to_the_state():
    law = linear_bearings()
    rotor = small_rotor(track_work=True)
    rotor.start_from_law(*law, orbit=True)
    run(rotor, law, 0.02, 3)
    kept, works = rotor.get_state(), rotor.work()
    run(rotor, law, 0.02, 3, start=3)
    assert rotor.work() != works
    rotor.set_state(type(kept).from_bytes(kept.to_bytes()))
    assert rotor.work() == works


def test_a_rotor_that_keeps_no_account_says_so():
    with pytest.raises(ValueError, match="track_work"):
        small_rotor().work()
