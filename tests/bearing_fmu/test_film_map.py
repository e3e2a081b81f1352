"""The picture of a film holds its pressure: integrated it gives the film's force, its top is the largest."""

from dataclasses import replace

import numpy as np
import pytest

from bearing_fmu import depths
from bearing_fmu.film_map import film_map
from bearing_fmu.outputs import INPUTS, OUT_GAP
from fmus.port.bore import Arc, to_text
from tests.bearing_fmu.bearings import SPEED, TURBINE, lever, v

FINE = replace(TURBINE, columns=96, rows=12)
LEMON = to_text(
    (Arc(0.1, np.pi - 0.1, 0.5, 0.5 * np.pi), Arc(np.pi + 0.1, 2 * np.pi - 0.1, 0.5, 1.5 * np.pi))
)
TURBULENT = replace(FINE, turbulence="constantinescu", density=860.0)
CASES = {
    "v1": ("v1", FINE, (0.3, -0.6, 0.15, -0.1)),
    "v1-reynolds": ("v1", replace(FINE, boundary="reynolds", columns=192), (0.3, -0.6, 0.1, 0.0)),
    "v1-lemon": ("v1", replace(FINE, bore=LEMON, feed_pressure=2e5), (0.1, -0.3, 0.05, 0.1)),
    "v1-ambient": ("v1", replace(FINE, ambient_pressure=2e5), (0.3, -0.4, 0.1, 0.0)),
    "v2": ("v2", FINE, (0.3, -0.6, 0.0, 0.0)),
    "v2-odd": ("v2", replace(FINE, rows=11), (0.3, -0.6, 0.0, 0.0)),
    "v3": ("v3", FINE, (0.3, -0.6, 0.0, 0.0)),
    "v3-turbulent": ("v3", TURBULENT, (0.3, -0.6, 0.0, 0.0)),
}


@pytest.mark.parametrize(("depth", "parameters", "place"), CASES.values(), ids=CASES)
def test_a_map_integrates_to_the_force_of_its_film(depth, parameters, place):
    units = lever(parameters)
    q, rate = np.array(place) * units, np.array([0.05, 0.02, 0.0, 0.0]) * units * SPEED
    found = film_map(depth, parameters.values(), q, rate, SPEED, columns=1441, rows=81)
    response = v(depth, parameters).respond(q, rate, SPEED)
    wanted = response.wrench - response.contact_wrench
    inward = -np.array([np.cos(found.angle), np.sin(found.angle)])
    force = np.trapezoid(np.trapezoid(found.pressure, found.z, axis=0) * inward, found.angle)
    force *= parameters.radius
    np.testing.assert_allclose(force, wanted[:2], atol=4e-3 * np.hypot(*wanted[:2]))
    assert found.pressure.max() == pytest.approx(response.p_max, rel=5e-3)
    assert np.nanmin(found.gap) == pytest.approx(response.h_min, rel=1e-3)
    assert (found.pressure >= 0.0).all()


STARVED = replace(TURBINE, boundary="jfo", ambient_pressure=1e5, columns=48, rows=8)
LED = {
    "table": ("table", replace(TURBINE, columns=48), 5e-3),
    "mass-conserving": ("v1", STARVED, 2e-2),
}


@pytest.mark.parametrize(("depth", "parameters", "bound"), LED.values(), ids=LED)
def test_a_map_behind_some_samples_integrates_to_the_force_of_a_film_that_was_led_there(
    depth, parameters, bound
):
    units, step = lever(parameters), 2e-4
    time = step * np.arange(-4, 1)[:, None]
    q = np.array([0.25, -0.4, 0.0, 0.0]) * units + 0.4 * time * SPEED * np.array([0.1, 0.2, 0.0, 0.0]) * units
    rate = np.broadcast_to(np.gradient(q[:, :], step, axis=0), q.shape)
    film = depths.find(depth).make(parameters.values())
    state = film.rest()
    for k, (place, velocity) in enumerate(zip(q, rate, strict=True)):
        inputs = np.zeros(INPUTS)
        inputs[:4], inputs[4:8], inputs[16] = place, velocity, SPEED
        out, state = film.evaluate(state, inputs, step if k else 0.0)
    found = film_map(depth, parameters.values(), q, rate, SPEED, columns=721, rows=61, step=step)
    inward = -np.array([np.cos(found.angle), np.sin(found.angle)])
    force = np.trapezoid(np.trapezoid(found.pressure, found.z, axis=0) * inward, found.angle)
    force *= parameters.radius
    np.testing.assert_allclose(force, out[:2], atol=bound * np.hypot(*out[:2]))
    assert np.nanmin(found.gap) == pytest.approx(out[OUT_GAP], rel=5e-3)
    if parameters.boundary == "jfo":
        assert 0.2 < found.content.min() < 0.9 < found.content.max() < 1.0 + 1e-12
        full = found.pressure[1:-1] > 0.3 * found.pressure.max()
        np.testing.assert_allclose(found.content[1:-1][full], 1.0, rtol=1e-9)


def test_depths_without_a_film_have_no_map():
    assert film_map("linear", {}, np.zeros(4), np.zeros(4), SPEED) is None
    assert film_map("of-another-maker", {}, np.zeros(4), np.zeros(4), SPEED) is None
