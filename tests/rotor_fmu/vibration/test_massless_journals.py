"""Journals without mass between a shaft without damping and a film: they follow, and do not ring."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import expm

from rotor_fmu.train.train import BearingSeat, Material, Shoulder, Train, Wheel
from rotor_fmu.vibration.rotor import Rotor
from rotor_fmu.vibration.state import RotorState

MASS, LENGTH, DIAMETER = 100.0, 1.0, 0.08
SPEED = 300.0
BARE = Material("bare", 2e11, 0.3, 0.0)
DISC = Wheel("disc", 1, MASS, 0.5, 0.4)


def bare_shaft():
    """A disc in the middle of a shaft without mass and damping, bearings at its ends."""
    shoulders = (Shoulder(LENGTH / 2.0, DIAMETER, 0.0, BARE),) * 2
    seats = tuple(BearingSeat(f"b{node}", node, 0.1, 0.05, 1e-4, 0.02) for node in (0, 2))
    return Train("bare", 300.0, 0.0, 0.0, 0.0, shoulders, (DISC,), seats)


def bare_rotor():
    """That shaft, unreduced and weightless, its disc unbalanced from the start on."""
    return Rotor.of_train(
        bare_shaft(),
        reduction="none",
        gravity=0.0,
        speed=SPEED,
        blade_unbalance=[MASS],
        blade_phase=[0.0],
        fracture_time=0.0,
    )


def shaft_stiffness():
    """Of the middle against both ends, with shear: 1/k = L^3 / (48 E I) + L / (4 kappa G A)."""
    area, second = math.pi / 4.0 * DIAMETER**2, math.pi / 64.0 * DIAMETER**4
    nu = BARE.poisson_ratio
    kappa = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu)
    return 1.0 / (
        LENGTH**3 / (48.0 * BARE.youngs_modulus * second) + LENGTH / (4.0 * kappa * BARE.shear_modulus * area)
    )


@pytest.mark.parametrize("spring", [2e6, 1e8])
def test_a_disc_on_a_massless_shaft_and_films_moves_as_the_closed_form_says(spring):
    """From rest, m x'' = s (q - x) + U W^2 e^{i W t} and s (x - q) = K q + C q'."""
    stiffness, damping, s = 2.0 * spring, 2.0 * 3e4, shaft_stiffness()
    A = np.zeros((4, 4), complex)  # of x, x', q and e^{i W t}
    A[0, 1], A[3, 3] = 1.0, 1j * SPEED
    A[1] = -s / MASS, 0.0, s / MASS, SPEED**2
    A[2] = s / damping, 0.0, -(s + stiffness) / damping, 0.0
    K, C = (np.tile(np.diag([x, x, 0.0, 0.0]) / 2.0, (2, 1, 1)) for x in (stiffness, damping))
    errors = []
    for H in (2e-4, 1e-4):
        rotor = bare_rotor()
        rotor.start_from_law(np.zeros((2, 4)), K, C, orbit=False)
        found, exact = [], []
        for k in range(round(0.05 / H)):
            rotor.step(k * H, H, np.zeros((2, 4)), K, C, SPEED)
            found.append(rotor.kinematics()[0, :2] @ [1.0, 1j])
            exact.append((expm(A * (k + 1) * H) @ [0.0, 0.0, 0.0, 1.0])[2])
        errors.append(np.abs(np.array(found) - exact).max() / np.abs(exact).max())
    assert errors[1] < 0.0025
    assert errors[1] < 0.35 * errors[0]


def test_a_massless_journal_goes_on_from_a_saved_state_and_through_steps_of_any_length():
    """A film alone, C v = f(t) on a shaft that is held elsewhere: errors fall with the square of the step."""
    K, C = (np.tile(np.diag([x, x, 0.0, 0.0]), (2, 1, 1)) for x in (2e6, 3e4))
    ends = []
    for divided in (1, 2, 8):
        rotor = bare_rotor()
        rotor.start_from_law(np.zeros((2, 4)), K, C, orbit=False)
        time = 0.0
        for k in range(120 * divided):
            H = (2e-4, 0.7e-4, 1.3e-4)[k // divided % 3] / divided
            rotor.step(time, H, np.zeros((2, 4)), K, C, SPEED)
            time += H
            if k == 60 * divided:
                saved = rotor.get_state().to_bytes()
                before = rotor.kinematics()
                rotor.set_state(RotorState.from_bytes(saved))
                assert np.array_equal(rotor.kinematics(), before)
        ends.append(rotor.kinematics())
    coarse, fine = (np.abs(end - ends[-1]).max(axis=0)[[0, 4]] for end in ends[:2])
    assert (fine < 0.35 * coarse).all()
