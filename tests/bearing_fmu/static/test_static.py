"""A bearing under static load: flow, coefficients and stability against tables and closed forms."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from bearing_fmu.film import make_film
from bearing_fmu.static.curves import Bearing
from bearing_fmu.static.equilibrium import carried, carried_each, threshold
from bearing_fmu.static.pressure import pressure_map, short_side_flow
from fmus.port.bore import grooved, lobes, to_text
from tests.bearing_fmu.bearings import SPEED, TURBINE, plain, table
from tests.bearing_fmu.published_rows import load_of

STILL = np.zeros(4)


@pytest.mark.parametrize(
    "row",
    [row for row in table("butenschoen_1976_rotation.csv") if row["eps"] in ("0.1", "0.5", "0.9", "0.97")],
    ids=lambda row: f"{row['B_over_D']}-{row['eps']}",
)
def test_side_flow_of_butenschoen(row):
    """Q / (R^3 psi omega) within 1 %, fed at the widest gap as in the table."""
    eps = float(row["eps"])
    p = plain(float(row["B_over_D"]), boundary="reynolds", columns=192, rows=20)
    found = pressure_map(p, np.array([eps * p.clearance, 0.0, 0.0, 0.0]), STILL, 1.0, fed_at=96)
    assert found.side_flow / (p.radius**2 * p.clearance) == pytest.approx(float(row["Q_ref"]), rel=0.01)


def test_side_flow_of_a_narrow_bearing_is_that_of_the_short_one():
    missed = []
    for aspect in (0.2, 0.1):
        p = plain(aspect, columns=256, rows=16)
        found = pressure_map(p, np.array([0.3 * p.clearance, 0.0, 0.0, 0.0]), STILL, 1.0)
        missed.append(1.0 - found.side_flow / short_side_flow(p, 0.3, 1.0))
    assert 0.0 < missed[1] < 0.02 and missed[1] < missed[0]


def test_grooves_let_nothing_out_at_their_ends():
    """Their pressure is above that beyond them, but they end in the bore; the unit counts so, too."""
    cut = to_text(grooved(lobes(1, 0.0), [(middle, math.radians(20.0)) for middle in (0.0, math.pi)]))
    p = plain(0.6, columns=96, rows=16, bore=cut, feed_pressure=5e5)
    q, speed = np.array([0.2e-3, -0.5e-3, 0.0, 0.0]), 1.0
    found = pressure_map(p, q, STILL, speed).side_flow
    assert found == pytest.approx(make_film("v1", p).respond(q, STILL, speed).oil_flow, rel=0.05)


def test_map_holds_the_pressure_that_the_film_has():
    p = replace(TURBINE, columns=96, rows=15)
    q = np.array([0.3, -0.6, 0.0, 0.0]) * p.clearance
    found, film = pressure_map(p, q, STILL, SPEED), make_film("v1", p).respond(q, STILL, SPEED)
    assert found.pressure.max() == pytest.approx(film.p_max, rel=0.02)
    assert np.all(np.diff(found.angle) > 0.0) and np.all(np.diff(found.z) > 0.0)
    ring = np.append(found.angle, found.angle[0] + 2.0 * np.pi)
    middle = np.trapezoid(found.pressure, found.z, axis=1)
    around = np.append(middle, middle[0])
    force = [-p.radius * np.trapezoid(around * turn(ring), ring) for turn in (np.cos, np.sin)]
    np.testing.assert_allclose(force, film.wrench[:2], rtol=0.03)


@pytest.mark.parametrize(
    ("inverse", "eps", "angle", "stiffness"),
    [(0.993, 0.2900, 85.05, (14.15, 6.31, -8.74, 1.18)), (0.105, 0.8707, 65.88, (7.05, 4.17, -0.07, 1.51))],
)
def test_two_lobes_of_another_solution(inverse, eps, angle, stiffness):
    """Finite differences of second order, 101 x 17 on half a lobe, Reynolds' condition by an active set; the
    lobes of the rows that the book's table has otherwise (eps 0.262 and 0.888, 85.9 and 68.3 deg).
    """
    cut = grooved(lobes(2, 0.5), [(middle, math.radians(10.0)) for middle in (0.0, math.pi)])
    p = plain(0.5, bore=to_text(cut), boundary="reynolds", columns=96)
    found = carried(make_film("v1", p), (0.0, -load_of(p, inverse)), 1.0)
    k, _ = found.matrices()
    assert float(np.hypot(*found.position)) / p.clearance == pytest.approx(0.5 * eps, rel=0.01)
    assert float(np.degrees(found.attitude)) == pytest.approx(angle, abs=0.3)
    np.testing.assert_allclose(p.clearance * k.ravel(), stiffness, rtol=0.02, atol=0.1)


@pytest.mark.parametrize("depth", ["v2", "table", "v3"])
def test_threshold_is_where_a_rigid_rotor_begins_to_grow(depth):
    """Against eigenvalues of a mass on the film's coefficients."""
    bearing = make_film(depth, TURBINE)
    load = Bearing(depth, TURBINE.values()).load_of(0.6, SPEED)
    k, b = (TURBINE.clearance * matrix for matrix in carried(bearing, (0.0, -load), SPEED).matrices())

    def growth(speed):
        """Largest real part, times root of C/g over the speed, of mass 1 over speed^2."""
        mass = speed**2
        zero, one = np.zeros((2, 2)), np.eye(2)
        system = np.block([[zero, one], [-k / mass, -b / mass]])
        return np.linalg.eigvals(system).real.max()

    limit = threshold(k, b)
    assert 2.0 < limit < 3.0
    assert growth(0.999 * limit) < 0.0 < growth(1.001 * limit)


def test_a_loaded_bearing_is_stable_at_any_speed():
    bearing = Bearing("v3", TURBINE.values())
    (light, heavy) = bearing.points([(0.0, -bearing.load_of(so, SPEED)) for so in (0.5, 10.0)], [SPEED] * 2)
    assert light.threshold < 3.0 and heavy.threshold == np.inf
    assert (light.sommerfeld, heavy.sommerfeld) == pytest.approx((0.5, 10.0))


def test_points_are_what_the_film_says():
    bearing = Bearing("v1", TURBINE.values())
    load = bearing.load_of(1.0, SPEED)
    (point,) = bearing.points([(load, 0.0)], [SPEED])
    found = carried(make_film("v1", TURBINE), (load, 0.0), SPEED)
    assert point.eccentricity == pytest.approx(found.response.eccentricity)
    assert point.attitude == pytest.approx(math.degrees(math.atan2(found.position[1], found.position[0])))
    assert point.friction == pytest.approx(
        found.response.friction_power / (load * SPEED * TURBINE.clearance), rel=1e-9
    )
    assert point.temperature_rise * 1.8e6 * point.side_flow == pytest.approx(point.friction_power)
    assert bearing.pressure((load, 0.0), SPEED).pressure.max() == pytest.approx(point.p_max, rel=0.02)


def test_what_no_film_carries():
    film = make_film("v2", plain(0.5))
    with pytest.raises(ArithmeticError):
        carried(film, (0.0, -1e300), 1.0)
    assert list(carried_each(film, [(0.0, -1e300)], [1.0])) == [None]
    (point,) = Bearing("v2", plain(0.5).values()).points([(0.0, -1e300)], [1.0])
    assert math.isnan(point.eccentricity) and point.stiffness is None
    with pytest.raises(ValueError, match="depth linear is none of the films"):
        from bearing_fmu import depths

        Bearing("linear", {v.name: v.start for v in depths.LINEAR.parameters})
