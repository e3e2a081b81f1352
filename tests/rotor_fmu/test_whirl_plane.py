"""Steps in the complex plane x + i y against the real maps of both bending planes."""

from __future__ import annotations

import numpy as np
import pytest
from small_shafts import gyroscopic, unbalance, unreduced

from rotor_fmu.modal_shaft import to_modal
from rotor_fmu.prepared_shaft import prepare_shaft
from rotor_fmu.rotor import Rotor
from rotor_fmu.state_space import journal_output, step_maps
from rotor_fmu.train_file import load_train
from rotor_fmu.whirl_plane import WhirlPlane, alike, whirl_maps

SPEED, STEP = 157.0, 1e-4


@pytest.fixture(scope="module", params=["irs", "irs-plain", "guyan", "craig-bampton"])
def shaft(request):
    return prepare_shaft(load_train("turbine"), request.param).modal


def test_the_complex_maps_are_the_real_ones(shaft):
    rng = np.random.default_rng(1)
    maps = step_maps(shaft, SPEED, STEP, rng.normal(size=(shaft.size, 4)))
    assert maps.whirl is not None
    plane = WhirlPlane(shaft.bearing, 2)
    state, w0, w1 = rng.normal(size=2 * shaft.size), 1e3 * rng.normal(size=44), 1e3 * rng.normal(size=44)
    rotation, out = tuple(rng.normal(size=4)), np.empty(2 * shaft.size)

    plane.free(maps.whirl, state, w0, rotation, out)
    expected = maps.free @ np.concatenate([state, w0, rotation])
    np.testing.assert_allclose(out, expected, rtol=0, atol=1e-13 * np.abs(expected).max())

    out[:] = 0.0
    plane.add_end(maps.whirl, w1, out)
    expected = maps.wrench_end @ w1
    np.testing.assert_allclose(out, expected, rtol=0, atol=1e-13 * np.abs(expected).max())

    expected = journal_output(shaft) @ state
    np.testing.assert_allclose(plane.journals(state), expected, rtol=0, atol=1e-13 * np.abs(expected).max())


def test_steps_of_a_rotor_are_the_same_in_both_planes_and_in_one():
    train = load_train("small")
    law = np.zeros((2, 4)), 1e8 * np.tile(np.eye(4), (2, 1, 1)), 1e5 * np.tile(np.eye(4), (2, 1, 1))
    ends = []
    for complex_plane in (True, False):
        wheels = len(train.wheels)
        rotor = Rotor(
            train,
            reduction="irs",
            gravity=9.81,
            speed=train.speed,
            unbalance=np.full(wheels, 1e-3),
            unbalance_phase=np.zeros(wheels),
            blade_unbalance=np.full(wheels, 1e-2),
            blade_phase=np.ones(wheels),
            fracture_time=5.5e-4,
        )
        if not complex_plane:
            rotor._stepper._plane = None
        rotor.start_from_law(*law, orbit=True)
        for k in range(20):
            rotor.step(k * STEP, STEP, *law, train.speed)
        ends.append(rotor.get_state().modal)
    assert ends[0] == pytest.approx(ends[1], rel=0, abs=1e-12 * np.abs(ends[1]).max())


def test_a_shaft_with_unlike_planes_keeps_its_real_maps():
    """Stiffer in one plane, as a generator's rotor with slots: nothing complex linear about it."""
    M, D, G, K = gyroscopic()
    K = K.copy()
    K[1::4, 1::4] *= 1.01
    _, reduced = unreduced(M, D, G, K, bearings=(0, 2), wheels=(0, 1))
    shaft = to_modal(reduced)
    maps = step_maps(shaft, 12.0, 0.05, unbalance([0.02, 0.01], [0.3, -1.0]).nominal_force(shaft, 12.0))
    assert maps.whirl is None
    assert whirl_maps(maps.free, maps.wrench_end) is None


def test_planes_that_are_mixed_are_not_alike():
    shaft = prepare_shaft(load_train("small"), "irs").modal
    assert alike(shaft.bearing)
    turned = shaft.bearing.copy()
    turned[0, -1] = 1.0
    assert not alike(turned)
    assert not alike(shaft.bearing[:, 1:])
