"""Pockets, pressure dams and feed holes in a bore."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearing_fmu.film import make_film
from bearing_fmu.static.pressure import pressure_map
from fmus.port.bore import Arc, from_text, grooved, lobes, pocketed, to_text
from tests.bearing_fmu.bearings import lever, plain, respond

DEG = math.radians(1.0)
HALVES = grooved(lobes(1, 0.0), [(0.0, 20.0 * DEG), (math.pi, 20.0 * DEG)])
DAM = pocketed(HALVES, [(72.5 * DEG, 125.0 * DEG, 0.75, 2.0, False)])
HOLE = pocketed(lobes(1, 0.0), [(1.5 * math.pi, 40.0 * DEG, 0.5, 0.0, True)])


def test_a_step_over_the_whole_width_is_that_of_rayleigh():
    """Pressure at the step of a wide one in closed form (Rayleigh 1918) within 1 %; journal in the middle."""
    deep, land = 125.0 * DEG, 35.0 * DEG
    bore = pocketed(HALVES, [(10.0 * DEG + 0.5 * deep, deep, 1.0, 1.0, False)])
    p = plain(10.0, bore=to_text(bore), columns=96, rows=20)
    found = respond(make_film("v1", p), [0.0] * 4)
    h1, h2 = 2.0 * p.clearance, p.clearance
    l1, l2 = p.radius * deep, p.radius * land
    step = 6.0 * p.viscosity * p.radius * (h1 - h2) * l1 * l2 / (h1**3 * l2 + h2**3 * l1)
    assert found.p_max == pytest.approx(step, rel=0.01)


def test_a_dam_presses_the_journal_down_and_a_shallow_one_not():
    dam, none = (make_film("v2", plain(0.6, bore=to_text(bore), columns=72)) for bore in (DAM, HALVES))
    shallow = make_film("v2", plain(0.6, bore=to_text([*_with_depth(DAM, 0.0)]), columns=72))
    q = [0.1, -0.2, 0.0, 0.0]
    pressed, free, same = (respond(film, q) for film in (dam, none, shallow))
    assert pressed.wrench[1] < free.wrench[1] - 0.2 * np.hypot(*free.wrench[:2])
    np.testing.assert_allclose(same.wrench[:2], free.wrench[:2], rtol=0.02, atol=0.01 * free.wrench[1])


def _with_depth(bore, depth):
    for arc in bore:
        yield Arc(arc.start, arc.end, arc.preload, arc.towards, None, depth if arc.share else 0.0, arc.share)


@pytest.mark.parametrize("bore", [DAM, HOLE], ids=["dam", "hole"])
def test_aligned_film_is_the_tilted_one_and_its_tangent_is_exact(bore):
    p = plain(0.6, bore=to_text(bore), columns=72, feed_pressure=3e3)
    films = [make_film(depth, p) for depth in ("v1", "v2")]
    q, v = np.array([0.3, -0.5, 0.0, 0.0]), np.array([0.1, 0.05, 0.0, 0.0])
    here, there = (respond(film, q, v) for film in films)
    np.testing.assert_allclose(here.wrench[:2], there.wrench[:2], rtol=1e-9)
    np.testing.assert_allclose(here.stiffness[:2, :2], there.stiffness[:2, :2], rtol=1e-9)
    units = lever(p)
    for k in range(2):
        h = 1e-6 * np.eye(4)[k]
        ends = [respond(films[1], q + s * h, v).wrench[:2] for s in (-1.0, 1.0)]
        slope = (ends[0] - ends[1]) / (2e-6 * units[k])
        assert np.linalg.norm(slope - there.stiffness[:2, k]) < 1e-5 * np.linalg.norm(slope)


def test_a_fed_pocket_lifts_a_journal_at_rest():
    p = plain(0.6, bore=to_text(HOLE), columns=72, feed_pressure=1e5, rows=12)
    found = respond(make_film("v2", p), [0.0] * 4, speed=1e-9)
    nodes = pressure_map(p, np.zeros(4), np.zeros(4), 1e-9).pressure
    assert nodes.max() == pytest.approx(1e5, rel=1e-6)
    assert found.p_max < 1.1e5  # the axial polynomial swings over at the edge of the pocket
    assert abs(found.wrench[0]) < 1e-6 * found.wrench[1]
    pocket = 1e5 * 0.5 * p.width * p.diameter * math.sin(20.0 * DEG)
    assert pocket < found.wrench[1] < 3.0 * pocket
    assert found.oil_flow > 0.0


def test_pockets_survive_their_text():
    for bore in (DAM, HOLE):
        assert from_text(to_text(bore)) == bore


def test_no_pocket():
    with pytest.raises(ValueError, match=r"pocket over 1\.5 of the width"):
        from_text("[[0, 3, 0, 0, null, 1, 1.5, false]]")
    with pytest.raises(ValueError, match="pocket of 30 deg at 0 deg; allowed is a place on one arc"):
        pocketed(HALVES, [(0.0, 30.0 * DEG, 0.5, 0.0, True)])
    with pytest.raises(ValueError, match="fixed pads and without pockets"):
        plain(0.6, bore=to_text(DAM), boundary="jfo")
