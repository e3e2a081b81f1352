"""What is told of a contact: largest pressure, overlap, the area that yields and that really touches."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from bearing_fmu.contact.greenwood_tripp import contact_pressure
from bearing_fmu.contact.layer import bounded_pressure, layered_pressure
from bearing_fmu.film import make_film
from tests.bearing_fmu.bearings import SPEED, TURBINE, respond

DEPTHS = ["v1", "v2", "v3"]
LAYER = replace(TURBINE, layer_thickness=2e-3)


def around(p, e, function):
    """Mean over an aligned bore of a function of the gap, m."""
    psi = (np.arange(200_000) + 0.5) * np.pi / 200_000
    near = p.clearance - e * np.cos(psi) < 7.0 * p.roughness
    values = np.zeros(psi.size)
    values[near] = function(p.clearance - e * np.cos(psi[near]))
    return values.mean()


@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("over", [-2.0, 1.0, 4.0])
def test_aligned_contact(depth, over):
    """Over an aligned journal, against the pressure law itself; `over` is the overlap in roughnesses."""
    p, e = TURBINE, TURBINE.clearance + over * TURBINE.roughness
    found = respond(make_film(depth, p), [0, -e / p.clearance, 0, 0], speed=SPEED)
    pressure = lambda gap: contact_pressure(gap, p.roughness, p.contact_modulus)  # noqa: E731
    hardness = p.layer_hardness
    assert found.contact_pressure == pytest.approx(float(pressure(p.clearance - e)), rel=1e-4)
    assert found.overlap == pytest.approx(max(over, 0.0) * p.roughness, rel=1e-9)
    touching = around(p, e, lambda gap: bounded_pressure(pressure(gap), hardness) / hardness)
    assert found.contact_area == pytest.approx(touching, rel=1e-3)
    assert found.wiped == pytest.approx(around(p, e, lambda gap: pressure(gap) >= hardness), abs=2e-5)
    assert (found.wiped > 0.0) == (over > -2.0)


@pytest.mark.parametrize("depth", DEPTHS)
def test_nothing_is_told_without_contact(depth):
    smooth = replace(TURBINE, contact_modulus=0.0)
    for p, e in ((TURBINE, 0.6), (smooth, 0.99)):
        found = respond(make_film(depth, p), [0, -e, 0, 0], speed=SPEED)
        assert (found.contact_pressure, found.overlap, found.wiped, found.contact_area) == (0, 0, 0, 0)


def test_tilted_contact_presses_most_at_the_edge():
    q = [0.2, -0.9, 0.09, 0.02]
    found = respond(make_film("v1", TURBINE), q, speed=SPEED)
    edge = float(contact_pressure(found.h_min, TURBINE.roughness, TURBINE.contact_modulus))
    assert found.contact_pressure == pytest.approx(edge, rel=1e-4)
    assert found.overlap == -found.h_min > 0.0
    assert 0.0 < found.wiped < found.contact_area < 0.1


def test_layer_of_the_short_bearing_bounds_its_asperities():
    e = LAYER.clearance + 4.0 * LAYER.roughness
    found = respond(make_film("v3", LAYER), [0, -e / LAYER.clearance, 0, 0], speed=SPEED)
    expected = float(layered_pressure(LAYER, np.array([-4.0]))[0])
    assert found.contact_pressure == pytest.approx(expected, rel=1e-4)
    assert found.contact_area == pytest.approx(
        around(LAYER, e, lambda gap: layered_pressure(LAYER, gap / LAYER.roughness) / LAYER.layer_hardness),
        rel=1e-3,
    )


@pytest.mark.slow  # the kernel of the layer compiles for a minute
def test_real_area_of_a_layer_is_its_load_over_the_hardness():
    q = [0.2, -0.9, 0.09, 0.02]
    p = replace(LAYER, layer_thickness=5e-4)
    found = respond(make_film("v1", p), q, speed=SPEED)
    bore = np.pi * p.diameter * p.width
    assert found.contact_area * bore * p.layer_hardness == pytest.approx(found.contact_force, rel=1e-9)
    assert 0.0 < found.wiped < found.contact_area
    assert 0.84 * p.layer_hardness < found.contact_pressure < p.layer_hardness
