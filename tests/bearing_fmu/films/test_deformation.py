"""The wall's rate of deformation on a soft layer: memory, limits, tangent, an independent solution."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from bearing_fmu.film import make_film
from bearing_fmu.outputs import INPUTS, OUT_C, OUT_GAP, OUT_K
from tests.bearing_fmu.bearings import SPEED, TURBINE, lever
from tests.bearing_fmu.films.independent_layer import Wall, solve

LAYER = replace(TURBINE, layer_thickness=5e-3)
UNITS = lever(LAYER)
WRENCH_UNITS = UNITS[0] / UNITS
CLOSE = np.array((0.2, -0.9, 0.045, 0.02)), np.array((0.01, 0.02, 0.0, 0.02))
TOUCHING = np.array((0.2, -0.9, 0.085, 0.02)), np.array((0.01, 0.01, 0.0, 0.02))

pytestmark = pytest.mark.slow  # the kernel of the layer compiles for a minute


def inputs(q, v, speed=SPEED):
    """The port at a position over the clearance and a velocity over clearance and speed."""
    row = np.zeros(INPUTS)
    row[:4], row[4:8], row[16] = q * UNITS, v * UNITS * SPEED, speed
    return row


def follow(film, path, step, count):
    """Outputs and states at the ends of steps along a path of the time, from balance on."""
    state, found = film.rest(), []
    for k in range(count + 1):
        t, h = k * step, 1e-7
        q, v = path(t), (path(t + h) - path(t - h)) / (2.0 * h * SPEED)
        out, state = film.evaluate(state, inputs(q, v), step if k else 0.0)
        found.append((out, state, q, v))
    return found


def whirl(rate):
    """A circular orbit."""
    return lambda t: 0.97 * np.array((np.cos(rate * t), np.sin(rate * t), 0.0, 0.0))


@pytest.mark.parametrize("share", [0.25, -0.2])
def test_a_steady_whirl_is_a_journal_at_rest_at_another_speed(share):
    """Seen from an orbit of the rate w the bore turns: speed dT/dphi + 2 dT/dt = (speed - 2 w) dT/dphi."""
    film, rate = make_film("v1", replace(LAYER, columns=96)), share * SPEED
    out, _, q, _ = follow(film, whirl(rate), 5e-5, 120)[-1]
    rest, _ = film.evaluate(film.rest(), inputs(q, np.zeros(4), SPEED - 2.0 * rate), 0.0)
    size = np.linalg.norm(rest[:2])
    np.testing.assert_allclose(out[:2], rest[:2], atol=0.004 * size)
    still, _ = film.evaluate(film.rest(), inputs(q, np.array((-q[1], q[0], 0.0, 0.0)) * share), 0.0)
    assert np.linalg.norm(still[:2] - rest[:2]) > 0.03 * size  # without memory it is another force


@pytest.mark.parametrize("state", [CLOSE, TOUCHING])
def test_at_rest_the_wall_comes_to_its_balance(state):
    film = make_film("v1", LAYER)
    q, v = state
    _, then = film.evaluate(film.rest(), inputs(q * 0.99, 0.5 * v), 0.0)
    for _ in range(60):
        out, then = film.evaluate(then, inputs(q, v), 1e-3)
    still, _ = film.evaluate(film.rest(), inputs(q, v), 0.0)
    np.testing.assert_allclose(out[:4], still[:4], rtol=1e-8, atol=1e-8 * np.abs(still[:2]).max())
    np.testing.assert_allclose(out[OUT_C:OUT_GAP], film.evaluate(then, inputs(q, v), 1e-3)[0][OUT_C:OUT_GAP])


@pytest.mark.parametrize("state", [CLOSE, TOUCHING])
@pytest.mark.parametrize("step", [1e-4, 1e-5])
def test_tangent(state, step):
    """K dq + C dq / dt is exact across the way; along it K has what the wall goes on to give way besides."""
    film = make_film("v1", LAYER)
    q, v = state
    _, then = film.evaluate(film.rest(), inputs(q - v * SPEED * step, v), 0.0)
    out, _ = film.evaluate(then, inputs(q, v), step)
    units = np.outer(WRENCH_UNITS, UNITS)
    stiffness, damping = (out[a:b].reshape(4, 4) * units for a, b in ((OUT_K, OUT_C), (OUT_C, OUT_GAP)))
    along = v / np.linalg.norm(v)
    across = np.linalg.svd(along[None])[2][1:]
    exact = stiffness + damping / step
    for d in across:
        ends = [
            film.evaluate(then, inputs(q + s * d, v + s * d / (SPEED * step)), step)[0][:4] * WRENCH_UNITS
            for s in (1e-7, -1e-7)
        ]
        found = -(ends[0] - ends[1]) / 2e-7
        np.testing.assert_allclose(exact @ d, found, atol=1e-6 * np.abs(exact).max())


def approach(t):
    """A journal that is pressed into its bore and leaves it again."""
    e = 0.93 + 0.025 * np.sin(2.0 * np.pi * 100.0 * t)
    return np.array((0.3 * e, -0.95 * e, 0.02, 0.01))


def defects(film, step):
    """Of the law that the end of each step hands to the next one, over the force; from 1 ms on."""
    found = follow(film, approach, step, round(6e-3 / step))[round(1e-3 / step) :]
    missed = []
    for (law, _, q, v), (out, _, q1, v1) in pairwise(found):
        stiffness, damping = law[OUT_K:OUT_C].reshape(4, 4), law[OUT_C:OUT_GAP].reshape(4, 4)
        told = law[:4] - stiffness @ ((q1 - q) * UNITS) - damping @ ((v1 - v) * UNITS * SPEED)
        missed.append(out[:2] - told[:2])
    force = np.array([out[:2] for out, *_ in found])
    return np.sqrt(np.mean(np.square(missed)) / np.mean(np.square(force)))


def test_the_law_meets_the_next_step_to_second_order():
    film = make_film("v1", LAYER)
    coarse, fine = defects(film, 2e-4), defects(film, 1e-4)
    assert fine < 0.0015
    assert fine < 0.4 * coarse


def test_two_factors_serve_a_step():
    """The start is where the last two steps point to."""
    film, state, counts = make_film("v1", LAYER), np.zeros(0), []
    for k in range(40):
        t, h = 1e-4 * k, 1e-7
        v = (approach(t + h) - approach(t - h)) / (2.0 * h * SPEED)
        _, state = film.evaluate(state, inputs(approach(t), v), 1e-4 if k else 0.0)
        space, data = film.take()
        counts.append(data[3].counts.copy())
        film.bring_back(space)
    factors, solutions, searches = np.median(counts, axis=0)
    assert (factors, searches) == (2.0, 0.0)
    assert solutions <= 4.0


def test_the_step_converges():
    """Of first order; the force without the wall's rate is elsewhere."""
    film = make_film("v1", LAYER)
    ends = [follow(film, approach, h, round(4e-3 / h))[-1][0][:2] for h in (1e-4, 5e-5, 2.5e-5)]
    q, v = approach(4e-3), (approach(4e-3 + 1e-7) - approach(4e-3 - 1e-7)) / (2e-7 * SPEED)
    still = film.evaluate(film.rest(), inputs(q, v), 0.0)[0][:2]
    size = np.linalg.norm(ends[-1])
    first, second = (np.linalg.norm(a - b) for a, b in pairwise(ends))
    assert second < 0.01 * size
    assert second == pytest.approx(0.5 * first, rel=0.3)
    assert np.linalg.norm(still - ends[-1]) > 0.05 * size


def test_an_independent_solution_agrees():
    """Finite volumes with the same steps, the journal pressed in along one direction."""
    film, wall = make_film("v1", LAYER), None
    path = follow(film, approach, 5e-4, 8)
    for _, _, q, v in path:
        other = solve(LAYER, q * UNITS, v * UNITS * SPEED, SPEED, (60, 20), wall)
        wall = Wall(other.pressure, 5e-4)
    out = path[-1][0]
    force = out[:2] - out[OUT_GAP + 5 : OUT_GAP + 7]
    size = np.linalg.norm(force)
    np.testing.assert_allclose(force, other.film_force, atol=0.02 * size)
    still = film.evaluate(film.rest(), inputs(q, v), 0.0)[0][:2]
    assert np.linalg.norm(still - other.film_force) > 0.05 * size


def test_the_state_is_taken_on_by_the_caller_only():
    film = make_film("v1", LAYER)
    q, v = CLOSE
    _, then = film.evaluate(film.rest(), inputs(q, v), 0.0)
    kept = then.copy()
    first, _ = film.evaluate(then, inputs(q * 1.01, v), 1e-4)
    np.testing.assert_array_equal(then, kept)
    film.evaluate(then, inputs(q * 0.9, v), 1e-4)
    again, _ = film.evaluate(kept, inputs(q * 1.01, v), 1e-4)
    np.testing.assert_array_equal(first, again)


def test_where_the_layer_hardly_counts_the_wall_is_remembered_to_no_effect():
    q, v = np.array((0.3, -0.7, 0.1, 0.05)), np.array((0.02, 0.1, 0.05, -0.02))
    soft, rigid = make_film("v1", LAYER), make_film("v1", TURBINE)
    _, then = soft.evaluate(soft.rest(), inputs(q, v), 0.0)
    out, _ = soft.evaluate(then, inputs(q, v), 1e-4)
    np.testing.assert_array_equal(out, rigid.evaluate(rigid.rest(), inputs(q, v), 1e-4)[0])
