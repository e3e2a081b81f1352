"""Fields over the nodes against the unreduced displacements and closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from rotor_fmu.shaft.stress import bending_stress
from rotor_fmu.train.file import load_train
from rotor_fmu.vibration.rotor import Rotor
from tests.rotor_fmu.small_shafts import linear_bearings, run, small_rotor

GRAVITY = 9.80665


@pytest.fixture(scope="module", params=["irs", "none"])
def running(request):
    """The small train some steps behind a blade fracture, and its train."""
    train = load_train("small")
    blade = np.zeros(len(train.wheels))
    blade[0] = 0.5
    rotor = Rotor.of_train(train, reduction=request.param, blade_unbalance=blade, fracture_time=1e-3)
    F0, K, C = (np.zeros((2, 4)), np.zeros((2, 4, 4)), np.zeros((2, 4, 4)))
    K[:, 0, 0], K[:, 1, 1], C[:, 0, 0], C[:, 1, 1] = 1e8, 2e8, 1e5, 2e5
    rotor.start_from_law(F0, K, C, orbit=True)
    run(rotor, (F0, K, C), 1e-4, 100, speed=train.speed)
    return rotor, train


def displacement(rotor):
    """Static shape and vibration of the unreduced shaft."""
    state = rotor.get_state()
    return state.static.shape, rotor.shaft.T @ rotor.modal_state()[: rotor.shaft.size]


def test_displacement_and_amplitude(running):
    rotor, _ = running
    static, dynamic = displacement(rotor)
    fields = rotor.fields()
    np.testing.assert_allclose(fields.x, (static + dynamic)[0::4], rtol=0, atol=1e-15)
    np.testing.assert_allclose(fields.y, (static + dynamic)[1::4], rtol=0, atol=1e-15)
    np.testing.assert_allclose(fields.amplitude, np.hypot(dynamic[0::4], dynamic[1::4]), rtol=0, atol=1e-15)
    at_journals = rotor.model.bearing_dofs[:, 0] // 4
    np.testing.assert_allclose(fields.y[at_journals], rotor.kinematics()[:, 1], rtol=0, atol=1e-15)


def test_stress_is_that_of_static_and_dynamic_bending(running):
    rotor, train = running
    bending = bending_stress(train)
    expected = bending.stress(bending.moments(sum(displacement(rotor)), GRAVITY))
    assert expected.max() > 1e5
    np.testing.assert_allclose(rotor.fields().stress, expected, rtol=0, atol=1e-9 * expected.max())


def test_extremes_are_those_of_the_fields(running):
    rotor, train = running
    fields, extremes = rotor.fields(), rotor.extremes()
    k, s = fields.amplitude.argmax(), fields.stress.argmax()
    assert extremes.amplitude == pytest.approx(fields.amplitude[k], rel=1e-14)
    assert extremes.stress == pytest.approx(fields.stress[s], rel=1e-14)
    assert (extremes.amplitude_z, extremes.stress_z) == (train.z[k], train.z[s])
    assert extremes.amplitude > 1e-6


def test_static_bending_between_two_bearings_is_a_beam_on_two_supports():
    """Moment of the weight at a node: from forces and arms to its left alone."""
    train = load_train("small")
    rotor = Rotor.of_train(train, unbalance=np.zeros(len(train.wheels)))
    free_tilts = np.zeros((2, 4, 4))
    free_tilts[:, 0, 0] = free_tilts[:, 1, 1] = 1e10
    rotor.start_from_law(np.zeros((2, 4)), free_tilts, 0 * free_tilts, orbit=False)
    z = np.array(train.z)
    loads = [(GRAVITY * s.mass, (z[k] + z[k + 1]) / 2, k + 1) for k, s in enumerate(train.shoulders)]
    loads += [(GRAVITY * w.mass, z[w.node], w.node) for w in train.wheels]
    support = [
        (-f, z[b.node], b.node) for f, b in zip(rotor.static_wrench()[:, 1], train.bearings, strict=True)
    ]
    moment = np.array(
        [sum(f * (z[k] - at) for f, at, node in loads + support if node <= k) for k in range(len(z))]
    )
    moduli = [s.section_moduli[0] for s in train.shoulders]
    weakest = [min(pair) for pair in zip([np.inf, *moduli], [*moduli, np.inf], strict=True)]
    expected = np.abs(moment) / weakest
    np.testing.assert_allclose(rotor.fields().stress, expected, rtol=0, atol=1e-7 * expected.max())


def test_coupled_coordinates_of_both_planes_are_allowed():
    rotor, law = small_rotor(gravity=GRAVITY), linear_bearings()
    rotor.start_from_law(*law, orbit=True)
    static, dynamic = displacement(rotor)
    fields = rotor.fields()
    np.testing.assert_allclose(fields.x, (static + dynamic)[0::4], rtol=0, atol=1e-13)
    np.testing.assert_allclose(fields.amplitude, np.hypot(dynamic[0::4], dynamic[1::4]), rtol=0, atol=1e-13)


def test_fields_are_those_of_the_present_instant():
    """Asked before and after a step and on the way back, as of a rotor that was never asked before."""
    law = linear_bearings()

    def answers(rotor):
        return np.concatenate([rotor.fields().all.ravel(), rotor.extremes(), rotor.energy()])

    def fresh(steps):
        rotor = small_rotor(gravity=GRAVITY)
        rotor.start_from_law(*law, orbit=True)
        return run(rotor, (law[0] + 3.0, *law[1:]), 0.05, steps)

    rotor = fresh(0)
    kept, first = rotor.get_state(), answers(rotor)
    run(rotor, (law[0] + 3.0, *law[1:]), 0.05, 4)
    second = answers(rotor)
    rotor.set_state(kept)
    assert not np.array_equal(first, second)
    assert np.array_equal(first, answers(rotor))
    assert np.array_equal(first, answers(fresh(0)))
    assert np.array_equal(second, answers(fresh(4)))
