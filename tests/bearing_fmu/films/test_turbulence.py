"""Turbulent films against the published fits, independent integrals, and differences of the wrench."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid, quad, trapezoid

from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import SPEED, TURBINE, force_unit, plain, respond
from tests.bearing_fmu.films.test_tangent import errors

TURBULENT = replace(TURBINE, turbulence="constantinescu")


def around(re):
    return 12.0 + 0.0136 * re**0.90


def along(re):
    return 12.0 + 0.0043 * re**0.96


def thick(aspect, reynolds, **changes):
    """A smooth bearing whose clearance has this Reynolds number at 1 rad/s."""
    return plain(aspect, turbulence="constantinescu", density=reynolds / (0.5 * 1e-3), **changes)


@pytest.mark.parametrize("depth", ["v1", "v2", "v3"])
@pytest.mark.parametrize(("q", "v"), [
    ((0.3, -0.8, 0.1, 0.05), (0.02, 0.1, 0.05, -0.02)),
    ((0.2, -0.9, 0.09, 0.02), (0.01, 0.01, 0.0, 0.02)),
    ((0.3, 0.6, 0.05, -0.2), (-0.4, -0.5, 0.1, 0.1)),
])  # fmt: skip
def test_tangent(depth, q, v):
    for parameters in (TURBULENT, replace(TURBULENT, ambient_pressure=1e5)):
        by_position, by_velocity = errors(make_film(depth, parameters), np.array(q), np.array(v), SPEED)
        assert by_position < 4e-7
        assert by_velocity < 2e-7


@pytest.mark.parametrize("depth", ["v1", "v2", "v3"])
def test_laminar_limit(depth):
    q, v = (0.3, -0.6, 0.0, 0.0), (0.02, 0.1, 0.0, 0.0)
    laminar = respond(make_film(depth, plain(0.7)), q, v)
    thin = respond(make_film(depth, thick(0.7, 1e-9)), q, v)
    np.testing.assert_allclose(
        thin.wrench, laminar.wrench, rtol=1e-9, atol=1e-9 * np.abs(laminar.wrench).max()
    )
    assert thin.friction_power == pytest.approx(laminar.friction_power, rel=1e-9)
    # switched off, the density does not count, to the bit
    heavy = respond(make_film(depth, plain(0.7, density=1e4)), q, v)
    assert heavy.wrench.tobytes() == laminar.wrench.tobytes()


def test_aligned_is_tilted_without_tilt():
    q, v = (0.3, -0.7, 0.0, 0.0), (0.02, 0.1, 0.0, 0.0)
    one, two = (respond(make_film(depth, TURBULENT), q, v, SPEED) for depth in ("v1", "v2"))
    np.testing.assert_allclose(one.wrench[:2], two.wrench[:2], rtol=1e-11)
    np.testing.assert_allclose(one.stiffness[:2, :2], two.stiffness[:2, :2], rtol=1e-8)
    assert one.friction_power == pytest.approx(two.friction_power, rel=1e-11)


@pytest.mark.parametrize("reynolds", [500.0, 2e4])
@pytest.mark.parametrize("e", [0.3, 0.9])
def test_short_bearing_against_quadrature(reynolds, e):
    """Force, largest pressure and friction of p = (b/d)^2/2 (1 - z^2) k_z/12 e sin(phi)/H^3."""
    aspect, x = 0.25, 0.6 * e
    y = -0.8 * e
    response = respond(make_film("v3", thick(aspect, reynolds)), (x, y, 0.0, 0.0))

    def pressure(phi):
        h = 1.0 - x * np.cos(phi) - y * np.sin(phi)
        return max(0.0, y * np.cos(phi) - x * np.sin(phi)) * along(reynolds * h) / 12.0 / h**3

    def integral(weight):
        start = np.arctan2(-x, y) - np.pi / 2
        return quad(
            lambda t: pressure(t) * weight(t), start, start + np.pi, epsabs=0, epsrel=1e-11, limit=500
        )[0]

    unit = 6.0 * aspect**2 / 2.0 * (4.0 / 3.0)  # 6 eta omega R^2/C^2, integral of 1 - z^2
    expected = [-unit * integral(np.cos), -unit * integral(np.sin)]
    parameters = thick(aspect, reynolds)
    np.testing.assert_allclose(response.wrench[:2] / force_unit(parameters)[:2], expected, rtol=1e-7)
    fine = max(pressure(t) for t in np.linspace(0, 2 * np.pi, 20001))
    assert response.p_max == pytest.approx(6.0 * (0.5 / 1e-3) ** 2 * aspect**2 / 2.0 * fine, rel=1e-5)


@pytest.mark.parametrize("reynolds", [500.0, 2e4])
def test_wide_bearing_against_quadrature(reynolds):
    """Pressure at the middle of a wide flooded film: p' = 6 k_x/12 (H - H_0)/H^3 with no net rise around."""
    e, ambient = 0.5, 1e8
    parameters = thick(16.0, reynolds, ambient_pressure=ambient, columns=256, rows=30)
    response = respond(make_film("v2", parameters), (e, 0.0, 0.0, 0.0))
    phi = np.linspace(0.0, 2.0 * np.pi, 20001)
    h = 1.0 - e * np.cos(phi)
    resistance = around(reynolds * h) / 12.0 / h**3
    constant = trapezoid(resistance * h, phi) / trapezoid(resistance, phi)
    rise = cumulative_trapezoid(resistance * (h - constant), phi, initial=0.0)
    # far from the ends the mean around, weighted with the axial conductance, is the ambient pressure
    weight = h**3 * 12.0 / along(reynolds * h)
    rise -= trapezoid(rise * weight, phi) / trapezoid(weight, phi)
    expected = 6.0 * (0.5 / 1e-3) ** 2 * rise.max()
    assert response.p_max - ambient == pytest.approx(expected, rel=1e-3)


def test_friction_of_a_centred_journal():
    """Couette's shear over the whole film with the drag of turbulence."""
    laminar, turbulent = (respond(make_film("v1", p), (0, 0, 0, 0)) for p in (plain(0.7), thick(0.7, 3e3)))
    assert turbulent.friction_power == pytest.approx(
        laminar.friction_power * (1 + 0.0012 * 3e3**0.94), rel=1e-9
    )


def test_turbulence_bears_more():
    """At Re = 2000 a bearing of the train carries some ten per cent more at the same eccentricity."""
    q = (0.4, -0.7, 0.0, 0.0)
    laminar, turbulent = (respond(make_film("v1", p), q, speed=SPEED) for p in (TURBINE, TURBULENT))
    ratio = np.hypot(*turbulent.wrench[:2]) / np.hypot(*laminar.wrench[:2])
    assert 1.05 < ratio < around(1950.0) / 12.0
    assert turbulent.friction_power > 1.3 * laminar.friction_power
