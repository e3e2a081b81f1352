"""The bearing FMUs give what the film gives, to the bit, and refuse what it refuses."""

import math

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from bearing_fmu import depths
from bearing_fmu.film import make_film
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.recipe import bearing_recipe
from fmus import port
from tests.faults import fault

OUTPUTS = [v.name for v in port.BEARING_OUTPUTS]
INPUTS = [v.name for v in port.BEARING_INPUTS]
START = {v.name: v.start for v in port.BEARING}
PARAMETERS = BearingParameters.of(START)


@pytest.fixture(params=depths.films())
def depth(request):
    return request.param


@pytest.fixture
def bearing(hosts, depth):
    instance = hosts[f"bearing_{depth}.fmu"].open()
    yield instance
    instance.slave.freeInstance()


def states(count):
    """Inputs within the clearance, with tilts, rates and a moving housing."""
    random = np.random.default_rng(7)
    for _ in range(count):
        position = random.uniform(-1.0, 1.0, 4) * (3e-4, 3e-4, 1e-4, 1e-4)
        rate = random.uniform(-1.0, 1.0, 4) * (1e-2, 1e-2, 1e-3, 1e-3)
        yield np.concatenate((position, rate, 0.05 * position[::-1], 0.1 * rate[::-1], [150.0]))


def test_steps_give_the_numbers_of_the_film(bearing, depth):
    offset = np.array([1e-5, -2e-5, 3e-6, 4e-6])
    bearing.start(dict(zip((f"offset.{q}" for q in port.POSITION), offset, strict=True)))
    film, expected = make_film(depth, PARAMETERS), np.zeros(len(OUTPUTS))
    for k, inputs in enumerate(states(10)):
        bearing.set(dict(zip(INPUTS, inputs, strict=True)))
        assert bearing.step(k * 1e-4, 1e-4), bearing.said
        assert film.solve(inputs, offset, expected) == 0
        assert bearing.get(*OUTPUTS) == expected.tolist()


def test_a_bearing_on_its_own_carries_at_half_its_clearance(bearing):
    bearing.start()
    assert bearing.get("eccentricity") == pytest.approx(0.5, rel=1e-12)
    assert bearing.get("h_min") == pytest.approx(0.5 * START["clearance"], rel=1e-12)
    assert bearing.get("wrench.Fy") > 0.0


def test_the_law_gives_the_wrench_at_the_state(bearing):
    bearing.start()
    for k, inputs in enumerate(states(3)):
        bearing.set(dict(zip(INPUTS, inputs, strict=True)))
        assert bearing.step(k * 1e-4, 1e-4)
        F, F0 = np.array(bearing.get(*port.FORCE)), np.array(bearing.get(*port.F0))
        K, C = (np.reshape(bearing.get(*names), (4, 4)) for names in (port.K, port.C))
        q, v = inputs[:4] - inputs[8:12], inputs[4:8] - inputs[12:16]  # of the journal in its housing
        scale = np.abs(F0) + np.abs(K) @ np.abs(q) + np.abs(C) @ np.abs(v)
        np.testing.assert_array_less(np.abs(F0 - K @ q - C @ v - F), 1e-14 * scale + 1e-12)


@pytest.mark.parametrize(
    ("name", "value"),
    [("clearance", -1e-4), ("viscosity", 0.0), ("diameter", math.nan), ("film.columns", 3)],
)
def test_a_bad_parameter_is_an_error_with_the_reason(bearing, name, value):
    with pytest.raises(FMICallException, match="fmi2ExitInitializationMode"):
        bearing.start({name: value})
    assert not bearing.step(0.0, 1e-4)
    assert name.rpartition(".")[2] in bearing.said


@fault(
    "film",
    "a journal far outside its bore",
    "fmi2Discard; `failure` 1, eccentricity ratio, tilts, least gap, advice; outputs as before",
    guard="bearing_fmu.film:Film.evaluate",
)
def test_a_journal_far_outside_is_a_discard_with_advice_and_the_state(bearing):
    bearing.start()
    before = bearing.get(*OUTPUTS)
    bearing.set({"journal.x": 0.01})
    assert not bearing.step(0.0, 1e-4)
    clearance, y = bearing.get("clearance", "journal.y")
    distance = math.hypot(0.01, y)
    assert "smaller step" in bearing.said and bearing.get("failure") == port.Failure.FILM
    assert f"eccentricity ratio {distance / clearance:.4g}, tilts 0 and 0 urad" in bearing.said
    assert f"least gap {1e6 * (clearance - distance):.4g} um of a clearance of" in bearing.said
    assert bearing.get(*OUTPUTS) == before
    bearing.set({"journal.x": 0.0})
    assert bearing.step(0.0, 1e-4) and bearing.get("failure") == port.Failure.NONE


def test_a_state_repeats_a_step_to_the_bit(bearing):
    bearing.start()
    state = bearing.state()
    first = []
    for repeat in range(2):
        if repeat:
            bearing.restore(state)
        found = []
        for k, inputs in enumerate(states(5)):
            bearing.set(dict(zip(INPUTS, inputs, strict=True)))
            assert bearing.step(k * 1e-4, 1e-4)
            found.append(bearing.get(*OUTPUTS))
        first = first or found
    assert found == first


def test_units_of_all_depths_share_their_sources():
    sources = [bearing_recipe(depth).sources for depth in depths.names()]
    assert sources[0] == sources[1] == sources[2]
    assert len({bearing_recipe(depth).guid for depth in depths.names()}) == len(depths.names())


def test_an_unknown_depth_is_refused():
    with pytest.raises(ValueError, match=f"'v9': allowed are {', '.join(depths.names())}"):
        bearing_recipe("v9")
