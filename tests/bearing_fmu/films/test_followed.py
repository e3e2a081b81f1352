"""Oil that warms and cools in time: balance in closed form, steady state, and what is remembered."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from bearing_fmu.film import Film, make_film
from bearing_fmu.films.followed import FollowedFilm
from bearing_fmu.outputs import OUT_GAP
from fmus.port import Oil
from tests.bearing_fmu.bearings import lever, plain

OIL, SUPPLY, DENSITY, SPEED = Oil.of_grade(46), 318.15, 870.0, 314.0
POWER, FLOW, TEMPERATURE = OUT_GAP + 9, OUT_GAP + 16, OUT_GAP + 17


def bearing(begin, **changes):
    """A bearing whose oil begins at a temperature, K."""
    return plain(
        0.5, diameter=0.2, width=0.1, clearance=2e-4, supply_temperature=SUPPLY, temperature="followed",
        viscosity=OIL.dynamic(begin, DENSITY), viscosity_40=OIL.at_40, viscosity_100=OIL.at_100, **changes,
    )  # fmt: skip


def inputs(parameters, place=(0.4, -0.5, 0.0, 0.0)):
    values = np.zeros(17)
    values[:4], values[16] = np.array(place) * lever(parameters), SPEED
    return values


def run(film, steps, dt):
    """Outputs of every step at rest, the first one in balance."""
    at, outs = inputs(film.parameters), []
    out, state = film.evaluate(film.rest(), at, 0.0)
    outs.append(out)
    for _ in range(steps):
        out, state = film.evaluate(state, at, dt)
        outs.append(out)
    return np.array(outs)


@pytest.mark.parametrize("depth", ["v1", "v2", "v3"])
def test_the_steady_state_is_that_of_the_held_oil(depth):
    """It closes the balance to 1e-6, and a film of the viscosity then found gives the same outputs."""
    parameters = bearing(330.0)
    out = run(make_film(depth, parameters), 60, 1.0)[-1]
    rise = out[TEMPERATURE] - SUPPLY
    carried = 2.0 * DENSITY * parameters.heat_capacity * out[FLOW] * rise
    assert carried == pytest.approx(out[POWER], rel=1e-6)
    warm = replace(parameters, temperature="held", viscosity=OIL.dynamic(out[TEMPERATURE], DENSITY))
    held = make_film(depth, warm)
    assert isinstance(held, Film) and not isinstance(held, FollowedFilm)
    np.testing.assert_allclose(held.evaluate(held.rest(), inputs(warm), 0.0)[0], out, rtol=1e-6, atol=1e-9)


def test_warming_in_closed_form():
    """Without flow and at a constant power the temperature rises linearly; near balance exponentially."""
    parameters = bearing(330.0, heat_storage=1e7)  # slow: power and flow stay what they are
    outs = run(make_film("v3", parameters), 10, 0.5)
    power, carried = outs[0, POWER], 2.0 * DENSITY * parameters.heat_capacity * outs[0, FLOW]
    rest = SUPPLY + power / carried
    expected = rest + (330.0 - rest) * np.exp(-carried * 0.5 * np.arange(11) / 1e7)
    np.testing.assert_allclose(outs[:, TEMPERATURE] - 330.0, expected - 330.0, rtol=2e-3)


def test_first_order_in_the_step():
    parameters = bearing(330.0)
    ends = [run(make_film("v3", parameters), count, 0.1 / count)[-1, TEMPERATURE] for count in (20, 40, 80)]
    assert (ends[0] - ends[1]) / (ends[1] - ends[2]) == pytest.approx(2.0, abs=0.2)


def test_nothing_is_kept_but_the_state():
    """The same state, inputs and step give the same outputs to the bit, whatever was evaluated between."""
    film = make_film("v2", bearing(330.0))
    at, other = inputs(film.parameters), inputs(film.parameters, (0.1, -0.8, 0.0, 0.0))
    _, state = film.evaluate(film.rest(), at, 0.0)
    first, after = film.evaluate(state, at, 0.01)
    film.evaluate(after, other, 0.02)
    again, after_again = film.evaluate(state, at, 0.01)
    np.testing.assert_array_equal(first, again)
    np.testing.assert_array_equal(after, after_again)


@pytest.mark.parametrize(
    "changes, words",
    [
        ({"viscosity_40": 0.0}, "needs an oil"),
        ({"boundary": "jfo", "ambient_pressure": 1e5}, "allowed with a rigid bore that is fixed"),
    ],
)
def test_what_it_does_not_go_with(changes, words):
    with pytest.raises(ValueError, match=words):
        replace(bearing(330.0), **changes)
