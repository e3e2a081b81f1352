"""The contact's own splines are those of scipy to the last bit."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from bearing_fmu.contact.cubic_spline import interpolate, spline_coefficients


@pytest.fixture
def points():
    random = np.random.default_rng(7)
    return np.cumsum(random.uniform(0.1, 1.0, 40)), random.normal(size=(40, 2))


def test_coefficients(points):
    x, y = points
    scipy_own = CubicSpline(x, y, bc_type=((1, np.zeros(2)), "not-a-knot")).c[::-1]
    assert np.array_equal(spline_coefficients(x, y, first_slope=0.0), scipy_own)
    assert np.array_equal(spline_coefficients(x, y), CubicSpline(x, y).c[::-1])


def test_values_at_knots_between_and_beyond(points):
    x, y = points
    at = np.concatenate([x, np.linspace(x[0] - 0.5, x[-1] + 0.5, 999)])
    assert np.array_equal(interpolate(x, y[:, 0], at), CubicSpline(x, y[:, 0])(at))


def test_a_cubic_is_its_own_spline():
    x = np.linspace(-1.0, 2.0, 7)
    at = np.linspace(-1.0, 2.0, 50)
    assert interpolate(x, x**3 - 2.0 * x, at) == pytest.approx(at**3 - 2.0 * at, abs=1e-14)
