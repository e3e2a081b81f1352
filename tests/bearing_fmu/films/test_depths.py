"""The depths agree where their assumptions do; the discretisation converges."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_fmu import depths
from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import SPEED, TURBINE, lever, plain, respond


@pytest.mark.parametrize("q", [(0.3, -0.5), (0.0, 0.0), (0.1, -0.97), (0.0, -1.005)])
@pytest.mark.parametrize("columns, rows", [(48, 8), (40, 5)])
def test_v2_is_v1_at_zero_tilt(q, columns, rows):
    parameters = plain(
        0.8,
        columns=columns,
        rows=rows,
        ambient_pressure=3e4,
        roughness=4e-6,
        contact_modulus=1e8,
        friction=0.1,
    )
    v1, v2 = (
        respond(make_film(depth, parameters), [*q, 0.0, 0.0], [0.1, 0.05, 0.0, 0.0]) for depth in ("v1", "v2")
    )
    size = np.abs(v1.wrench).max()
    np.testing.assert_allclose(v2.wrench[:2], v1.wrench[:2], atol=1e-10 * size)
    np.testing.assert_allclose(v1.wrench[2:], 0.0, atol=1e-9 * size)
    for a, b in ((v1.stiffness, v2.stiffness), (v1.damping, v2.damping)):
        np.testing.assert_allclose(b[:2, :2], a[:2, :2], atol=1e-8 * np.abs(a[:2, :2]).max())
    assert v2.friction_power == pytest.approx(v1.friction_power, rel=1e-9)
    assert v2.h_min == v1.h_min
    assert v2.contact_force == pytest.approx(v1.contact_force, rel=1e-10)
    assert v2.p_max == pytest.approx(v1.p_max, rel=5e-3)


@pytest.mark.parametrize("depth", ["v2", "table", "v3"])
def test_aligned_depths_ignore_tilts(depth):
    film = make_film(depth, TURBINE)
    q, v = np.array([0.3, -0.6, 0.0, 0.0]), np.array([0.1, 0.0, 0.0, 0.0])
    straight = respond(film, q, v, SPEED)
    tilted = respond(film, [0.3, -0.6, 0.3, 0.2], [0.1, 0.0, 0.1, -0.1], SPEED)
    np.testing.assert_array_equal(tilted.wrench, straight.wrench)
    assert np.all(tilted.wrench[2:] == 0.0)
    for matrix in (tilted.stiffness, tilted.damping):
        assert np.all(matrix[2:] == 0.0) and np.all(matrix[:, 2:] == 0.0)
    assert tilted.h_min == tilted.h_min_centre
    assert tilted.h_min_z == 0.0


@pytest.mark.parametrize("e", (0.3, 0.6))
def test_v1_of_a_narrow_bearing_is_the_short_bearing(e):
    """The difference falls with (b/d)^2."""
    differences = []
    for aspect in (0.1, 0.05):
        parameters = plain(aspect, columns=192, rows=12)
        full, short = (
            respond(make_film(depth, parameters), [e, 0, 0, 0], [0.05, 0.02, 0, 0]).wrench[:2]
            for depth in ("v1", "v3")
        )
        differences.append(np.linalg.norm(full - short) / np.linalg.norm(short))
    assert differences[0] < 0.03
    assert differences[1] < 0.3 * differences[0]


def test_second_order_around_the_circumference():
    film = [make_film("v1", plain(0.5, columns=n, rows=12)) for n in (24, 48, 96, 192)]
    wrench = np.array([respond(f, [0.9, 0.0, 0.02, 0.03]).wrench[:2] for f in film])
    steps = np.linalg.norm(np.diff(wrench, axis=0), axis=1)
    assert np.all(steps[:-1] / steps[1:] > 3.5)


def test_fast_convergence_along_the_axis():
    """Twice the rows: at least thirty times less error, where a second-order method would have four."""
    exact, *others = (
        respond(make_film("v1", plain(0.5, rows=n)), [0.5, 0.0, 0.2, 0.4]).wrench for n in (28, 6, 12)
    )
    errors = [np.linalg.norm(w - exact) for w in others]
    assert errors[0] > 30.0 * errors[1]


@pytest.mark.parametrize("tilt", [(0.3, 0.2), (-0.3, 0.1), (0.0, 0.0)])
def test_least_gap(tilt):
    """Against a search over the whole gap."""
    q = np.array([0.3, -0.4, *tilt])
    response = respond(make_film("v1", TURBINE), q, speed=SPEED)
    z = np.linspace(-1.0, 1.0, 401)[:, None]
    phi = np.linspace(0.0, 2.0 * np.pi, 20001)
    gap = 1.0 - (q[0] + q[3] * z) * np.cos(phi) - (q[1] - q[2] * z) * np.sin(phi)
    assert response.h_min / TURBINE.clearance == pytest.approx(gap.min(), abs=1e-7)
    assert response.h_min_centre / TURBINE.clearance == pytest.approx(gap[200].min(), abs=1e-7)
    if any(tilt):
        at = z[np.unravel_index(gap.argmin(), gap.shape)[0], 0]
        assert response.h_min_z == pytest.approx(at * 0.5 * TURBINE.width)
    assert response.eccentricity == pytest.approx(0.5)


def test_friction_power_of_the_tilted_film():
    """Shear stress at the journal, eta U/h + h/2 dp/dx, integrated over a solution on a fine grid."""
    coarse, fine = (
        respond(make_film("v1", plain(0.6, columns=n, rows=m)), [0.5, -0.3, 0.2, 0.1]).friction_power
        for n, m in ((48, 8), (192, 20))
    )
    assert coarse == pytest.approx(fine, rel=1e-3)


def test_depth_names():
    assert depths.films() == ("v1", "v2", "table", "v3")
    with pytest.raises(ValueError, match=r"bearing depth 'v4': allowed are v1, v2, table, v3"):
        make_film("v4", TURBINE)
    with pytest.raises(ValueError, match="boundary = 'reynolds': the short film has guembel only"):
        make_film("v3", plain(0.5, boundary="reynolds"))


def test_units_of_the_tilts():
    """A tilt moves the edge by half the width."""
    units = lever(TURBINE)
    film = make_film("v1", TURBINE)
    response = film.respond([0.0, 0.0, 0.0, 0.5 * units[3]], np.zeros(4), SPEED)
    assert response.h_min == pytest.approx(0.5 * TURBINE.clearance)
