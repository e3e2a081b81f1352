"""Greenwood-Tripp contact against published integrals and brute-force integration."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from bearing_fmu.contact.greenwood_tripp import asperity_integral, contact_pressure
from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import SPEED, TURBINE, lever, plain, respond, table
from tests.published import published


@pytest.mark.parametrize("order, column", [(1.0, "F1"), (2.0, "F2"), (1.5, "F3/2"), (2.5, "F5/2")])
@published("integrals of the asperity contact", "Greenwood and Tripp 1970, as tabulated", "1e-6")
def test_tabulated_integrals(order, column):
    rows = table("greenwood_tripp_integrals.csv")
    gaps = np.array([float(row["H"]) for row in rows])
    expected = np.array([float(row[column]) for row in rows])
    np.testing.assert_allclose(asperity_integral(order, gaps), expected, rtol=1e-6)


@pytest.mark.parametrize("gap", [-50.0, -10.0, -3.0, -0.5, 0.3, 2.0, 5.0])
def test_integral_against_adaptive_quadrature(gap):
    def integrand(s):
        return (s - gap) ** 2.5 * np.exp(-0.5 * s * s) / np.sqrt(2.0 * np.pi)

    expected = quad(integrand, gap, max(gap, -9.0), epsabs=0, epsrel=1e-12)[0] if gap < -9.0 else 0.0
    expected += quad(integrand, max(gap, -9.0), max(gap, 0.0) + 9.0, epsabs=0, epsrel=1e-12, limit=400)[0]
    assert asperity_integral(2.5, gap) == pytest.approx(expected, rel=1e-10)


def test_derivative_and_overlap():
    """dF_5/2/dH = -5/2 F_3/2; far overlapped F_5/2 tends to (-H)^5/2 (1 + 15/8 H^-2)."""
    h, step = np.linspace(-20.0, 5.0, 101), 1e-4
    slope = (asperity_integral(2.5, h + step) - asperity_integral(2.5, h - step)) / (2 * step)
    np.testing.assert_allclose(slope, -2.5 * asperity_integral(1.5, h), rtol=1e-6)
    np.testing.assert_allclose(
        asperity_integral(2.5, -30.0), 30.0**2.5 * (1.0 + 15.0 / 8.0 / 900.0), rtol=1e-5
    )


def brute_force(parameters, q, sense=1.0):
    """Contact wrench and load by a midpoint rule on a grid that resolves the asperities."""
    q = np.asarray(q) * lever(parameters)
    half, sigma = 0.5 * parameters.width, parameters.roughness
    scan = half * np.linspace(-1.0, 1.0, 100001)
    touched = np.hypot(q[0] + q[3] * scan, q[1] - q[2] * scan) > parameters.clearance - 7.0 * sigma
    borders = np.flatnonzero(np.diff(np.r_[False, touched, False]))
    wrench, load = np.zeros(4), 0.0
    for first, last in zip(borders[::2], borders[1::2] - 1, strict=True):
        edges = np.linspace(scan[first], scan[last], 1001)
        part, part_load = _midpoint_sum(
            parameters, q, 0.5 * (edges[1:] + edges[:-1]), edges[1] - edges[0], sense
        )
        wrench, load = wrench + part, load + part_load
    return wrench, load


def _midpoint_sum(parameters, q, z, length, sense):
    sigma = parameters.roughness
    ex, ey = q[0] + q[3] * z, q[1] - q[2] * z
    psi = np.linspace(-0.45, 0.45, 2001)
    psi = 0.5 * (psi[1:] + psi[:-1])
    phi = np.arctan2(ey, ex)[:, None] + psi
    gap = parameters.clearance - ex[:, None] * np.cos(phi) - ey[:, None] * np.sin(phi)
    levels = np.linspace(gap.min() / sigma - 1.0, 8.0, 8001)
    pressure = np.interp(gap / sigma, levels, asperity_integral(2.5, levels)) * parameters.contact_modulus
    pressure *= parameters.radius * length * (psi[1] - psi[0])
    mu = parameters.friction * sense
    fx = -(pressure * (np.cos(phi) - mu * np.sin(phi))).sum(axis=1)
    fy = -(pressure * (np.sin(phi) + mu * np.cos(phi))).sum(axis=1)
    return np.array([fx.sum(), fy.sum(), -(z * fy).sum(), (z * fx).sum()]), pressure.sum()


@pytest.mark.parametrize(
    "q",
    [
        (0.2, -0.9, 0.085, 0.02),
        (0.2, -0.9, 0.095, 0.02),
        (0.0, -0.1, 0.89, 0.0),
        (0.0, -0.02, 0.995, 0.01),
        (0.1, -0.994, 0.002, 0.003),
        (0.1, -0.993, 0.0, 0.0),
        (0.0, -0.97, 0.05, 0.0),
        (0.0, -0.97, -0.08, 0.02),
    ],
)
@pytest.mark.parametrize("roughness", [2e-6, 3e-6])
def test_tilted_contact(q, roughness):
    """Edge contact down to h/C = -0.05, asperities of 2-3 um on a clearance of 0.86 mm."""
    parameters = plain(
        0.64,
        diameter=0.8,
        clearance=8.62e-4,
        viscosity=0.0242,
        roughness=roughness,
        contact_modulus=1e9,
        friction=0.2,
    )
    response = respond(make_film("v1", parameters), q, speed=SPEED)
    wrench, load = brute_force(parameters, q)
    half = 0.5 * parameters.width
    assert load > 0.0
    arm = np.array([1.0, 1.0, half, half])
    np.testing.assert_allclose(response.contact_wrench / arm, wrench / arm, atol=2e-5 * load)
    assert response.contact_force == pytest.approx(load, rel=2e-5)


def test_axial_quadrature_is_converged():
    """Edge contact up to seventeen roughnesses deep: against 400 slices of the aligned contact."""
    film = make_film("v1", TURBINE)
    aligned = make_film("v2", TURBINE)
    node, weight = np.polynomial.legendre.leggauss(400)
    for tilt in (0.082, 0.085, 0.09, 0.1, 0.13):
        q = np.array([0.0, -0.92, tilt, 0.0])
        start = max(-1.0, (1.0 - 7.0 * TURBINE.roughness / TURBINE.clearance - 0.92) / tilt)
        z = start + (1.0 - start) * 0.5 * (node + 1.0)
        slices = np.array(
            [respond(aligned, [0, q[1] - q[2] * s, 0, 0], speed=SPEED).contact_force for s in z]
        )
        expected = (slices * weight).sum() * 0.5 * (1.0 - start) / 2.0
        result = respond(film, q, speed=SPEED).contact_force
        assert result == pytest.approx(expected, rel=2e-8)


@pytest.mark.parametrize("depth", ["v2", "v3"])
def test_aligned_contact(depth):
    q = (0.1, -0.994, 0.0, 0.0)
    response = respond(make_film(depth, TURBINE), q, speed=SPEED)
    wrench, load = brute_force(TURBINE, q)
    np.testing.assert_allclose(response.contact_wrench, wrench, atol=2e-5 * load)


def test_contact_is_part_of_the_wrench():
    q = (0.2, -0.9, 0.09, 0.02)
    rough, smooth = (
        respond(make_film("v1", plain(0.64, roughness=2e-6, contact_modulus=m)), q) for m in (1e6, 2e6)
    )
    np.testing.assert_allclose(
        smooth.wrench - rough.wrench, rough.contact_wrench, rtol=1e-9, atol=1e-9 * np.abs(rough.wrench).max()
    )


def test_friction_opposes_rotation_and_vanishes_at_standstill():
    q = (0.0, -0.999, 0.0, 0.0)
    film = make_film("v2", TURBINE)
    forward, still, backward = (respond(film, q, speed=s).contact_wrench for s in (SPEED, 0.0, -SPEED))
    # At the bottom the surface of a journal turning from x to y moves to +x: friction acts to -x.
    assert forward[0] == pytest.approx(-0.1 * forward[1], rel=1e-9)
    assert backward[0] == pytest.approx(0.1 * backward[1], rel=1e-9)
    assert abs(still[0]) < 1e-9 * still[1]


def test_friction_power_includes_sliding():
    q = (0.0, -0.999, 0.0, 0.0)
    rough = respond(make_film("v2", TURBINE), q, speed=SPEED)
    values = {"roughness": 3e-6, "contact_modulus": 1e9, "friction": 0.0}
    slippery = respond(
        make_film("v2", plain(0.64, diameter=0.8, clearance=8.62e-4, viscosity=0.0242, **values)),
        q,
        speed=SPEED,
    )
    sliding = 0.1 * rough.contact_force * SPEED * TURBINE.radius
    assert rough.friction_power - slippery.friction_power == pytest.approx(sliding, rel=1e-9)


def test_stiffness_grows_through_overlap():
    """Smooth, finite and ever stiffer from open gap to far overlap."""
    film = make_film("v2", TURBINE)
    force = np.array(
        [respond(film, [0, -e, 0, 0], speed=SPEED).contact_force for e in np.linspace(0.98, 1.16, 300)]
    )
    assert np.all(np.isfinite(force))
    touched = force > 1.0
    assert np.all(np.diff(force[touched]) > 0.0)


def test_pressure_at_closed_gap():
    assert contact_pressure(0.0, 3e-6, 1e9) == pytest.approx(0.6166342e9, rel=1e-6)
