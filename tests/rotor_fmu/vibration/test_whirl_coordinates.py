"""Steps in decoupled whirl against the real maps of both bending planes, and closed forms of the holds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad_vec

from rotor_fmu.train.file import load_train
from rotor_fmu.vibration.first_order_hold import harmonic_hold, linear_hold
from rotor_fmu.vibration.modal_shaft import ModalShaft, to_modal
from rotor_fmu.vibration.prepared import prepare_shaft
from rotor_fmu.vibration.rotor import Rotor
from rotor_fmu.vibration.state import RotorState
from rotor_fmu.vibration.state_space import ModalCoordinates
from rotor_fmu.vibration.whirl_coordinates import WhirlCoordinates, whirl_coordinates
from rotor_fmu.vibration.whirl_plane import whirl_plane
from tests.rotor_fmu.small_shafts import gyroscopic, no_law, run, unreduced

STEP = 1e-4


@pytest.fixture(scope="module", params=["irs", "irs-plain", "guyan", "craig-bampton"])
def shaft(request):
    return prepare_shaft(load_train("turbine"), request.param).modal


@pytest.mark.parametrize("speed", [157.0, 0.0, -40.0])
def test_steps_are_those_of_the_real_maps(shaft, speed):
    rng = np.random.default_rng(1)
    harmonic = shaft.wheels.T @ rng.normal(size=(len(shaft.wheels), 4))
    whirl, modal = whirl_coordinates(shaft, speed), ModalCoordinates(shaft)
    assert whirl is not None
    state, w0, w1 = rng.normal(size=2 * shaft.size), 1e3 * rng.normal(size=44), 1e3 * rng.normal(size=44)
    rotation = rng.normal(size=4)

    def end(coordinates):
        maps = coordinates.maps(speed, STEP, harmonic)
        motion = maps.coast(coordinates.from_modal(state), w0, rotation)
        maps.add_end(w1, motion)
        maps.add_start(w1 - w0, motion)
        moved = maps.compliance
        return coordinates.to_modal(motion), coordinates.journals(motion), moved.start, moved.end, moved.own

    for found, expected in zip(end(whirl), end(modal), strict=True):
        np.testing.assert_allclose(found, expected, rtol=0, atol=2e-13 * np.abs(expected).max())


def test_coordinates_and_back(shaft):
    """Of displacements whose frequencies make them of the size of the velocities."""
    state = np.random.default_rng(2).normal(size=2 * shaft.size)
    state[: shaft.size] /= np.maximum(shaft.omega, 1.0)
    whirl = whirl_coordinates(shaft, 157.0)
    np.testing.assert_allclose(whirl.to_modal(whirl.from_modal(state)), state, rtol=0, atol=1e-12)


def test_a_drift_of_a_free_shaft_stays_a_drift():
    """Translation has no restoring force: r grows linearly, without an elastic mode that answers."""
    shaft = prepare_shaft(load_train("turbine"), "irs").modal
    free = replace(shaft, D=np.zeros_like(shaft.D))
    whirl = whirl_coordinates(free, 157.0)
    translation = np.zeros(2 * shaft.size)
    rigid = shaft.T[0::4, :2]
    translation[:2] = np.linalg.lstsq(rigid, np.ones(len(rigid)), rcond=None)[0]
    rate = np.roll(translation, shaft.size)
    maps = whirl.maps(157.0, 0.3, np.zeros((shaft.size, 4)))
    end = whirl.to_modal(maps.coast(whirl.from_modal(rate), np.zeros(44), np.zeros(4)))
    expected = rate + 0.3 * translation
    np.testing.assert_allclose(end, expected, rtol=0, atol=1e-9 * np.abs(expected).max())


def whirling(decoupled, speeds=(157.0,), fracture_time=5.5e-4, stiffness=1e8):
    train = load_train("small")
    law = np.zeros((2, 4)), stiffness * np.tile(np.eye(4), (2, 1, 1)), 1e5 * np.tile(np.eye(4), (2, 1, 1))
    wheels = len(train.wheels)
    rotor = Rotor.of_train(
        train,
        reduction="irs",
        gravity=9.81,
        speed=speeds[0],
        unbalance=np.full(wheels, 1e-3),
        unbalance_phase=np.zeros(wheels),
        blade_unbalance=np.full(wheels, 1e-2),
        blade_phase=np.ones(wheels),
        fracture_time=fracture_time,
    )
    if not decoupled:
        rotor._maps._coordinates.update(((speed,), rotor._maps._modal) for speed in speeds)
    rotor.start_from_law(*law, orbit=True)
    for k in range(20):
        rotor.step(k * STEP, STEP, *law, speeds[k % len(speeds)])
    return rotor


@pytest.mark.parametrize("stiffness", [1e8, 1e12], ids=["film", "contact"])
@pytest.mark.parametrize("speeds", [(157.0,), (157.0, 150.0, 3.0)], ids=["constant", "changing"])
def test_a_rotor_does_the_same_in_both_coordinates(speeds, stiffness):
    """In contact with part of the wrench held at its mean."""
    rotors = [whirling(decoupled, speeds, stiffness=stiffness) for decoupled in (True, False)]
    assert all(rotor.holds_mean == (stiffness != 1e8) for rotor in rotors)
    ends = [rotor.modal_state() for rotor in rotors]
    assert ends[0] == pytest.approx(ends[1], rel=0, abs=1e-12 * np.abs(ends[1]).max())


def test_a_state_goes_on_in_another_rotor_bit_by_bit():
    one, other = whirling(True), whirling(True, (100.0,))
    assert one.get_state().speed == 157.0
    other.set_state(RotorState.from_bytes(one.get_state().to_bytes()))
    assert np.array_equal(one.kinematics(), other.kinematics())
    for rotor in (one, other):
        run(rotor, no_law(2), STEP, 3, start=20, speed=157.0)
    assert np.array_equal(one.get_state().motion, other.get_state().motion)


def test_a_shaft_with_unlike_planes_has_none():
    """Stiffer in one plane, as a generator's rotor with slots: nothing complex linear about it."""
    M, D, G, K = gyroscopic()
    K = K.copy()
    K[1::4, 1::4] *= 1.01
    _, reduced = unreduced(M, D, G, K, bearings=(0, 2), wheels=(0, 1))
    assert whirl_coordinates(to_modal(reduced), 12.0) is None


@pytest.mark.parametrize("name", ["omega", "D", "G", "bearing"])
def test_planes_that_differ_or_mix_are_not_one(name):
    shaft = prepare_shaft(load_train("small"), "irs").modal
    assert whirl_plane(shaft) is not None
    changed = getattr(shaft, name).copy()
    changed.reshape(-1)[-1] += 1e-6 * np.abs(changed).max()
    assert whirl_plane(replace(shaft, **{name: changed})) is None


def test_an_odd_number_of_coordinates_is_no_pair_of_planes():
    shaft = prepare_shaft(load_train("small"), "irs").modal
    rest = slice(1, None)
    odd = replace(
        shaft,
        omega=shaft.omega[rest],
        D=shaft.D[rest, rest],
        G=shaft.G[rest, rest],
        bearing=shaft.bearing[:, rest],
    )
    assert whirl_plane(odd) is None


def two_coordinates(damping):
    """Deflection and slope of mass 1 and stiffness 400 in each plane, no gyroscopic coupling."""
    bearing = np.zeros((4, 4))
    bearing[[0, 3, 1, 2], range(4)] = [1.0, 1.0, 1.0, -1.0]
    nothing = np.zeros((4, 4))
    return ModalShaft(
        omega=np.full(4, 20.0),
        D=damping * np.eye(4),
        G=nothing,
        bearing=bearing,
        wheels=bearing[:2],
        T=np.eye(4),
    )


def test_critical_damping_does_not_decouple():
    """A double eigenvalue with one vector: x = (1 + 20 t) e^{-20 t}."""
    assert whirl_coordinates(two_coordinates(39.0), 15.0) is not None
    critical = two_coordinates(40.0)
    with pytest.raises(ValueError, match="do not decouple"):
        WhirlCoordinates(whirl_plane(critical), 15.0)
    assert whirl_coordinates(critical, 15.0) is None


RATES = np.array([0, 1e-9j, -3 + 2j, -1e-3 + 400j, -5e3, -2 - 4999j, -2.5, 157j, -9e6])


@pytest.mark.parametrize("step", [1e-4, 0.1])
def test_holds_are_the_integrals(step):
    """Against adaptive quadrature of e^{rate (step - t)} times the input, where it is not a spike."""
    rates = RATES[np.abs(RATES) * step < 1e3]

    def over_step(value):
        def grown(t):
            return np.exp(rates * (step - t)) * value(t)

        return quad_vec(grown, 0.0, step, 1e-15, 1e-13, points=np.linspace(0.0, step, 40))[0]

    falling, rising = linear_hold(rates, step)
    turning = harmonic_hold(rates, 157.0, step)
    for found, value in (
        (falling, lambda t: 1.0 - t / step),
        (rising, lambda t: t / step),
        (turning, lambda t: np.exp(157j * t)),
    ):
        np.testing.assert_allclose(found, over_step(value), rtol=1e-11, atol=1e-14 * step)


def test_holds_of_what_dies_at_once():
    """Rates to -infinity: the input of the end over the rate, and nothing overflows."""
    rates, step = np.array([-9e6 + 0j]), 1.0
    falling, rising = linear_hold(rates, step)
    assert rising == pytest.approx(1.0 / 9e6, rel=1e-6)
    assert falling == pytest.approx(1.0 / 9e6**2, rel=1e-6)
    assert harmonic_hold(rates, 157.0, step) == pytest.approx(np.exp(157j) / (157j + 9e6), rel=1e-12)
