"""Bores of arcs and grooves: against the plain one, each other, and the films in them as published."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearing_fmu.bore.bore import bore_of, least_gap
from bearing_fmu.film import make_film
from fmus.port.bore import Arc, check, from_text, grooved, lobes, room, tilting, to_text
from tests.bearing_fmu.bearings import lever, plain, respond

WHOLE = lobes(1, 0.0, first=1.2)
HORIZONTAL = (0.0, math.pi)


def cut(bore, degrees, at=HORIZONTAL):
    return grooved(bore, [(middle, math.radians(degrees)) for middle in at])


BORES = {
    "two-groove": cut(lobes(1, 0.0), 20.0),
    "lemon": cut(lobes(2, 0.5), 20.0),
    "three lobes that touch": lobes(3, 0.6, first=0.3),
    "offset halves": cut(lobes(2, 0.4, offset=1.0), 15.0),
    "partial": (Arc(math.radians(200.0), math.radians(340.0)),),
}
ROUGH = {"roughness": 3e-6, "contact_modulus": 1e9, "friction": 0.1}


@pytest.mark.parametrize("depth", ["v1", "v2"])
def test_one_arc_of_a_full_turn_is_the_plain_bore(depth):
    whole, known = (
        make_film(depth, plain(0.7, bore=to_text(bore), columns=96, **ROUGH)) for bore in (WHOLE, ())
    )
    for q in ([0.3, -0.5, 0.0, 0.0], [0.2, -0.93, 0.0, 0.0]):
        here, there = (respond(film, q, [0.1, 0.05, 0.0, 0.0]) for film in (whole, known))
        for part in ("wrench", "stiffness", "damping"):
            found, expected = (np.atleast_2d(getattr(r, part))[:2, :2] for r in (here, there))
            assert np.linalg.norm(found - expected) < 3e-3 * np.linalg.norm(expected)
        assert here.friction_power == pytest.approx(there.friction_power, rel=1e-3)
    here, there = (respond(film, [0.2, -0.985, 0.0, 0.0]) for film in (whole, known))
    assert here.contact_force == pytest.approx(there.contact_force, rel=1e-5)
    np.testing.assert_allclose(here.contact_wrench[:2], there.contact_wrench[:2], rtol=1e-5)
    assert (here.h_min, here.eccentricity) == pytest.approx((there.h_min, there.eccentricity))


def states(bore):
    """Journals in several directions, the last one in contact."""
    for angle, share in ((0.6, 0.3), (2.8, 0.9), (4.2, 0.95), (4.6, 1.004)):
        reach = share * min(room(bore, angle), 1.2)
        yield [reach * math.cos(angle), reach * math.sin(angle), 0.0, 0.0]


@pytest.mark.parametrize("name", BORES)
def test_aligned_film_in_a_bore_is_the_tilted_one_without_tilt(name):
    settings = {"bore": to_text(BORES[name]), "feed_pressure": 3e3, "ambient_pressure": 1e3, **ROUGH}
    films = [make_film(depth, plain(0.7, **settings)) for depth in ("v1", "v2")]
    for q in states(BORES[name]):
        here, there = (respond(film, q, [0.1, 0.05, 0.0, 0.0]) for film in films)
        for part in ("wrench", "stiffness", "damping"):
            found, expected = (
                getattr(r, part)[:2, ..., :2] if part != "wrench" else r.wrench[:2] for r in (here, there)
            )
            assert np.linalg.norm(found - expected) < 1e-11 * np.linalg.norm(expected)
        assert here.friction_power == pytest.approx(there.friction_power, rel=1e-11)


@pytest.mark.parametrize("name", ["lemon", "three lobes that touch"])
def test_tangent_in_a_bore_is_exact(name):
    parameters = plain(0.7, bore=to_text(BORES[name]), feed_pressure=3e3, **ROUGH)
    film, units = make_film("v1", parameters), lever(parameters)
    for q in states(BORES[name]):
        q, v = np.add(q, [0.0, 0.0, 0.002, -0.001]), np.array([0.1, 0.05, 0.02, 0.1])
        here = respond(film, q, v)
        for slope, move in ((here.stiffness, (1.0, 0.0)), (here.damping, (0.0, 1.0))):
            for k in range(4):
                step = 1e-6 * np.eye(4)[k]
                ends = [
                    respond(film, q + s * move[0] * step, v + s * move[1] * step).wrench for s in (-1.0, 1.0)
                ]
                found = (ends[0] - ends[1]) / (2e-6 * units[k])
                assert np.linalg.norm(found - slope[:, k]) < 1e-5 * np.linalg.norm(slope[:, k])


def test_feed_pressure_alone_lifts_by_its_area():
    """At rest the film of a centred journal carries the pressure of the grooves and what leaks from them."""
    width = math.radians(60.0)
    film = make_film(
        "v2",
        plain(5.0, bore=to_text(cut(lobes(1, 0.0), 60.0, (1.5 * math.pi,))), feed_pressure=1e5, columns=96),
    )
    centred = respond(film, [0.0] * 4, speed=1e-9)
    # the axial basis, zero at the ends, makes of a constant pressure what it can
    assert centred.p_max == pytest.approx(1e5, rel=0.02)
    assert centred.wrench[0] == pytest.approx(0.0, abs=1.0)
    assert 0.0 < centred.wrench[1] < 1e5 * 5.0 * 2.0 * math.sin(0.5 * width)


@pytest.mark.parametrize("name", BORES)
def test_room_ends_where_the_journal_touches(name):
    bore = BORES[name]
    for angle in np.linspace(0.0, 2.0 * math.pi, 25):
        reach = room(bore, float(angle))
        if reach < 10.0:
            q = reach * np.array([math.cos(angle), math.sin(angle), 0.0, 0.0])
            assert least_gap(bore_of(bore, 48), q)[0] == pytest.approx(0.0, abs=1e-12)


def test_room_on_tilting_pads_is_a_polygon_through_their_pivots():
    bore = tilting(4, 1.2, 0.2, 0.55)
    for arc in bore:
        assert room(bore, arc.towards) == pytest.approx(0.8, rel=1e-12)
        assert room(bore, arc.towards + math.pi / 4.0) == pytest.approx(0.8 * math.sqrt(2.0), rel=1e-12)


def test_bores_survive_their_text():
    for bore in (*BORES.values(), ()):
        assert from_text(to_text(bore)) == bore


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("oval", "'oval' is no bore"),
        ("[[0, 3.2]]", ""),
        ("[[0, 7, 0, 0]]", "allowed is 5 to 360 deg"),
        ("[[0, 3, 1.0, 0]]", "preload = 1; allowed is 0 to less than 1"),
        ("[[0, 3, 0, 0], [2, 4, 0, 0]]", "they overlap by 57.3 deg"),
        ("[[0, 3, 0.5, 1], [3, 6, 0, 0]]", "the gap has a step"),
        ("[[0, NaN, 0, 0]]", "finite numbers"),
    ],
)
def test_no_bore(text, words):
    if not words:
        assert check(from_text(text)) == (Arc(0.0, 3.2),)
        return
    with pytest.raises(ValueError, match=words):
        from_text(text)


def test_short_bearing_is_plain():
    with pytest.raises(ValueError, match="the short film knows the plain bore only"):
        make_film("v3", plain(0.5, bore=to_text(BORES["lemon"])))


def test_columns_must_do_for_the_arcs():
    with pytest.raises(ValueError, match="columns = 16: must be at least 35 for the 7 arcs"):
        make_film("v2", plain(0.5, columns=16, bore=to_text(cut(lobes(1, 0.0), 5.0, tuple(range(7))))))
