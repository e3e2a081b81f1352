"""The oil that leaves at the ends: the short bearing's closed form, depths alike; balance of heat."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import SPEED, TURBINE, plain, respond


def flow_unit(p):
    return p.radius**2 * p.clearance


def test_aligned_and_tilted_film_let_out_the_same():
    q, v = [0.4, -0.5, 0, 0], [0.02, 0.1, 0, 0]
    for change in ({}, {"turbulence": "constantinescu"}, {"ambient_pressure": 1e5}):
        p = replace(TURBINE, **change)
        one, two = (respond(make_film(depth, p), q, v, SPEED).oil_flow for depth in ("v1", "v2"))
        assert two == pytest.approx(one, rel=1e-9)


@pytest.mark.parametrize("eccentricity", [0.2, 0.6, 0.9])
def test_short_bearing_lets_out_what_its_wedge_drags_in(eccentricity):
    """The difference of what it drags in at the widest and the narrowest gap: U b/2 2 e C."""
    p = plain(0.05, columns=96, rows=12)
    short, film = (respond(make_film(depth, p), [eccentricity, 0, 0, 0]).oil_flow for depth in ("v3", "v2"))
    assert short == pytest.approx(eccentricity * p.clearance * p.width * p.radius, rel=1e-12)
    assert film == pytest.approx(short, rel=0.02)


def test_temperature_carries_the_friction_away():
    for depth in ("v1", "v2", "v3"):
        found = respond(make_film(depth, TURBINE), [0.4, -0.5, 0, 0], speed=SPEED)
        carried = 2.0 * TURBINE.density * TURBINE.heat_capacity * found.oil_flow
        rise = found.oil_temperature - TURBINE.supply_temperature
        assert rise * carried == pytest.approx(found.friction_power, rel=1e-12)


def test_a_centred_journal_lets_no_oil_out_and_says_no_infinity():
    for depth in ("v1", "v2", "v3"):
        found = respond(make_film(depth, TURBINE), [0, 0, 0, 0], speed=SPEED)
        assert found.oil_flow < 1e-12 * flow_unit(TURBINE) * SPEED
        assert found.oil_temperature == pytest.approx(TURBINE.supply_temperature + 1e3, rel=1e-12)
    still = respond(make_film("v1", TURBINE), [0, 0, 0, 0], speed=0.0)
    assert still.oil_temperature == TURBINE.supply_temperature
    assert np.isfinite(still.oil_flow)
