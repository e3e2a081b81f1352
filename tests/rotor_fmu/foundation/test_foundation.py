"""Journals on pedestals and modal foundations against closed forms of two masses."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from rotor_fmu.foundation.foundation import of_modes, of_pedestals
from rotor_fmu.linear.harmonic import unbalance_response
from rotor_fmu.linear.whirl import LinearBearings, whirl_modes
from rotor_fmu.train.seat import FoundationMode, Pedestal
from tests.rotor_fmu.small_shafts import gyroscopic, linear_bearings, matrix_rotor, unbalance, unreduced

MASS, K, C = 10.0, 4e5, 300.0
PEDESTAL = Pedestal((25.0, 50.0), (9e5, 1.35e6), (500.0, 250.0))
AXES = [0, 1]


def rigid_body(foundation):
    """A body in one bearing, and the bearing's law."""
    nothing = np.zeros((4, 4))
    model, reduced = unreduced(MASS * np.eye(4), nothing, nothing, nothing, bearings=(0,), wheels=(0,))
    stiffness, damping = np.zeros((1, 4, 4)), np.zeros((1, 4, 4))
    stiffness[0] = np.diag([K, K, 10.0, 10.0])
    damping[0, :2, :2] = C * np.eye(2)
    parts = replace(model, foundation=foundation), replace(reduced, foundation=foundation)
    return *parts, (np.zeros((1, 4)), stiffness, damping)


def two_masses(axis):
    """State matrix of journal and housing, displacements first."""
    mass, stiffness, damping = PEDESTAL.direction(axis)
    inverse = np.array([1.0 / MASS, 1.0 / mass])[:, None]
    springs = inverse * np.array([[K, -K], [-K, K + stiffness]])
    dampers = inverse * np.array([[C, -C], [-C, C + damping]])
    return np.block([[np.zeros((2, 2)), np.eye(2)], [-springs, -dampers]])


def test_frequencies_and_damping_of_two_masses():
    model, _, (_, stiffness, damping) = rigid_body(of_pedestals([PEDESTAL]))
    found = whirl_modes(model, 100.0, 4, bearings=LinearBearings(stiffness, damping), above=10.0).eigenvalues
    exact = np.concatenate([np.linalg.eigvals(two_masses(axis)) for axis in AXES])
    exact = exact[exact.imag > 0.0]
    np.testing.assert_allclose(found, exact[np.argsort(exact.imag)], rtol=1e-12)


def test_the_share_of_the_shaft_counts_what_the_bearings_stand_on():
    """A body on a spring of its own, k, and through a bearing on a pedestal: four works, of x^H k x each."""
    spring, nothing = 3e5, np.zeros((4, 4))
    model, _ = unreduced(MASS * np.eye(4), nothing, nothing, spring * np.eye(4), bearings=(0,), wheels=(0,))
    model = replace(model, foundation=of_pedestals([PEDESTAL]))
    bearings = LinearBearings(np.diag([K, K, 0.0, 0.0])[None], np.diag([C, C, 0.0, 0.0])[None])
    found = whirl_modes(model, 100.0, 20, bearings=bearings, above=10.0)
    mass, stiffness, damping = PEDESTAL.direction(0)
    seen = 0
    for value, share in zip(found.eigenvalues, found.bending, strict=True):
        reacting, ground = K + value * C, stiffness + value * damping
        housing = reacting / (reacting + ground + value**2 * mass)  # of a journal that moves by 1
        works = spring, abs(reacting) * abs(1.0 - housing) ** 2, abs(ground) * abs(housing) ** 2
        balance = spring + value**2 * MASS + reacting * (1.0 - housing)
        if abs(balance) < 1e-6 * spring:  # a mode along x
            assert share == pytest.approx(works[0] / sum(works), rel=1e-9)
            seen += 1
    assert seen == 2


@pytest.mark.parametrize("axis", AXES)
def test_transient_of_two_masses(axis):
    """Released from a displaced start; second order in the step, 1e-6 of the displacement at 1e-5 s."""
    model, reduced, law = rigid_body(of_pedestals([PEDESTAL]))
    rotor = matrix_rotor(model, reduced, unbalance([0.0], [0.0]), gravity=0.0, speed=100.0, track_work=True)
    start, step, steps = 1e-3 * np.eye(4)[axis][None], 1e-5, 2000
    rotor.start_from_positions(start, 0 * start, 0 * start)
    before = sum(rotor.energy())
    for k in range(steps):
        rotor.step(k * step, step, *law, 100.0)
    exact = expm(two_masses(axis) * step * steps)[:, 0] * 1e-3
    housings = rotor.housings()
    assert rotor.kinematics()[0, axis] == pytest.approx(exact[0], abs=1e-9)
    assert housings[0, axis] == pytest.approx(exact[1], abs=1e-9)
    assert rotor.kinematics()[0, 4 + axis] == pytest.approx(exact[2], abs=2e-7)
    _, stiffness, damping = PEDESTAL.direction(axis)
    force = stiffness * housings[0, axis] + damping * housings[0, 4 + axis] - rotor.static_wrench()[0, axis]
    assert rotor.foundation_wrench()[0, axis] == pytest.approx(force, rel=1e-12)
    work = rotor.work()
    gained = sum(rotor.energy()) - before
    assert gained == pytest.approx(work.bearings + work.unbalance - work.damping, abs=1e-12 * abs(gained))


def test_unbalance_response_of_two_masses():
    model, _, (_, stiffness, damping) = rigid_body(of_pedestals([PEDESTAL]))
    speed, amount = 150.0, 1e-3
    found = unbalance_response(model, speed, LinearBearings(stiffness, damping), [amount])
    for axis in AXES:
        load = [0.0, 0.0, (-1j) ** axis * amount * speed**2 / MASS, 0.0]
        moved = np.linalg.solve(1j * speed * np.eye(4) - two_masses(axis), load)
        assert found.shape[axis] == pytest.approx(moved[0], rel=1e-10)
        law = K + 1j * speed * C
        assert found.wrench[0, axis] == pytest.approx(-law * (moved[0] - moved[1]), rel=1e-10)


def ran(foundation):
    """Journals of the random gyroscopic shaft after a jump of its bearings' stiffness."""
    model, reduced = unreduced(*gyroscopic(2), bearings=(0, 2), wheels=(0, 1))
    model = replace(model, foundation=foundation)
    excitation = unbalance([0.02, 0.01], [0.3, -1.0])
    rotor = matrix_rotor(model, reduced, excitation, gravity=0.0, speed=12.0)
    F0, stiffness, damping = linear_bearings()
    rotor.start_from_law(F0, stiffness, damping, orbit=True)
    for k in range(100):
        rotor.step(k * 1e-3, 1e-3, F0, 1.3 * stiffness, damping, 12.0)
    return rotor.kinematics()


def test_very_stiff_pedestals_give_the_rigid_run():
    rigid = ran(None)
    for stiffness, bound in ((1e12, 1e-6), (1e24, 1e-12)):
        pair = (stiffness, stiffness)
        pedestal = Pedestal((1e3, 1e3), pair, (1e2, 1e2), (10.0, 10.0), pair)
        np.testing.assert_allclose(ran(of_pedestals([pedestal] * 2)), rigid, atol=bound * np.abs(rigid).max())


def test_pedestals_are_a_modal_foundation():
    """The same springs as pedestals, and as modes of which each moves one housing."""
    masses, springs, dampers = np.array([40.0, 70.0]), np.array([3e4, 5e4]), np.array([20.0, 90.0])
    pedestals = [Pedestal(*((x, x) for x in values)) for values in zip(masses, springs, dampers, strict=True)]
    modes = []
    for index in range(2):
        for axis in AXES:
            shape = np.zeros(8)
            shape[4 * index + axis] = 1.0 / np.sqrt(masses[index])
            ratio = dampers[index] / (2.0 * np.sqrt(springs[index] * masses[index]))
            modes.append(FoundationMode(np.sqrt(springs[index] / masses[index]), ratio, tuple(shape)))
    one, other = ran(of_pedestals(pedestals)), ran(of_modes(modes))
    np.testing.assert_allclose(one, other, rtol=1e-12)
    assert np.abs(one - ran(None)).max() > 1e-4 * np.abs(one).max()


def test_a_mode_that_moves_two_housings():
    """A rigid beam on two springs is two modes, bounce and pitch; what its springs take is found."""
    mass, spring = 80.0, 2e4
    # of a uniform beam the ends of which are the housings: (x1, x2) = bounce (1, 1) + pitch (1, -1)
    bounce, pitch = 1.0 / np.sqrt(mass), np.sqrt(3.0 / mass)
    shapes = [np.zeros(8), np.zeros(8)]
    shapes[0][[0, 4]], shapes[1][[0, 4]] = (bounce, bounce), (pitch, -pitch)
    omegas = np.sqrt(2.0 * spring / mass), np.sqrt(6.0 * spring / mass)
    foundation = of_modes([FoundationMode(w, 0.0, tuple(s)) for w, s in zip(omegas, shapes, strict=True)])
    z, rate = np.array([1e-3, -2e-3]), np.zeros(2)
    housings = foundation.housings(z, rate)[:, 0]
    np.testing.assert_allclose(foundation.wrench(z, rate)[:, 0], spring * housings, rtol=1e-12)
