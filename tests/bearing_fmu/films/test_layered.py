"""V1 and V2 on a soft layer: answers on every grid, exact tangent, an independent solution, rigid limit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import SPEED, TURBINE, lever, respond, table
from tests.bearing_fmu.films.independent_layer import solve
from tests.bearing_fmu.films.test_tangent import errors

LAYER = replace(TURBINE, layer_thickness=5e-3)
STATES = {
    "open": ((0.3, -0.7, 0.1, 0.05), (0.02, 0.1, 0.05, -0.02)),
    "layer takes part": ((0.3, -0.86, 0.01, 0.02), (0.02, 0.1, 0.05, -0.02)),
    "edge in contact": ((0.2, -0.9, 0.085, 0.02), (0.01, 0.01, 0.0, 0.02)),
    "whole width in contact": ((0.1, -0.995, 0.001, 0.002), (0.01, 0.01, 0.0, 0.0)),
    "edge overlapped": ((0.2, -0.9, 0.09, 0.02), (0.01, 0.01, 0.02, 0.0)),
    "leaves the wall": ((0.2, -0.965, 0.01, 0.02), (-0.1, 0.4, 0.02, 0.0)),
}
RECORDED = [
    (
        np.array([float(x) for x in list(row.values())[:4]]),
        np.array([float(x) for x in list(row.values())[4:]]),
    )
    for row in table("contact_states.csv")
]
COMPARED = 6  #: of those, with little overlap

pytestmark = pytest.mark.slow  # the kernel of the layer compiles for a minute


@pytest.mark.parametrize("depth", ["v1", "v2"])
@pytest.mark.parametrize("speed", [SPEED, -SPEED])
@pytest.mark.parametrize("state", STATES)
def test_tangent(depth, speed, state):
    for parameters in (LAYER, replace(LAYER, ambient_pressure=1e5)):
        film, (q, v) = make_film(depth, parameters), map(np.array, STATES[state])
        by_position, by_velocity = errors(film, q, v, speed, step=1e-6)
        assert by_position < 1e-6
        assert by_velocity < 1e-6


def answers(grid):
    film = make_film("v1", replace(LAYER, columns=grid[0], rows=grid[1]))
    return [film.respond(q, v, SPEED) for q, v in RECORDED]


@pytest.fixture(scope="module")
def finest():
    return answers((192, 30))


BOUNDS = {
    (48, 8): {"film": 0.015, "contact": 0.012, "friction": 0.006, "largest pressure": 0.095, "K": 0.05},
    (96, 16): {"film": 0.005, "contact": 0.015, "friction": 0.006, "largest pressure": 0.012, "K": 0.015},
}
"""What was found is at most a fifth below; of the contact over at least 2 % of the film's force."""


@pytest.mark.parametrize("grid", BOUNDS)
def test_recorded_states_have_the_answer_of_two_doublings(grid, finest):
    half = 0.5 * LAYER.width
    units = np.outer((1.0, 1.0, half, half), (1.0, 1.0, half, half))
    for coarse, fine in list(zip(answers(grid), finest, strict=True))[:COMPARED]:
        film, exact = (r.wrench[:2] - r.contact_wrench[:2] for r in (coarse, fine))
        force = np.linalg.norm(exact)
        contact = abs(coarse.contact_force - fine.contact_force)
        stiffness, exact_stiffness = coarse.stiffness / units, fine.stiffness / units
        found = {
            "film": np.linalg.norm(film - exact) / force,
            "contact": contact / max(fine.contact_force, 0.02 * force),
            "friction": abs(coarse.friction_power / fine.friction_power - 1.0),
            "largest pressure": abs(coarse.p_max / fine.p_max - 1.0),
            "K": np.abs(stiffness - exact_stiffness).max() / np.abs(exact_stiffness).max(),
        }
        for name, bound in BOUNDS[grid].items():
            assert found[name] < bound, name


@pytest.mark.parametrize("index", [2, 5])
def test_an_independent_solution_agrees(index):
    q, v = RECORDED[index]
    film = make_film("v1", replace(LAYER, columns=96, rows=16)).respond(q, v, SPEED)
    other = solve(LAYER, q, v, SPEED, (288, 48))
    force = film.wrench[:2] - film.contact_wrench[:2]
    np.testing.assert_allclose(force, other.film_force, atol=0.01 * np.linalg.norm(force))
    assert film.contact_force == pytest.approx(other.contact_force, rel=0.04)
    assert film.p_max == pytest.approx(other.p_max, rel=0.05)


def test_the_layer_comes_in_smoothly():
    """Over the states in which it begins to count the force has no jump and its tangent is exact."""
    film = make_film("v1", LAYER)
    way = np.linspace(0.80, 0.94, 71)
    forces = np.array([respond(film, (0.1, -e, 0.02, 0.01), speed=SPEED).wrench[1] for e in way])
    stiffness = np.array([
        respond(film, (0.1, -e, 0.02, 0.01), speed=SPEED).stiffness[1, 1] * lever(LAYER)[1] for e in way
    ])  # fmt: skip
    steps = np.diff(way)
    trapezoids = 0.5 * (stiffness[1:] + stiffness[:-1]) * steps
    np.testing.assert_allclose(np.diff(forces), trapezoids, atol=0.02 * np.abs(np.diff(forces)).max())


def test_pressures_are_those_of_a_yielding_metal():
    """The rigid film reaches gigapascals there."""
    q, v = STATES["edge overlapped"]
    soft, rigid = (respond(make_film("v1", p), q, v, SPEED) for p in (LAYER, TURBINE))
    assert soft.contact_force < 0.5 * rigid.contact_force
    assert soft.p_max < 0.5e9 < rigid.p_max
    assert 0.0 < soft.contact_force < rigid.contact_force


def test_far_from_contact_the_bore_is_rigid_to_the_bit():
    q, v = STATES["open"]
    soft, rigid = (respond(make_film("v1", p), q, v, SPEED) for p in (LAYER, TURBINE))
    np.testing.assert_array_equal(soft.wrench, rigid.wrench)
    np.testing.assert_array_equal(soft.stiffness, rigid.stiffness)


def test_a_thin_layer_in_reach_of_contact_is_nearly_rigid():
    """It differs by the oil's flow between asperities and by its grid alone."""
    q, v = (0.2, -0.955, 0.005, 0.01), (0.01, 0.02, 0.0, 0.0)
    thin = replace(TURBINE, layer_thickness=1e-7)
    soft, rigid = (respond(make_film("v1", p), q, v, SPEED) for p in (thin, TURBINE))
    np.testing.assert_allclose(soft.wrench[:2], rigid.wrench[:2], atol=0.02 * np.abs(rigid.wrench).max())
