"""Invariances: rotation, reflection, scaling, moving housing."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import SPEED, TURBINE, lever, plain, respond

Q = np.array([0.3, -0.62, 0.15, 0.1])
V = np.array([0.05, 0.1, -0.05, 0.02])
CONTACT = np.array([0.2, -0.9, 0.09, 0.02])


def turned(vector, angle):
    """Both pairs of a position, velocity or wrench turned about the axis."""
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    return np.concatenate((turn @ vector[:2], turn @ vector[2:]))


@pytest.mark.parametrize("depth", ["v1", "v2", "v3"])
@pytest.mark.parametrize("q", [Q, CONTACT])
def test_rotated_state_rotates_the_wrench(depth, q):
    film = make_film(depth, TURBINE)
    columns = 2.0 * np.pi / np.gcd(TURBINE.columns, 64)  # of all grids, see `films.corners`
    wrench = respond(film, q, V, SPEED).wrench
    size = np.linalg.norm(wrench[:2])
    for angle, tolerance in ((3 * columns, 1e-10), (1.234, 2e-3 if depth != "v3" else 1e-10)):
        result = respond(film, turned(q, angle), turned(V, angle), SPEED).wrench
        np.testing.assert_allclose(result, turned(wrench, angle), atol=tolerance * size)


@pytest.mark.parametrize("depth", ["v1", "v2", "v3"])
@pytest.mark.parametrize("q", [Q, CONTACT])
def test_mirrored_rotation_mirrors_the_wrench(depth, q):
    """Reflection y -> -y reverses the speed, tilt_y is kept and tilt_x reversed as a rotation is."""
    film = make_film(depth, TURBINE)
    mirror = np.array([1.0, -1.0, -1.0, 1.0])
    forward, backward = respond(film, q, V, SPEED), respond(film, q * mirror, V * mirror, -SPEED)
    np.testing.assert_allclose(backward.wrench, mirror * forward.wrench, rtol=1e-9, atol=1e-3)
    assert backward.friction_power == pytest.approx(forward.friction_power, rel=1e-10)
    flip = np.outer(mirror, mirror)
    np.testing.assert_allclose(
        backward.stiffness, flip * forward.stiffness, atol=1e-8 * np.abs(forward.stiffness).max()
    )


def test_turned_end_for_end():
    """Seen from the other end, z and x reversed, the axis turns and the rotation with it."""
    film = make_film("v1", TURBINE)
    flip = np.array([-1.0, 1.0, -1.0, 1.0])
    forward, backward = respond(film, Q, V, SPEED), respond(film, Q * flip, V * flip, -SPEED)
    np.testing.assert_allclose(backward.wrench, flip * forward.wrench, rtol=1e-9, atol=1e-3)


@pytest.mark.parametrize("depth", ["v1", "v2", "v3"])
def test_wrench_scales_with_viscosity_and_speed(depth):
    base = respond(make_film(depth, plain(0.8)), Q, V, 1.0)
    viscous = respond(make_film(depth, plain(0.8, viscosity=3.0)), Q, V, 1.0)
    fast = respond(make_film(depth, plain(0.8)), Q, V, 3.0)
    for other in (viscous, fast):
        np.testing.assert_allclose(other.wrench, 3.0 * base.wrench, rtol=1e-11)
        np.testing.assert_allclose(other.stiffness, 3.0 * base.stiffness, rtol=1e-9, atol=1.0)
        assert other.sommerfeld == pytest.approx(base.sommerfeld, rel=1e-11)
    np.testing.assert_allclose(fast.damping, base.damping, rtol=1e-9, atol=1.0)


@pytest.mark.parametrize("depth", ["v1", "v2", "v3"])
def test_wrench_scales_with_size(depth):
    """All lengths doubled at the same speed: forces fourfold, moments eightfold."""
    base = respond(make_film(depth, plain(0.8)), Q, V)
    twice = respond(make_film(depth, plain(1.6, diameter=2.0, clearance=2e-3)), Q, V)
    np.testing.assert_allclose(twice.wrench, base.wrench * [4, 4, 8, 8], rtol=1e-11)
    assert twice.p_max == pytest.approx(base.p_max, rel=1e-11)


@pytest.mark.parametrize("depth", ["v1", "v2", "v3"])
def test_moving_housing_and_offset(depth):
    """Only the relative motion counts; F0 - K q - C v with the journal's own q and v is the wrench."""
    film = make_film(depth, TURBINE)
    units = lever(TURBINE)
    rng = np.random.default_rng(1)
    inputs, offset, out = np.zeros(17), rng.normal(size=4) * units, np.empty(58)
    inputs[8:12] = rng.normal(size=4) * units
    inputs[12:16] = rng.normal(size=4) * units * SPEED
    inputs[:4] = Q * units + inputs[8:12] + offset
    inputs[4:8] = V * units * SPEED + inputs[12:16]
    inputs[16] = SPEED
    assert film.solve(inputs, offset, out) == 0
    expected = respond(film, Q, V, SPEED)
    np.testing.assert_allclose(out[:4], expected.wrench, rtol=1e-9, atol=1e-6)
    stiffness, damping = out[8:24].reshape(4, 4), out[24:40].reshape(4, 4)
    law = out[4:8] - stiffness @ (inputs[:4] - inputs[8:12]) - damping @ (inputs[4:8] - inputs[12:16])
    np.testing.assert_allclose(law, out[:4], rtol=1e-9, atol=1e-3)
