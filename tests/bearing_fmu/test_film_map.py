"""The picture of a film holds its pressure: integrated it gives the film's force, its top is the largest."""

from dataclasses import replace

import numpy as np
import pytest

from bearing_fmu.film_map import film_map
from bearing_fmu.outputs import INPUTS, OUT_GAP
from fmus.port.bore import Arc, to_text
from tests.bearing_fmu.bearings import SPEED, TURBINE, lever, v

FINE = replace(TURBINE, columns=96, rows=12)
LEMON = to_text(
    (Arc(0.1, np.pi - 0.1, 0.5, 0.5 * np.pi), Arc(np.pi + 0.1, 2 * np.pi - 0.1, 0.5, 1.5 * np.pi))
)
TURBULENT = replace(FINE, turbulence="constantinescu", density=860.0)
LINED = replace(FINE, layer_thickness=5e-3, layer_modulus=5e10, layer_poisson=0.35, layer_hardness=2e8)
CASES = {
    "v1": ("v1", FINE, (0.3, -0.6, 0.15, -0.1)),
    "v1-reynolds": ("v1", replace(FINE, boundary="reynolds", columns=192), (0.3, -0.6, 0.1, 0.0)),
    "v1-lemon": ("v1", replace(FINE, bore=LEMON, feed_pressure=2e5), (0.1, -0.3, 0.05, 0.1)),
    "v1-ambient": ("v1", replace(FINE, ambient_pressure=2e5), (0.3, -0.4, 0.1, 0.0)),
    "v1-layer, as rigid": ("v1", LINED, (0.1, -0.3, 0.05, 0.0)),
    "v1-layer, hardly giving way": ("v1", LINED, (0.4, -0.85, 0.01, 0.0)),
    "v1-layer, giving way": ("v1", LINED, (0.4, -0.9, 0.03, -0.02)),
    "v2": ("v2", FINE, (0.3, -0.6, 0.0, 0.0)),
    "v2-odd": ("v2", replace(FINE, rows=11), (0.3, -0.6, 0.0, 0.0)),
    "v3": ("v3", FINE, (0.3, -0.6, 0.0, 0.0)),
    "v3-turbulent": ("v3", TURBULENT, (0.3, -0.6, 0.0, 0.0)),
}

LONG = pytest.mark.slow  # these kernels compile for a minute


@pytest.mark.parametrize(
    ("depth", "parameters", "place"),
    [pytest.param(*case, id=name, marks=[LONG] * ("layer" in name)) for name, case in CASES.items()],
)
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


@LONG
def test_a_film_on_a_layer_is_led_along_the_samples():
    """A journal that approaches the wall: what the wall takes up lowers the pressure."""
    bearing = replace(LINED, columns=48, rows=8)
    units, step, film = lever(bearing), 5e-5, v("v1", bearing)
    rate = np.tile(np.array([0.0, -0.5, 0.0, 0.0]) * units * SPEED, (6, 1))
    q = np.array([0.2, -0.95, 0.02, 0.0]) * units + rate * step * np.arange(-5, 1)[:, None]
    found = film_map("v1", bearing.values(), q, rate, SPEED, columns=1441, rows=81, step=step)
    state = film.rest()
    for k in range(len(q)):
        inputs = np.zeros(INPUTS)
        inputs[:4], inputs[4:8], inputs[16] = q[k], rate[k], SPEED
        out, state = film.evaluate(state, inputs, step if k else 0.0)
    peak, wanted = out[OUT_GAP + 3], out[:2] - out[OUT_GAP + 5 : OUT_GAP + 7]
    inward = -np.array([np.cos(found.angle), np.sin(found.angle)])
    force = np.trapezoid(np.trapezoid(found.pressure, found.z, axis=0) * inward, found.angle) * bearing.radius
    np.testing.assert_allclose(force, wanted, atol=1e-2 * np.hypot(*wanted))
    assert found.pressure.max() == pytest.approx(peak, rel=1e-2)
    assert abs(film.respond(q[-1], rate[-1], SPEED).p_max / peak - 1.0) > 0.1  # in balance it is another one


def test_a_table_is_drawn_as_the_film_that_it_looks_up():
    units, bearing = lever(FINE), replace(TURBINE, columns=48)
    q, rate = np.array([0.3, -0.6, 0.0, 0.0]) * units, np.array([0.05, 0.02, 0.0, 0.0]) * units * SPEED
    film, known = (film_map(depth, bearing.values(), q, rate, SPEED) for depth in ("table", "v2"))
    np.testing.assert_array_equal(film.pressure, known.pressure)


def test_depths_without_a_film_have_no_map():
    assert film_map("linear", {}, np.zeros(4), np.zeros(4), SPEED) is None
    assert film_map("of-another-maker", {}, np.zeros(4), np.zeros(4), SPEED) is None


@LONG
def test_a_mass_conserving_film_holds_pressure_and_content():
    """Finite volumes, drawn by smooth functions: within some per cent; full of oil where it bears."""
    ambient = 2e5
    bearing = replace(FINE, boundary="jfo", ambient_pressure=ambient)
    units = lever(bearing)
    q, rate = np.array([0.3, -0.6, 0.1, 0.0]) * units, np.zeros(4)
    found = film_map("v1", bearing.values(), q, rate, SPEED, columns=721, rows=81)
    response = v("v1", bearing).respond(q, rate, SPEED)
    inward = -np.array([np.cos(found.angle), np.sin(found.angle)])
    force = np.trapezoid(np.trapezoid(found.pressure, found.z, axis=0) * inward, found.angle) * bearing.radius
    wanted = (response.wrench - response.contact_wrench)[:2]
    np.testing.assert_allclose(force, wanted, atol=2e-2 * np.hypot(*wanted))
    assert found.pressure.max() == pytest.approx(response.p_max, rel=5e-2)
    np.testing.assert_allclose(found.pressure[[0, -1]], ambient, rtol=1e-12)
    assert found.content.min() < 0.9
    assert found.content[found.pressure > 0.2 * found.pressure.max()].min() > 0.999
