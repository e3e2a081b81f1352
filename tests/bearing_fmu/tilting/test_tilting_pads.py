"""Tilting pads: against an independent solution, a published table, and what must hold of any of them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearing_fmu.film import FilmFailure, make_film
from bearing_fmu.static.pressure import pressure_map
from fmus import port
from fmus.port.bore import from_text, tilting, to_text
from tests.bearing_fmu.bearings import force_unit, lever, plain
from tests.bearing_fmu.tilting.independent_pad import settled
from tests.bearing_fmu.tilting.pads import DEG, FOUR, ROUGH, UP, at_rest, film, matrices, step
from tests.marks import slow


@pytest.mark.parametrize(("offset", "near"), [(0.5, 0.45), (0.6, 0.45), (0.5, 0.22)])
def test_a_pad_is_where_another_solution_has_it(offset, near):
    """Tilt within 0.5 % of the clearance and force within 1 % of finite differences and a bisection."""
    arc = 70.0 * DEG
    one = tilting(1, arc, 0.2, offset, first=0.4)
    pivot = one[0].towards
    bearing = film(bore=to_text(one), columns=120, rows=12)
    q = (near - 0.2) * np.array([math.cos(pivot), math.sin(pivot), 0.0, 0.0])
    out, state = at_rest(bearing, q)
    beside, force = settled(arc, offset, near, 0.5)
    assert state[0] / bearing.parameters.clearance == pytest.approx(beside, abs=5e-3)
    unit = 12.0 * force_unit(bearing.parameters)[0]
    along = -(out[0] * math.cos(pivot) + out[1] * math.sin(pivot))
    assert along == pytest.approx(unit * force, rel=0.01)
    across = out[1] * math.cos(pivot) - out[0] * math.sin(pivot)
    assert abs(across) < 1e-10 * along  # the force passes through the pivot


@pytest.mark.parametrize("whirl", [0.0, 1.0, 0.5])
def test_two_pads_share_a_load_without_cross_coupling(whirl):
    out, _ = at_rest(film(whirl=whirl), [0.0, -0.6, 0.0, 0.0])
    assert abs(out[0]) < 1e-9 * out[1]
    for matrix in matrices(out):
        assert matrix[0, 0] == pytest.approx(matrix[1, 1], rel=1e-8)
        assert max(abs(matrix[0, 1]), abs(matrix[1, 0])) < 1e-8 * matrix[0, 0]


def test_a_centred_journal_in_preloaded_pads_is_held_alike_on_all_sides():
    k, _ = matrices(at_rest(film(bore=to_text(tilting(5, 60.0 * DEG, 0.5)), whirl=1.0), [0.0] * 4)[0])
    assert k[0, 0] == pytest.approx(k[1, 1], rel=1e-8) and abs(k[0, 1]) < 1e-8 * k[0, 0] and k[0, 0] > 0.0
    more, _ = matrices(at_rest(film(bore=to_text(tilting(5, 60.0 * DEG, 0.7)), whirl=1.0), [0.0] * 4)[0])
    assert more[0, 0] > 1.5 * k[0, 0]


@pytest.mark.parametrize("compliance", [0.0, 1e-9])
@pytest.mark.parametrize("depth", ["v2", slow("v1")])
def test_tangent_of_a_step_is_exact(depth, compliance):
    bearing = film(depth, to_text(tilting(4, 80.0 * DEG, 0.2, 0.55, 10.0 * DEG, compliance)), 0.7, **ROUGH)
    many = 4 if depth == "v1" else 2
    q, v = np.array([0.1, -0.5, 0.02, -0.01]), np.array([0.1, 0.05, 0.02, 0.03])
    _, state = at_rest(bearing, q)
    q, units = q + 0.02, lever(bearing.parameters)
    there = step(bearing, state, q, v, 0.05)[0]
    for matrix, move in zip(matrices(there), ((1.0, 0.0), (0.0, 1.0)), strict=True):
        for k in range(many):
            h = 1e-6 * np.eye(4)[k]
            ends = [
                step(bearing, state, q + s * move[0] * h, v + s * move[1] * h, 0.05)[0][:4] for s in (-1, 1)
            ]
            slope = (ends[0] - ends[1]) / (2e-6 * units[k])
            assert np.linalg.norm(slope - matrix[:, k]) < 1e-6 * np.linalg.norm(slope)
    np.testing.assert_allclose(
        there[4:8],
        there[:4] + matrices(there)[0] @ (q * units) + matrices(there)[1] @ (v * units),
        rtol=1e-12,
    )


def test_motion_of_pads_is_of_second_order_in_the_step():
    bearing = film(bore=to_text(tilting(4, 80.0 * DEG, 0.2)))

    def end(steps):
        _, state = at_rest(bearing, [0.0, -0.4, 0.0, 0.0])
        for t in np.arange(1, steps + 1) * (3.0 / steps):
            x, v = 0.2 * (1.0 - math.cos(t)), 0.2 * math.sin(t)
            out, state = step(bearing, state, [x, -0.4 + 0.5 * x, 0, 0], [v, 0.5 * v, 0, 0], 3.0 / steps)
        return out[:2]

    coarse, middle, fine = (end(n) for n in (25, 50, 100))
    assert 3.4 < np.linalg.norm(coarse - middle) / np.linalg.norm(middle - fine) < 4.6


def test_small_whirl_is_that_of_the_reduced_coefficients():
    """Force of a small orbit run in time, against K and C for this frequency."""
    bearing = film(whirl=1.0)
    centre, small, steps = np.array([0.0, -0.5, 0.0, 0.0]), 1e-4, 200
    out, state = at_rest(bearing, centre)
    k, c = (m[1, 1] * bearing.parameters.clearance for m in matrices(out))
    dt, forces = 2.0 * math.pi / steps, []
    for t in np.arange(1, 3 * steps + 1) * dt:
        q, v = centre + small * math.sin(t) * UP, small * math.cos(t) * UP
        now, state = step(bearing, state, q, v, dt)
        forces.append(now[1] - out[1])
    angle = np.arange(1, steps + 1) * dt
    last = np.array(forces[-steps:])
    assert -2.0 * np.mean(last * np.sin(angle)) / small == pytest.approx(k, rel=2e-3)
    assert -2.0 * np.mean(last * np.cos(angle)) / small == pytest.approx(c, rel=2e-3)


def test_pads_forget_a_wrong_tilt():
    bearing = film(bore=to_text(tilting(4, 80.0 * DEG, 0.5)))
    out, state = at_rest(bearing, [0.0, -0.4, 0.0, 0.0])
    wrong = state.reshape(4, 2, 2).copy()
    wrong[:, 0, 0] += 1e-4
    now = wrong.ravel()
    for _ in range(200):
        there, now = step(bearing, now, [0.0, -0.4, 0.0, 0.0], dt=0.3)
    np.testing.assert_allclose(there[:2], out[:2], atol=1e-6 * out[1])
    np.testing.assert_allclose(
        there[port_place("pad_tilt[1]") :][:4], out[port_place("pad_tilt[1]") :][:4], 1e-4
    )


def port_place(name):
    return [v.name for v in (*port.BEARING_OUTPUTS, *port.BEARING_DETAILS)].index(name)


def test_pads_that_carry_nothing_are_left_out():
    """Without preload the upper pads stand at the edge of what would carry; alone they give no force."""
    bearing = film()
    out, state = at_rest(bearing, [0.0, -0.5, 0.0, 0.0])
    lower = film(bore=to_text([a for a in from_text(FOUR) if a.towards > math.pi]), columns=26)
    alone, _ = at_rest(lower, [0.0, -0.5, 0.0, 0.0])
    np.testing.assert_allclose(out[:40], alone[:40], rtol=0.03, atol=1e-6 * abs(out[8]))
    tilts = state.reshape(4, 2, 2)[:, 0, 0]
    assert np.all(np.abs(tilts) < 1e-3)


def test_stiff_pivots_are_rigid_ones_and_soft_ones_give_way():
    q = [0.0, -0.5, 0.0, 0.0]
    rigid, stiff, soft = (
        at_rest(film(bore=to_text(tilting(4, 80.0 * DEG, 0.0, compliance=c)), whirl=1.0), q)[0]
        for c in (0.0, 1e-14, 1e-8)
    )
    np.testing.assert_allclose(stiff[:2], rigid[:2], rtol=1e-5, atol=1e-6 * rigid[1])
    np.testing.assert_allclose(stiff[8:40], rigid[8:40], rtol=1e-4, atol=1e-5 * rigid[8])
    assert soft[1] < 0.9 * rigid[1] and soft[8] < rigid[8]
    assert soft[8] < 2.0 / 1e-8  # the springs of two pivots


@pytest.mark.parametrize("reach", [0.2, 0.5, 0.8, 1.0])
def test_elastic_pivots_at_rest_in_any_direction(reach):
    """Also where some pads carry next to nothing."""
    bearing = film(bore=to_text(tilting(4, 80.0 * DEG, 0.2, 0.55, compliance=2e-10)))
    for angle in (-1.5, -1.2, -0.8):
        out, _ = at_rest(bearing, [reach * math.cos(angle), reach * math.sin(angle), 0.0, 0.0])
        assert np.all(np.isfinite(out)) and out[1] > 0.0


def test_turned_back_the_pads_are_mirrored():
    forth, back = (film(bore=to_text(tilting(4, 80.0 * DEG, 0.1))) for _ in range(2))
    here, there = at_rest(forth, [0.1, -0.5, 0, 0]), at_rest(back, [-0.1, -0.5, 0, 0], speed=-1.0)
    np.testing.assert_allclose(here[0][:2], there[0][:2] * [-1.0, 1.0], rtol=1e-6)


def test_contact_of_pads():
    out, _ = at_rest(film("v2", FOUR, 0.5, **ROUGH), [0.0, -1.412, 0.0, 0.0])
    assert out[44] > 0.0  # contact force
    assert out[40] < 3e-5 and out[52] > 0.0
    closed = film("v2", FOUR)
    with pytest.raises(FilmFailure, match="GAP_CLOSED"):
        at_rest(closed, [0.0, -1.42, 0.0, 0.0])


@pytest.mark.slow  # another kernel
def test_pressure_of_pads_adds_up_to_their_force():
    p = plain(0.5, bore=FOUR, columns=160, rows=15)
    q = np.array([0.1, -0.5, 0.0, 0.0]) * p.clearance
    found, out = pressure_map(p, q, np.zeros(4), 1.0), make_film("v1", p).respond(q, np.zeros(4), 1.0)
    middle = np.trapezoid(found.pressure, found.z, axis=1)
    lift = -p.radius * np.trapezoid(middle * np.sin(found.angle), found.angle)
    assert lift == pytest.approx(out.wrench[1], rel=0.03)


@pytest.mark.parametrize(
    ("bore", "words"),
    [
        ("[[0, 3.3, 0, 1, 0]]", "allowed is less than 180 deg, pivot on it"),
        ("[[0, 1, 0, 2, 0]]", "pivot on it"),
        ("[[0, 1, 0, 0.5, 0], [1, 2, 0, 1.5, 0]]", "a groove between pads"),
        ("[[0, 1, 0, 0.5, 0], [2, 3, 0, 2.5]]", "arcs that tilt beside fixed ones"),
        ("[[0, 1, 0, 0.5, -1]]", "compliance = -1 m/N; allowed is 0 to 1e-3"),
        ("[[0, 1, 0, 0.5, 0, 1, 0.5, true]]", "a pocket in a pad that tilts"),
    ],
)
def test_no_pads(bore, words):
    with pytest.raises(ValueError, match=words):
        from_text(bore)


def test_who_knows_pads():
    with pytest.raises(ValueError, match="knows the plain bore only"):
        make_film("v3", plain(0.5, bore=FOUR))
    with pytest.raises(ValueError, match="fixed pads"):
        plain(0.5, bore=FOUR, boundary="jfo")
