"""The gap open to the oil."""

from __future__ import annotations

import numpy as np
from scipy.integrate import quad

from bearing_fmu.bore.gap import RESIDUAL, ROUGH_LIMIT, flow_gap
from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import plain, respond

SIGMA = 0.004


def test_is_the_gap_beyond_the_asperities():
    for h in (ROUGH_LIMIT * SIGMA, 4.0 * SIGMA, 0.3, 2.0):
        assert flow_gap(h, SIGMA) == (h, 1.0, 0.0)
    assert flow_gap(0.01, 0.0) == (0.01, 1.0, 0.0)


def test_is_the_expected_opening():
    for h in SIGMA * np.linspace(-4.0, 3.2, 37):

        def opening(s, h=h):
            return max(h / SIGMA - RESIDUAL + s, 0.0) * 35.0 / 96.0 * (1.0 - s * s / 9.0) ** 3

        kink = min(max(RESIDUAL - h / SIGMA, -3.0), 3.0)
        expected = SIGMA * (RESIDUAL + quad(opening, kink, 3.0, epsabs=1e-14)[0])
        assert abs(flow_gap(h, SIGMA)[0] - expected) < 1e-13


def test_derivatives():
    step = 1e-6 * SIGMA
    for h in SIGMA * np.linspace(-3.5, 3.5, 71):
        below, here, above = flow_gap(h - step, SIGMA), flow_gap(h, SIGMA), flow_gap(h + step, SIGMA)
        assert here[0] > 0.0
        assert abs((above[0] - below[0]) / (2 * step) - here[1]) < 1e-8
        assert abs((above[1] - below[1]) / (2 * step) - here[2]) < 1e-5 / SIGMA


def test_roughness_leaves_an_open_film_alone():
    smooth, rough = (
        respond(make_film("v1", plain(0.7, roughness=s)), [0.4, -0.5, 0.1, 0.1]) for s in (0.0, 2e-6)
    )
    np.testing.assert_array_equal(rough.wrench, smooth.wrench)
    np.testing.assert_array_equal(rough.stiffness, smooth.stiffness)
