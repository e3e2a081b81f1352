"""Films against closed forms: short bearing, long bearing, squeeze film, Petroff."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import plain, respond
from tests.published import published

ECCENTRICITIES = (0.1, 0.3, 0.5, 0.7, 0.9, 0.97)
# Enough pressure at the ends that nothing ruptures: the full (2 pi) film.
FLOODED = 1e12


def short_unit(p):
    """Eta omega R b^3 / C^2 at omega = 1."""
    return p.viscosity * p.radius * p.width**3 / p.clearance**2


@pytest.mark.parametrize("e", ECCENTRICITIES)
@published("force of the short bearing", "Ocvirk 1953", "1e-12")
def test_ocvirk(e):
    """Ocvirk 1953: half film of the short bearing."""
    p = plain(0.25)
    fx, fy, mx, my = respond(make_film("v3", p), [e, 0, 0, 0]).wrench / short_unit(p)
    assert fx == pytest.approx(-(e**2) / (1 - e**2) ** 2, rel=1e-12)
    assert fy == pytest.approx(np.pi * e / (4 * (1 - e**2) ** 1.5), rel=1e-12)
    assert (mx, my) == (0.0, 0.0)


@pytest.mark.parametrize("e", ECCENTRICITIES[:-1])
@published(
    "stiffness and damping of the short bearing",
    "Friswell, Penny, Garvey and Lees 2010, section 5.5.1",
    "1e-10",
)
def test_friswell_stiffness_and_damping(e):
    """Friswell, Penny, Garvey, Lees 2010, section 5.5.1: K = a W/C, C = b W/(C omega), v against the load."""
    p = plain(0.25)
    response = respond(make_film("v3", p), [e, 0, 0, 0])
    force = response.wrench[:2]
    load = np.linalg.norm(force)
    up = force / load
    axes = np.array([[up[1], -up[0]], up])  # u, v
    s = np.sqrt(1 - e**2)
    h0 = (np.pi**2 * (1 - e**2) + 16 * e**2) ** -1.5
    pi2, e2 = np.pi**2, e**2
    stiffness = h0 * np.array(
        [
            [4 * (pi2 * (2 - e2) + 16 * e2), np.pi * (pi2 * (1 - e2) ** 2 - 16 * e2**2) / (e * s)],
            [
                -np.pi * (pi2 * (1 - e2) * (1 + 2 * e2) + 32 * e2 * (1 + e2)) / (e * s),
                4 * (pi2 * (1 + 2 * e2) + 32 * e2 * (1 + e2) / (1 - e2)),
            ],
        ]
    )
    cross = -8 * h0 * (pi2 * (1 + 2 * e2) - 16 * e2)
    damping = np.array(
        [
            [2 * np.pi * h0 * s * (pi2 * (1 + 2 * e2) - 16 * e2) / e, cross],
            [cross, 2 * np.pi * h0 * (pi2 * (1 - e2) ** 2 + 48 * e2) / (e * s)],
        ]
    )
    scale = load / p.clearance
    np.testing.assert_allclose(axes @ response.stiffness[:2, :2] @ axes.T / scale, stiffness, rtol=1e-10)
    np.testing.assert_allclose(axes @ response.damping[:2, :2] @ axes.T / scale, damping, rtol=1e-10)


@pytest.mark.parametrize("e", (0.1, 0.5, 0.8))
def test_full_short_film_damping(e):
    """Damping of the uncavitated short film, Szeri 1998, section 3.3; the ambient pressure keeps it full."""
    p = plain(0.25, ambient_pressure=FLOODED)
    damping = respond(make_film("v3", p), [e, 0, 0, 0]).damping
    unit = p.viscosity * p.radius * p.width**3 / p.clearance**3
    assert damping[0, 0] == pytest.approx(unit * np.pi * (1 + 2 * e**2) / (1 - e**2) ** 2.5, rel=1e-7)
    assert damping[1, 1] == pytest.approx(unit * np.pi / (1 - e**2) ** 1.5, rel=1e-7)


@pytest.mark.parametrize("e", (0.2, 0.5, 0.8))
@pytest.mark.parametrize("speed, squeeze", ((1.0, 0.0), (0.4, 0.3), (1.0, -0.7)))
def test_short_film_with_vanishing_ambient_pressure_is_the_closed_form(e, speed, squeeze):
    dry, wet = plain(0.25), plain(0.25, ambient_pressure=1e-9, columns=512)
    closed, flooded = (
        respond(make_film("v3", p), [e, 0, 0, 0], [squeeze, 0.05, 0, 0], speed) for p in (dry, wet)
    )
    np.testing.assert_allclose(flooded.wrench, closed.wrench, atol=2e-5 * np.abs(closed.wrench).max())


def per_length(e, v=(0.0, 0.0, 0.0, 0.0), speed=1.0, **changes):
    """Force per length away from the ends, over eta R^3 / C^2: the difference of two long bearings."""
    short, long_ = (plain(b, rows=24, columns=96, **changes) for b in (6.0, 8.0))
    forces = [respond(make_film("v1", p), [e, 0, 0, 0], v, speed).wrench[:2] for p in (short, long_)]
    unit = short.viscosity * short.radius**3 / short.clearance**2
    return (forces[1] - forces[0]) / (long_.width - short.width) / unit


@pytest.mark.parametrize("e", (0.2, 0.5, 0.8))
def test_long_bearing_sommerfeld(e):
    """Sommerfeld 1904, full film: the force is at right angles to the eccentricity."""
    fx, fy = per_length(e, ambient_pressure=FLOODED)
    expected = 12 * np.pi * e / ((2 + e**2) * np.sqrt(1 - e**2))
    assert fy == pytest.approx(expected, rel=2e-3)
    assert abs(fx) < 1e-4 * expected


@pytest.mark.parametrize("e", (0.2, 0.5, 0.8))
def test_long_bearing_guembel(e):
    """Guembel 1914: half of Sommerfeld's film."""
    fx, fy = per_length(e)
    assert fx == pytest.approx(-12 * e**2 / ((2 + e**2) * (1 - e**2)), rel=3e-3)
    assert fy == pytest.approx(6 * np.pi * e / ((2 + e**2) * np.sqrt(1 - e**2)), rel=2e-3)


@pytest.mark.parametrize("e", (0.2, 0.5, 0.8))
def test_long_squeeze_film(e):
    """Full film, pure approach without rotation: 12 pi e' / (1 - e^2)^1.5."""
    parameters = [plain(b, rows=24, columns=96, ambient_pressure=FLOODED) for b in (6.0, 8.0)]
    damping = [respond(make_film("v1", p), [e, 0, 0, 0], speed=0.0).damping[0, 0] for p in parameters]
    unit = parameters[0].viscosity * parameters[0].radius ** 3 / parameters[0].clearance ** 3
    result = (damping[1] - damping[0]) / (parameters[1].width - parameters[0].width) / unit
    assert result == pytest.approx(12 * np.pi / (1 - e**2) ** 1.5, rel=2e-3)


@pytest.mark.parametrize("depth", ["v1", "v2", "v3"])
def test_petroff(depth):
    """Petroff 1883: shear loss of the centred journal, 2 pi eta omega^2 R^3 b / C."""
    p, speed = plain(0.8), 3.0
    power = respond(make_film(depth, p), [0, 0, 0, 0], speed=speed).friction_power
    expected = 2 * np.pi * p.viscosity * speed**2 * p.radius**3 * p.width / p.clearance
    assert power == pytest.approx(expected, rel=1e-12)
