"""The bound on what a film carries, against integrals, the films themselves and the bundled trains."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from bearing_fmu.film import make_film
from bearing_fmu.parameters import BearingParameters
from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.file import bundled_trains, load_train
from rotor_fmu.train.film_capacity import most_load
from rotor_fmu.train.train import BearingSeat


def half_sommerfeld(e):
    """Components of the long bearing's force over 6 eta omega r b (r/c)^2, Sommerfeld's pressure."""

    def p(t):
        return e * math.sin(t) * (2 + e * math.cos(t)) / ((2 + e * e) * (1 + e * math.cos(t)) ** 2)

    return [quad(lambda t, f=f: p(t) * f(t), 0, math.pi, limit=200)[0] for f in (math.cos, math.sin)]


def short_bearing(e):
    """Components of the short bearing's force over eta omega r b (b/c)^2 / 2, Ocvirk's pressure."""

    def p(t):
        return e * math.sin(t) / (1 + e * math.cos(t)) ** 3

    return [quad(lambda t, f=f: p(t) * f(t), 0, math.pi, limit=200)[0] for f in (math.cos, math.sin)]


@pytest.mark.parametrize("eccentricity", [0.3, 0.8, 0.99])
def test_the_capacity_is_the_smaller_of_both_closed_forms(eccentricity):
    speed, radius, clearance, eta = 200.0, 0.1, 2e-4, 0.02
    for width in (0.005, 8.0):
        seat = BearingSeat("b", 1, 2 * radius, width, clearance, eta)
        long = 6 * eta * speed * radius * width * (radius / clearance) ** 2
        long *= math.hypot(*half_sommerfeld(eccentricity))
        short = 0.5 * eta * speed * radius * width * (width / clearance) ** 2
        short *= math.hypot(*short_bearing(eccentricity))
        assert most_load(seat, speed, eccentricity) == pytest.approx(min(long, short), rel=1e-6)


@pytest.mark.parametrize("width", [0.05, 0.2, 0.4])
def test_no_film_carries_more_than_the_capacity(width):
    """The films of both Reynolds depths at 0.9, also with oil under pressure."""
    for ambient in (0.0, 1e6):
        seat = BearingSeat("b", 1, 0.2, width, 2e-4, 0.02, ambient)
        parameters = BearingParameters(0.2, width, 2e-4, 0.02, ambient, columns=96, rows=16)
        for depth in ("v1", "v2"):
            response = make_film(depth, parameters).respond([0, -0.9 * 2e-4, 0, 0], np.zeros(4), 200.0)
            force = np.hypot(*response.wrench[:2])
            assert 0.1 < force / most_load(seat, 200.0, 0.9) < 1.0


@pytest.mark.parametrize("name", bundled_trains())
def test_the_bundled_trains_are_far_from_exhausted(name):
    train = load_train(name)
    for seat, load in zip(train.bearings, target_loads(train), strict=True):
        assert load < 0.05 * most_load(seat, train.speed)
