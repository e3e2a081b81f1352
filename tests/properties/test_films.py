"""Films in any bearing and state: consistent, symmetric, dissipative, similar, or a named status."""

import math

import numpy as np
from hypothesis import assume, event, example, given
from hypothesis import strategies as st

from bearing_fmu.film import FilmStatus
from bearing_fmu.films.tilted.corner_films import CORNERS, SPREAD_OUT
from tests.bearing_fmu.bearings import force_unit, lever, plain, respond
from tests.bearing_fmu.films.test_film_energy import reynolds_losses, short_losses
from tests.properties.examples import examples
from tests.properties.journals import DEPTHS, bearings, film, positions, rates, speeds, turned

CORNER_COLUMNS = CORNERS[SPREAD_OUT][0]
ANY = st.floats(allow_nan=True, allow_infinity=True)


@given(DEPTHS, bearings(), st.lists(st.one_of(ANY, st.floats(-3.0, 3.0)), min_size=21, max_size=21))
@examples(250)
def test_any_input_gives_finite_outputs_or_a_named_status(depth, parameters, numbers):
    """Whatever arrives at the port: beyond the clearance, enormous, not a number."""
    units = np.tile(lever(parameters), 5)
    with np.errstate(over="ignore", invalid="ignore"):
        numbers = np.array(numbers) * np.append(units, 100.0)
    inputs, offset, out = np.append(numbers[:16], numbers[20]), numbers[16:20], np.full(58, 7.0)
    status = FilmStatus(film(depth, parameters).solve(inputs, offset, out))
    event(f"{depth} {status.name}")
    finite = bool(np.all(np.isfinite(numbers)))
    assert finite == (status is not FilmStatus.NOT_FINITE)
    assert status.advice
    if status is FilmStatus.OK:
        assert np.all(np.isfinite(out))
        assert out[40] > parameters.deepest_gap
    else:
        assert np.all(out == 7.0)
    if status in (FilmStatus.GAP_CLOSED, FilmStatus.TOO_DEEP):
        assert (status is FilmStatus.TOO_DEEP) == parameters.has_contact


@given(DEPTHS, bearings(), positions(deepest=1.3), rates(largest=2.0), speeds())
@examples(200)
def test_outputs_belong_together(depth, parameters, q, v, speed):
    """Within the clearance and beyond: the status is that of the gap, and the law gives the wrench."""
    units = lever(parameters)
    bearing = film(depth, parameters)
    q, v = q * units, v * units * abs(speed)
    inputs, out = np.concatenate((q, v, np.zeros(8), [speed])), np.full(58, 7.0)
    status = FilmStatus(bearing.solve(inputs, np.zeros(4), out))
    ends = (-0.5, 0.0, 0.5) if depth == "v1" else (0.0,)
    at = np.array(ends) * parameters.width
    gaps = parameters.clearance - np.hypot(q[0] + q[3] * at, q[1] - q[2] * at)
    event(f"{depth} {status.name}")
    if status is not FilmStatus.OK:
        closes = FilmStatus.TOO_DEEP if parameters.has_contact else FilmStatus.GAP_CLOSED
        assert status is closes and gaps.min() <= parameters.deepest_gap + 1e-12 * parameters.clearance
        return
    wrench, law, K, C = out[:4], out[4:8], out[8:24].reshape(4, 4), out[24:40].reshape(4, 4)
    parts = np.array([law, -K @ q, -C @ v])
    np.testing.assert_allclose(parts.sum(axis=0), wrench, atol=1e-13 * np.abs(parts).max())
    least, centre, where, peak, contact = out[40:45]
    np.testing.assert_allclose([least, centre], [gaps.min(), gaps[at.size // 2]], atol=1e-12)
    assert abs(where) <= 0.5 * parameters.width and peak >= 0.0 and contact >= 0.0
    assert np.hypot(*out[45:47]) <= contact * math.hypot(1.0, parameters.friction) * (1.0 + 1e-9)
    if not parameters.has_contact or least > 7.0 * parameters.roughness:
        assert contact == 0.0 and np.all(out[45:49] == 0.0)
    so = np.hypot(*wrench[:2]) * (2.0 * parameters.clearance / parameters.diameter) ** 2
    so /= parameters.width * parameters.diameter * parameters.viscosity * abs(speed)
    np.testing.assert_allclose(out[51], so, rtol=1e-9)


@given(DEPTHS, bearings(), positions(deepest=1.02), rates(), speeds(), st.integers(1, 60))
@examples(100)
def test_turning_state_and_load_turns_the_wrench(depth, parameters, q, v, speed, cells):
    """By whole cells of the grid, and of that of the corners of accuracy, to rounding."""
    bearing = film(depth, parameters)
    inside = 1.0 - max(np.hypot(q[0] + s * q[3], q[1] - s * q[2]) for s in (-1.0, 1.0))
    assume(inside * parameters.clearance > parameters.deepest_gap + 1e-4 * parameters.clearance)
    grid = max(2 * parameters.columns, 48) if depth == "v3" else parameters.columns
    angle = 2.0 * math.pi / math.gcd(grid, max(grid, CORNER_COLUMNS)) * cells
    one, other = respond(bearing, q, v, speed), respond(bearing, turned(q, angle), turned(v, angle), speed)
    arms = np.array([1.0, 1.0, 0.5 * parameters.width, 0.5 * parameters.width])
    size = np.linalg.norm(one.wrench / arms)
    size += parameters.ambient_pressure * parameters.diameter * parameters.width
    np.testing.assert_allclose(other.wrench / arms, turned(one.wrench, angle) / arms, atol=1e-8 * size)
    np.testing.assert_allclose(other.friction_power, one.friction_power, rtol=1e-8)


@given(DEPTHS, bearings(contact=False, ambient=0.0), positions(deepest=0.9), rates(largest=1.0), speeds())
@examples(200)
def test_a_film_takes_more_power_than_its_shear_loses(depth, parameters, q, v, speed):
    """What drive and lateral motion put in beyond the shear is lost in pressure flow, so it is positive."""
    response = respond(film(depth, parameters), q, v, speed)
    lateral = -response.wrench @ (v * lever(parameters) * abs(speed))
    z, weight = np.polynomial.legendre.leggauss(40)
    tilt = q[2:] if depth == "v1" else np.zeros(2)
    eccentricity = np.hypot(q[0] + tilt[1] * z, q[1] - tilt[0] * z)
    shear = parameters.viscosity * (speed * parameters.radius) ** 2 / parameters.clearance * parameters.radius
    shear *= 2.0 * math.pi * 0.5 * parameters.width * np.sum(weight / np.sqrt(1.0 - eccentricity**2))
    into_flow = response.friction_power + lateral - shear
    # the coarsest grid is off by some parts in a thousand
    assert into_flow > -0.01 * (shear + abs(lateral))


@given(bearings(contact=False, ambient=0.0), positions(deepest=0.8), rates(), speeds())
@examples(12)
def test_power_balance_of_a_tilted_film(parameters, q, v, speed):
    """Against the losses in a solution by finite volumes."""
    units = lever(parameters)
    position, rate = q * units, v * units * abs(speed)
    response = film("v1", parameters).respond(position, rate, speed)
    lost = sum(reynolds_losses(parameters, position, rate, speed, columns=192, rows=32))
    put_in = response.friction_power - response.wrench @ rate
    # 17 columns and 3 rows are coarse; a hundredth is the error of the worst of them
    assert abs(put_in - lost) < 1.5e-2 * lost


@given(bearings(contact=False, ambient=0.0), positions(deepest=0.95), rates(largest=1.0), speeds())
def test_power_balance_of_the_short_bearing(parameters, q, v, speed):
    units = lever(parameters)
    position, rate = q * units, v * units * abs(speed)
    response = film("v3", parameters).respond(position, rate, speed)
    lost = sum(short_losses(parameters, position, rate, speed))
    assert abs(response.friction_power - response.wrench @ rate - lost) < 1e-4 * lost


@given(DEPTHS, bearings(contact=False), positions(deepest=0.9), rates(), speeds())
@examples(100)
def test_the_tangent_is_the_derivative_of_the_wrench(depth, parameters, q, v, speed):
    """Against central differences, along a direction of each kind."""
    bearing = film(depth, parameters)
    response = respond(bearing, q, v, speed)
    assume(np.any(response.wrench))  # an empty film is at a corner, see test_empty_film
    units = lever(parameters)
    rng = np.random.default_rng(7)
    forces = units[0] / units
    for matrix, moves in ((response.stiffness, True), (response.damping, False)):
        way = rng.normal(size=4)
        step = 1e-6 * way
        dq, dv = (step, 0.0 * step) if moves else (0.0 * step, step)
        ahead, behind = respond(bearing, q + dq, v + dv, speed), respond(bearing, q - dq, v - dv, speed)
        scale = units if moves else units * abs(speed)
        exact = -(matrix @ (way * scale)) * forces
        found = (ahead.wrench - behind.wrench) * forces / 2e-6
        size = np.abs(matrix * np.outer(forces, scale)).max()
        np.testing.assert_allclose(found / size, exact / size, atol=2e-5)


@given(bearings(), positions(deepest=0.99, tilted=False), rates(tilted=False), speeds())
def test_v1_without_tilt_is_v2(parameters, q, v, speed):
    one, other = (respond(film(depth, parameters), q, v, speed) for depth in ("v1", "v2"))
    size = np.abs(one.wrench[:2]).max()
    np.testing.assert_allclose(other.wrench[:2], one.wrench[:2], atol=1e-8 * size)
    for matrix, same in ((one.stiffness, other.stiffness), (one.damping, other.damping)):
        np.testing.assert_allclose(same[:2, :2], matrix[:2, :2], atol=1e-6 * np.abs(matrix[:2, :2]).max())
    np.testing.assert_allclose(other.friction_power, one.friction_power, rtol=1e-8)
    assert other.h_min == one.h_min


@given(positions(deepest=0.8, tilted=False), rates(largest=0.3, tilted=False), speeds())
@examples(25)
@example(np.array([0.6, 0.0, 0.0, 0.0]), np.zeros(4), 100.0)
def test_v1_tends_to_v3_as_the_bearing_gets_narrow(q, v, speed):
    """The difference falls with (b/d)^2."""
    assume(np.hypot(q[1] + 2 * v[0] * np.sign(speed), q[0] - 2 * v[1] * np.sign(speed)) > 0.05)
    differences = []
    for aspect in (0.08, 0.04):
        parameters = plain(aspect, columns=128, rows=10)
        full, short = (respond(film(depth, parameters), q, v, speed).wrench[:2] for depth in ("v1", "v3"))
        differences.append(np.linalg.norm(full - short) / np.linalg.norm(short))
    assert differences[0] < 0.05
    assert differences[1] < 0.35 * differences[0] + 2e-4


@given(
    DEPTHS,
    bearings(contact=False, ambient=0.0),
    positions(deepest=0.95),
    rates(),
    speeds(),
    st.tuples(*[st.floats(0.2, 5.0)] * 4),
)
@examples(100)
def test_similar_bearings_have_similar_wrenches(depth, parameters, q, v, speed, factors):
    """Over eta omega R (b/2) (R/C)^2 the wrench knows b/d, q/C and v/(C omega) only (Sommerfeld)."""
    size, play, oil, pace = factors
    other = type(parameters)(
        diameter=parameters.diameter * size,
        width=parameters.width * size,
        clearance=parameters.clearance * play,
        viscosity=parameters.viscosity * oil,
        columns=parameters.columns,
        rows=parameters.rows,
    )
    units = [force_unit(p, abs(w)) for p, w in ((parameters, speed), (other, speed * pace))]
    one = respond(film(depth, parameters), q, v, speed).wrench / units[0]
    same = respond(film(depth, other), q, v, speed * pace).wrench / units[1]
    np.testing.assert_allclose(same, one, atol=1e-9 * np.abs(one).max())
