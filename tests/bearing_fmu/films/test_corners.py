"""Corners of accuracy: tilted centred journals, journals that leave the wall, and between two answers."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import plain
from tests.bearing_fmu.films.test_tangent import errors
from tests.benchmarks.corners import finely_cut_stiffness, leaving_force, leaving_reference, stiffness
from tests.published import published

DEFAULT = (48, 8)


@pytest.mark.parametrize(
    "aspect, state",
    [(0.8, (0.02, -0.01, 0.5, 0.1)), (0.8, (0.0, 0.0, 0.9, 0.0)), (0.8, (0.05, 0.1, 0.6, -0.2))],
)
@published("tilted, nearly centred journals", "positive part cut on 300 lines", "stiffness 1 % at 48 x 8")
def test_stiffness_of_tilted_journals(aspect, state):
    q = np.array(state)
    exact = finely_cut_stiffness(aspect, q, (96, 16))
    assert np.abs(stiffness(aspect, q, DEFAULT) - exact).max() < 0.01 * np.abs(exact).max()


@pytest.mark.parametrize("depth", ["v1", "v2"])
@pytest.mark.parametrize("aspect, eccentricity", [(0.5, 0.9), (0.5, 0.98), (0.8, 0.95)])
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
        ((0.6, 0.1, 0.05, 0.02), (-0.4, 0.1, 0.0, 0.0)),  # both grids
        ((0.9, 0.1, 0.0, 0.0), (-1.0, 0.1, 0.0, 0.0)),  # the spread grid alone
    ],
)
@pytest.mark.parametrize("depth", ["v1", "v2"])
def test_the_tangent_between_two_answers(depth, q, v):
    by_position, by_velocity = errors(make_film(depth, plain(0.8)), np.array(q), np.array(v), 1.0)
    assert by_position < 3e-8
    assert by_velocity < 1e-8
