"""Corners of accuracy: tilted centred journals, journals that leave the wall, and between two answers."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import lever, plain
from tests.bearing_fmu.films.test_tangent import errors
from tests.benchmarks.corners import finely_cut_stiffness, leaving_force, leaving_reference, stiffness
from tests.published import published

DEFAULT = (48, 8)


@pytest.mark.parametrize(
    "aspect, state",
    [
        (0.8, (0.02, -0.01, 0.5, 0.1)),
        (0.8, (0.0, 0.0, 0.9, 0.0)),
        (0.6, (0.0, 0.0, 0.95, 0.0)),
        (0.8, (0.005, -0.002, 0.3, 0.4)),
        (1.0, (0.0, 0.0, 0.11, 0.048)),
        (0.8, (0.05, 0.1, 0.6, -0.2)),
    ],
)
@published("tilted, nearly centred journals", "positive part cut on 300 lines", "stiffness 1 % at 48 x 8")
def test_stiffness_of_tilted_journals(aspect, state):
    q = np.array(state)
    exact = finely_cut_stiffness(aspect, q, (96, 16))
    assert np.abs(stiffness(aspect, q, DEFAULT) - exact).max() < 0.01 * np.abs(exact).max()


@pytest.mark.parametrize("depth", ["v1", "v2"])
@pytest.mark.parametrize(
    "aspect, eccentricity", [(0.5, 0.9), (0.5, 0.98), (0.8, 0.95), (0.8, 0.98), (1.0, 0.98)]
)
@published(
    "journals that leave the wall without rotating",
    "cosines along the axis on a fine grid, Guembel's condition",
    "force 1 % at 48 x 8, up to an eccentricity of 0.98",
)
def test_leaving_the_wall(depth, aspect, eccentricity):
    exact = leaving_reference(aspect, eccentricity, columns=300)
    assert leaving_force(aspect, eccentricity, DEFAULT, depth) == pytest.approx(exact, rel=0.01)


@pytest.mark.parametrize(
    "q, v",
    [
        ((0.08, -0.12, 0.5, 0.1), (0.01, -0.02, 0.03, 0.02)),  # some of the lines
        ((0.02, -0.01, 0.5, 0.1), (0.0, 0.0, 0.0, 0.0)),  # lines alone
        ((0.6, 0.1, 0.05, 0.02), (-0.12, 0.1, 0.0, 0.0)),  # both grids
        ((0.62, 0.1, 0.35, 0.1), (-0.12, 0.3, 0.02, 0.0)),  # all three
        ((0.9, 0.1, 0.0, 0.0), (-1.0, 0.1, 0.0, 0.0)),  # the spread grid alone
    ],
)
@pytest.mark.parametrize("depth", ["v1", "v2"])
def test_the_tangent_between_two_answers(depth, q, v):
    by_position, by_velocity = errors(make_film(depth, plain(0.8)), np.array(q), np.array(v), 1.0)
    assert by_position < 3e-8
    assert by_velocity < 1e-8


def _random_leaving(count):
    """Aspect, position and velocity of journals, some of them tilted, on any way off the wall."""
    random = np.random.default_rng(12)
    for _ in range(count):
        eccentricity, tilt, way = (
            random.uniform(0.5, 0.98),
            random.uniform(0.0, 0.8),
            random.uniform(0.0, 6.3),
        )
        tilt *= (0.98 - eccentricity) * random.integers(2)
        q = np.array([eccentricity, 0.0, tilt * np.cos(way), tilt * np.sin(way)])
        cosine, fast = random.uniform(0.1, 1.0), 10.0 ** random.uniform(-0.5, 0.5)
        across = random.choice([-1.0, 1.0]) * fast * np.sqrt(1.0 - cosine**2) + eccentricity
        yield random.choice([0.5, 0.8, 1.0]), q, np.array([-0.5 * fast * cosine, 0.5 * across, 0.0, 0.0])


@published(
    "journals that leave a wall, rotating",
    "two doublings of the grid",
    "force 1 % at 48 x 8, on any way off it",
)
def test_leaving_on_any_way():
    errors = []
    for aspect, q, v in _random_leaving(60):
        units, wrench = lever(plain(aspect)), []
        for columns, rows in (DEFAULT, (192, 30)):
            film = make_film("v1", plain(aspect, columns=columns, rows=rows))
            wrench.append(film.respond(q * units, v * units, 1.0).wrench / np.array([1, 1, aspect, aspect]))
        errors.append(np.linalg.norm(wrench[0] - wrench[1]) / np.linalg.norm(wrench[1]))
    assert max(errors) < 0.01


def test_stiffness_of_random_tilted_journals():
    random, errors = np.random.default_rng(8), []
    for _ in range(12):
        aspect, tilt, way = (
            random.choice([0.3, 0.5, 0.8, 1.0]),
            random.uniform(0.1, 0.9),
            random.uniform(0, 6.3),
        )
        e, phi = random.uniform(0.0, 0.3) * tilt, random.uniform(0.0, 6.3)
        e = min(e, 0.95 - tilt) if tilt < 0.95 else 0.0
        q = np.array([e * np.cos(phi), e * np.sin(phi), tilt * np.cos(way), tilt * np.sin(way)])
        exact = finely_cut_stiffness(aspect, q, (96, 20))
        errors.append(np.abs(stiffness(aspect, q, DEFAULT) - exact).max() / np.abs(exact).max())
    assert max(errors) < 0.01
