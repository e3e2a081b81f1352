"""The evaluator as units use it: failures, repeatability, memory, parameters."""

from __future__ import annotations

from dataclasses import replace
from threading import Thread

import numpy as np
import pytest
from numba.core.runtime import _nrt_python as nrt
from numba.core.runtime import rtsys

from bearing_fmu import depths
from bearing_fmu.film import FilmFailure, FilmStatus, make_film
from bearing_fmu.parameters import BearingParameters
from fmus import port
from tests.bearing_fmu.bearings import SPEED, TURBINE, lever, plain, respond
from tests.faults import fault

DEPTHS = depths.films()


def port_inputs(q=(0.2, -0.7, 0.05, 0.1), v=(0.01, 0.02, 0.0, 0.03), parameters=TURBINE):
    inputs = np.zeros(17)
    inputs[:4] = np.asarray(q) * lever(parameters)
    inputs[4:8] = np.asarray(v) * lever(parameters) * SPEED
    inputs[16] = SPEED
    return inputs


def test_layout_is_the_ports():
    names = [variable.name for variable in port.BEARING_OUTPUTS]
    assert [variable.name for variable in port.BEARING_INPUTS][16] == "speed"
    assert names[:8] == [*port.FORCE, *port.F0]
    assert names[40:44] == ["h_min", "h_min_centre", "h_min_z", "p_max"]
    assert names[44:52] == [
        "contact_force",
        "contact.Fx",
        "contact.Fy",
        "contact.Mx",
        "contact.My",
        "friction_power",
        "eccentricity",
        "sommerfeld",
    ]
    assert names[52:] == [
        "contact_pressure",
        "overlap",
        "wiped",
        "contact_area",
        "oil_flow",
        "oil_temperature",
    ]


@fault(
    "film",
    "an input of a bearing is not a finite number",
    "status NOT_FINITE at every depth, outputs untouched",
    guard="bearing_fmu.outputs:relative_state",
)
@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_not_finite(depth, bad):
    film = make_film(depth, TURBINE)
    for index in range(17):
        inputs, out = port_inputs(), np.full(58, 7.0)
        inputs[index] = bad
        assert film.solve(inputs, np.zeros(4), out) == FilmStatus.NOT_FINITE
        assert np.all(out == 7.0)
    offset = np.array([0.0, bad, 0.0, 0.0])
    assert film.solve(port_inputs(), offset, out) == FilmStatus.NOT_FINITE


@fault(
    "film",
    "the journal overlaps the bore beyond every physical state",
    "status TOO_DEEP at every depth, outputs untouched",
    guard="bearing_fmu.parameters:BearingParameters.deepest_gap",
)
@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("q", [(0.0, -1.3, 0.0, 0.0), (30.0, 0.0, 0.0, 0.0), (1e300, 0.0, 0.0, 0.0)])
def test_too_deep(depth, q):
    film, out = make_film(depth, TURBINE), np.full(58, 7.0)
    assert film.solve(port_inputs(q), np.zeros(4), out) == FilmStatus.TOO_DEEP
    assert np.all(out == 7.0)


def test_too_deep_at_one_edge():
    out = np.full(58, 7.0)
    q = (0.0, -0.5, 0.8, 0.0)
    assert make_film("v1", TURBINE).solve(port_inputs(q), np.zeros(4), out) == FilmStatus.TOO_DEEP
    assert make_film("v2", TURBINE).solve(port_inputs(q), np.zeros(4), out) == FilmStatus.OK


@fault(
    "film",
    "the journal touches a bore without contact model",
    "status GAP_CLOSED at every depth; the state, and to take a smaller step",
    guard="bearing_fmu.parameters:BearingParameters.deepest_gap",
)
@pytest.mark.parametrize("depth", DEPTHS)
def test_closed_gap_without_contact(depth):
    film = make_film(depth, plain(0.8))
    with pytest.raises(FilmFailure, match=r"GAP_CLOSED: .*smaller step") as failure:
        respond(film, [0.6, 0.8001, 0.0, 0.0])
    assert failure.value.status is FilmStatus.GAP_CLOSED
    assert failure.value.state.shape == (9,)


@fault(
    "film",
    "a film whose forces overflow",
    "status NO_SOLUTION at every depth, outputs untouched",
    guard="bearing_fmu.outputs:write_outputs",
)
@pytest.mark.parametrize("depth", DEPTHS)
def test_overflow_is_no_solution(depth):
    film, out = make_film(depth, TURBINE), np.full(58, 7.0)
    inputs = port_inputs()
    inputs[16] = 1e306
    assert film.solve(inputs, np.zeros(4), out) == FilmStatus.NO_SOLUTION
    assert np.all(out == 7.0)


def test_every_failure_has_advice():
    assert all(status.advice for status in FilmStatus)


@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("q", [(0.0, 0.0, 0.0, 0.0), (0.0, -1.1, 0.05, 0.0), (0.0, -1.19, 0.0, 0.0)])
def test_extreme_states_are_finite(depth, q):
    film, out = make_film(depth, TURBINE), np.empty(58)
    for speed in (0.0, SPEED, -SPEED, 1e-9):
        inputs = port_inputs(q)
        inputs[16] = speed
        if film.solve(inputs, np.zeros(4), out) == FilmStatus.OK:
            assert np.all(np.isfinite(out))
        else:
            assert q[1] == -1.19


@pytest.mark.parametrize("depth", DEPTHS)
def test_same_input_same_bits(depth):
    """Whatever was evaluated before, in this instance or another."""
    first, second = make_film(depth, TURBINE), make_film(depth, TURBINE)
    inputs, offset = port_inputs(), np.zeros(4)
    expected, out = np.empty(58), np.empty(58)
    assert first.solve(inputs, offset, expected) == 0
    rng = np.random.default_rng(5)
    for _ in range(20):
        q = rng.uniform(-0.8, 0.8, 4) * [1, 1, 0.4, 0.4]
        first.solve(port_inputs(q, rng.normal(size=4)), offset, out)
        first.solve(port_inputs((0, 5, 0, 0)), offset, out)
        assert first.solve(inputs, offset, out) == 0
        assert out.tobytes() == expected.tobytes()
    assert second.solve(inputs, offset, out) == 0
    assert out.tobytes() == expected.tobytes()


def test_films_of_one_resolution_share_their_work_space_and_not_their_results():
    """Another bearing, another boundary condition, a refusal and pinned columns in between change no bit."""
    film = make_film("v1", TURBINE)
    others = [make_film("v1", replace(TURBINE, **change)) for change in ({"width": 0.3}, {"clearance": 9e-4})]
    others.append(make_film("v1", replace(TURBINE, boundary="reynolds")))
    inputs, offset = port_inputs(), np.zeros(4)
    expected, out = np.empty(58), np.empty(58)
    assert film.solve(inputs, offset, expected) == 0
    space, _ = film.take()
    film.bring_back(space)
    for other in others:
        taken, (_, _, _, work, _) = other.take()
        assert taken is space
        work.usual.held[:, 3] = 2.0
        other.bring_back(taken)
        for q in ((0.1, -0.7, 0.1, 0.05), (0, 5, 0, 0), (np.nan, 0, 0, 0)):
            other.solve(port_inputs(q), offset, out)
        assert film.solve(inputs, offset, out) == 0
        assert out.tobytes() == expected.tobytes()


def test_no_two_evaluations_use_one_work_space():
    one, other = make_film("v1", TURBINE), make_film("v1", TURBINE)
    first, (_, _, _, mine, _) = one.take()
    second, (_, _, _, theirs, _) = other.take()
    assert not np.shares_memory(mine.usual.blocks, theirs.usual.blocks)
    assert not np.shares_memory(mine.usual.pressures, theirs.usual.pressures)
    one.bring_back(first)
    other.bring_back(second)


@pytest.mark.parametrize("depth", DEPTHS)
def test_a_film_is_prepared_once_for_threads_that_come_and_go(depth):
    """As those of a tool written in C are to Python, at every call."""
    film, inputs, outputs = make_film(depth, TURBINE), port_inputs(), np.empty((20, 58))
    for out in outputs:
        thread = Thread(target=film.solve, args=(inputs, np.zeros(4), out))
        thread.start()
        thread.join()
    assert len(film._bound) == 1
    assert np.all(outputs == outputs[0])


def test_same_bits_with_reynolds_condition():
    film = make_film("v1", plain(0.5, boundary="reynolds"))
    expected = respond(film, [0.5, 0.2, 0.1, 0.0]).wrench
    respond(film, [-0.7, 0.2, 0.0, 0.2])
    np.testing.assert_array_equal(respond(film, [0.5, 0.2, 0.1, 0.0]).wrench, expected)


@pytest.mark.parametrize("depth", DEPTHS)
def test_no_allocation(depth):
    film, inputs = make_film(depth, TURBINE), port_inputs((0.2, -0.9, 0.09, 0.02))
    offset, out = np.zeros(4), np.empty(58)
    film.solve(inputs, offset, out)
    nrt.memsys_enable_stats()
    before = rtsys.get_allocation_stats().alloc
    for _ in range(50):
        film.solve(inputs, offset, out)
    allocated = rtsys.get_allocation_stats().alloc - before
    nrt.memsys_disable_stats()
    assert allocated == 0  # not even the headers in which numba wraps arrays: kernels count no references


@pytest.mark.parametrize("depth", DEPTHS)
def test_standstill_without_motion_is_forceless(depth):
    response = make_film(depth, TURBINE).respond([1e-4, -3e-4, 0, 0], np.zeros(4), 0.0)
    np.testing.assert_allclose(response.wrench, 0.0, atol=1e-6)
    assert response.friction_power == 0.0
    assert response.sommerfeld == 0.0


@fault(
    "film",
    "parameters of a bearing out of range",
    "ValueError with key, value and the range",
    guard="bearing_fmu.parameters:BearingParameters.__post_init__",
)
@pytest.mark.parametrize(
    "key, value, allowed",
    [
        ("clearance", -1e-3, "> 0"),
        ("diameter", 0.0, "> 0"),
        ("width", float("nan"), "> 0"),
        ("viscosity", float("inf"), "> 0"),
        ("ambient_pressure", -1.0, ">= 0"),
        ("roughness", 1e-3, "clearance / 10"),
        ("friction", -0.1, ">= 0"),
        ("columns", 8, "from 16"),
        ("rows", 2, "from 3"),
        ("rows", 8.5, "integer"),
        ("boundary", "half", "'guembel' or 'reynolds'"),
    ],
)
def test_bad_parameters_are_named(key, value, allowed):
    values = {"diameter": 0.8, "width": 0.6, "clearance": 1e-3, "viscosity": 0.02} | {key: value}
    with pytest.raises(ValueError, match=f"bearing parameter {key} = .*{allowed}"):
        BearingParameters(**values)


def test_kernels_are_renewed_by_any_module_of_the_package():
    from bearing_fmu.films.tilted.depth import SOLVER
    from bearing_fmu.kernels import compiled

    assert SOLVER.kernel._cache._cache_file._source_stamp == compiled._digest()
