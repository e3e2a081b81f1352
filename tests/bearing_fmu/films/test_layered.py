"""V1 and V2 on a soft layer: exact tangent, convergence with the grid, bounds, and the rigid limit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import SPEED, TURBINE, respond
from tests.bearing_fmu.films.test_tangent import errors

LAYER = replace(TURBINE, layer_thickness=5e-3)
STATES = {
    "open": ((0.3, -0.7, 0.1, 0.05), (0.02, 0.1, 0.05, -0.02)),
    "edge in contact": ((0.2, -0.9, 0.085, 0.02), (0.01, 0.01, 0.0, 0.02)),
    "whole width in contact": ((0.1, -0.995, 0.001, 0.002), (0.01, 0.01, 0.0, 0.0)),
    "edge overlapped": ((0.2, -0.9, 0.09, 0.02), (0.01, 0.01, 0.02, 0.0)),
}

pytestmark = pytest.mark.slow  # the kernel of the layer compiles for a minute


@pytest.mark.parametrize("depth", ["v1", "v2"])
@pytest.mark.parametrize("speed", [SPEED, -SPEED])
@pytest.mark.parametrize("state", STATES)
def test_tangent(depth, speed, state):
    for parameters in (LAYER, replace(LAYER, ambient_pressure=1e5)):
        by_position, by_velocity = errors(make_film(depth, parameters), *map(np.array, STATES[state]), speed)
        assert by_position < 1e-6
        assert by_velocity < 1e-6


def test_twice_the_grid_changes_the_force_by_less_than_three_per_cent():
    q, v = STATES["edge overlapped"]
    finer = replace(LAYER, columns=96, rows=16)
    coarse, fine = (respond(make_film("v1", p), q, v, SPEED) for p in (LAYER, finer))
    np.testing.assert_allclose(coarse.wrench[:2], fine.wrench[:2], atol=0.03 * np.abs(fine.wrench[:2]).max())


def test_pressures_are_those_of_a_yielding_metal():
    """The rigid film reaches gigapascals there."""
    q, v = STATES["edge overlapped"]
    soft, rigid = (respond(make_film("v1", p), q, v, SPEED) for p in (LAYER, TURBINE))
    assert soft.contact_force < 0.5 * rigid.contact_force
    assert soft.p_max < 0.5e9 < rigid.p_max
    assert 0.0 < soft.contact_force < rigid.contact_force


def test_a_thin_layer_far_from_contact_is_rigid():
    q, v = STATES["open"]
    thin = replace(TURBINE, layer_thickness=1e-9)
    soft, rigid = (respond(make_film("v1", p), q, v, SPEED) for p in (thin, TURBINE))
    np.testing.assert_allclose(soft.wrench, rigid.wrench, atol=1e-6 * np.abs(rigid.wrench).max())
    np.testing.assert_allclose(soft.stiffness, rigid.stiffness, atol=1e-5 * np.abs(rigid.stiffness).max())
