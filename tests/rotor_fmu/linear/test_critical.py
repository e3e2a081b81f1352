"""Threshold of instability, critical speeds, margins: closed forms and published numbers."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from bearing_fmu.film import make_film
from bearing_fmu.parameters import BearingParameters
from rotor_fmu.linear.analysis import (
    LinearBearings,
    critical_speeds,
    least_damped,
    refined,
    thresholds,
    unbalance_response,
    undamped_critical_speeds,
    unreduced_shaft,
    whirl_modes,
)
from rotor_fmu.linear.critical import CriticalSpeed
from rotor_fmu.train.train import BearingSeat, Material, Shoulder, Train, Wheel
from tests.published import published

GRAVITY = 9.80665
CLEARANCE = 1e-4
SHORT = {"diameter": 0.1, "width": 0.02, "clearance": CLEARANCE}


def dumb_bell(mass, diameter=0.02, density=1.0):
    """Two point masses on their bearings, on a shaft that weighs nothing."""
    steel = Material("steel", 2e11, 0.3, density)
    seats = tuple(BearingSeat(f"b{k}", k, 0.1, 0.02, CLEARANCE, 0.02) for k in range(2))
    wheels = tuple(Wheel(f"w{k}", k, mass, 0.0, 1e-9) for k in range(2))
    return Train("dumb-bell", 800.0, 0.0, 0.0, 0.0, (Shoulder(1.0, diameter, 0.0, steel),), wheels, seats)


def position(film, load, speed, guess):
    """Where a film carries a load, by Newton's method on its own stiffness."""
    q = np.array([*guess, 0.0, 0.0])
    for _ in range(60):
        response = film.respond(q, np.zeros(4), speed)
        missing = np.array([0.0, load]) - response.wrench[:2]
        if np.abs(missing).max() < 1e-11 * load:
            return q, response
        step = -np.linalg.solve(response.stiffness[:2, :2], missing)
        room = CLEARANCE - np.hypot(*q[:2])
        q[:2] += step * min(1.0, 0.3 * room / np.hypot(*step))
    raise AssertionError("no equilibrium")


# Oil whirl of a rigid rotor on short bearings (Ocvirk, half Sommerfeld), computed from its characteristic
# equation: eccentricity ratio, threshold times sqrt(c/g), square of whirl over spin.
OIL_WHIRL = [(0.1, 2.7413, 0.25295), (0.3, 2.6058, 0.26979), (0.5, 2.5417, 0.26485), (0.7, 3.6278, 0.11873)]


@pytest.mark.parametrize(("eccentricity", "expected", "whirl"), OIL_WHIRL)
def test_oil_whirl_of_a_rigid_rotor_begins_where_the_closed_form_says(eccentricity, expected, whirl):
    mass = 60.0
    load, speed = mass * GRAVITY, expected * math.sqrt(GRAVITY / CLEARANCE)
    # the oil that carries the load at this eccentricity and the expected threshold
    unit = make_film("v3", BearingParameters(**SHORT, viscosity=1.0))
    place = np.array([eccentricity * CLEARANCE, 0.0, 0.0, 0.0])
    size = np.hypot(*unit.respond(place, np.zeros(4), speed).wrench[:2])
    film = make_film("v3", BearingParameters(**SHORT, viscosity=load / size))
    shaft = unreduced_shaft(dumb_bell(mass))

    @cache
    def modes_at(at):
        guess = eccentricity * CLEARANCE * np.array([0.5, -0.5])
        _, response = position(film, load, at, guess)
        both = [np.array([matrix] * 2) for matrix in (response.stiffness, response.damping)]
        return whirl_modes(shaft, at, 8, bearings=LinearBearings(*both))

    q, _ = position(film, load, speed, eccentricity * CLEARANCE * np.array([0.5, -0.5]))
    assert np.hypot(*q[:2]) / CLEARANCE == pytest.approx(eccentricity, rel=1e-6)
    found = thresholds(modes_at, [speed * share for share in (0.9, 0.97, 1.03, 1.1)])
    ((threshold, unstable_above),) = found
    assert threshold == pytest.approx(speed, rel=1e-3)
    assert unstable_above
    modes = modes_at(threshold)
    slowest = modes.frequency[int(np.argmin(modes.damping_ratio))]
    assert (slowest / threshold) ** 2 == pytest.approx(whirl, rel=1e-3)


def jeffcott(stiffness, damping):
    """A disc in the middle of a massless shaft on two bearings, soft beside the shaft; its own unbalance."""
    steel = Material("steel", 2e11, 0.3, 1e-3)
    shoulders = (Shoulder(0.5, 0.2, 0.0, steel),) * 2
    seats = tuple(BearingSeat(f"b{k}", node, 0.2, 0.1, 1e-4, 0.02) for k, node in enumerate((0, 2)))
    train = Train("jeffcott", 100.0, 0.0, 0.0, 0.0, shoulders, (Wheel("w", 1, 100.0, 0.0, 1e-6),), seats)
    both = [np.tile(np.diag([x, x, 0.0, 0.0]), (2, 1, 1)) for x in (stiffness, damping)]
    return unreduced_shaft(train), LinearBearings(*both)


@pytest.mark.parametrize("ratio", [0.002, 0.05])
def test_a_peak_has_the_height_and_width_of_a_jeffcott_rotor(ratio):
    """r^2 / |1 - r^2 + 2 i zeta r|: peak 1 / (2 zeta sqrt(1 - zeta^2)) at r = 1 / sqrt(1 - 2 zeta^2)."""
    mass = 100.0
    shaft, bearings = jeffcott(0.5 * mass * 200.0**2, ratio * mass * 200.0)
    mode = whirl_modes(shaft, 200.0, 1, bearings=bearings)
    natural, ratio = (
        float(np.abs(mode.eigenvalues[0])),
        float(mode.damping_ratio[0]),
    )  # the shaft is not rigid
    response = cache(lambda speed: np.abs(unbalance_response(shaft, speed, bearings, [mass]).shape[[4]]))
    grid = refined(lambda speed: response(speed).max(), np.linspace(20.0, 400.0, 20), [(natural, ratio)])
    (peak,) = critical_speeds(lambda speed: response(speed), grid)
    assert peak.speed == pytest.approx(natural / math.sqrt(1.0 - 2.0 * ratio**2), rel=2e-4)
    assert peak.amplitude == pytest.approx(1.0 / (2.0 * ratio * math.sqrt(1.0 - ratio**2)), rel=5e-3)
    assert peak.amplification == pytest.approx(1.0 / (2.0 * ratio), rel=0.02)


def test_soft_and_stiff_ends_of_the_critical_speed_map():
    """Soft: sqrt(2 k / m) of the rigid rotor; stiff: where the shaft alone decides, the map is flat."""
    shaft, _ = jeffcott(1.0, 0.0)
    soft = undamped_critical_speeds(shaft, [1e3, 4e3], 2)[:, 0]
    assert soft == pytest.approx(np.sqrt([2e3 / 100.0, 8e3 / 100.0]), rel=1e-4)
    stiff = undamped_critical_speeds(shaft, [1e13, 1e14], 1)[:, 0]
    inertia = math.pi / 64.0 * 0.2**4
    bending = 48.0 * 2e11 * inertia / 1.0**3
    assert stiff[0] == pytest.approx(stiff[1], rel=1e-3) and stiff[1] < math.sqrt(bending / 100.0)


def test_a_critical_speed_of_the_map_is_a_whirl_as_fast_as_the_shaft():
    shaft, bearings = jeffcott(3e7, 0.0)
    (speed,) = undamped_critical_speeds(shaft, [3e7], 1)[0]
    frequencies = whirl_modes(shaft, float(speed), 6, bearings=bearings).frequency
    assert np.abs(frequencies / speed - 1.0).min() < 1e-6


@pytest.mark.parametrize(
    ("factor", "below", "above"),
    [(2.0, 0.0, 0.0), (3.5, 8.5, 18.5), (10.0, 15.0, 25.0), (100.0, 16.0, 26.0)],
)
@published("separation margins of critical speeds", "API 684, SP6.8.2.10", "exactly")
def test_separation_margins_are_those_of_api_684(factor, below, above):
    """min(16, 17 (1 - 1/(AF - 1.5))) below and min(26, 10 + 17 (1 - 1/(AF - 1.5))) above, from AF 2.5 on."""
    peak = CriticalSpeed(100.0, 1.0, 0, 100.0 - 50.0 / factor, 100.0 + 50.0 / factor)
    assert peak.amplification == pytest.approx(factor)
    assert peak.required_margin(120.0) == pytest.approx(below)
    assert peak.required_margin(80.0) == pytest.approx(above)
    assert peak.margin(80.0) == pytest.approx(25.0)


def test_an_undamped_rotor_is_not_called_unstable():
    shaft, bearings = jeffcott(3e7, 0.0)
    assert least_damped(shaft, 100.0, bearings).stable
    crossed = LinearBearings(bearings.stiffness.copy(), bearings.damping)
    crossed.stiffness[:, 0, 1], crossed.stiffness[:, 1, 0] = 1e6, -1e6
    worst = least_damped(shaft, 100.0, crossed)
    assert not worst.stable and worst.log_decrement == pytest.approx(
        2.0 * math.pi * worst.damping_ratio, rel=1e-3
    )
