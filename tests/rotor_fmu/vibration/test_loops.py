"""Compiled loops of the rotor, and as they stand, against the same by numpy."""

from types import SimpleNamespace

import numpy as np
import pytest

from rotor_fmu.train.file import load_train
from rotor_fmu.vibration import field_loops, law_loops, whirl_loops
from rotor_fmu.vibration.affine_step import AffineStep, NoFiniteResult, journal_motion
from rotor_fmu.vibration.rotor import Rotor
from rotor_fmu.vibration.state import RotorState

N = 3
LOADS = 4 * N


@pytest.fixture(params=["compiled", "as it stands"])
def loop(request):
    """A loop of a module by name, in one of the two ways."""

    def find(module, name):
        function = getattr(module, name)
        return function if request.param == "compiled" else function.py_func

    return find


@pytest.fixture
def rng():
    return np.random.default_rng(5)


def complex_numbers(rng, *shape):
    return rng.normal(size=shape) + 1j * rng.normal(size=shape)


@pytest.mark.parametrize("share", [0.0, 0.3])
def test_wrenches_at_the_end_are_those_of_the_law_under_themselves(rng, loop, share):
    law, offset, journals = rng.normal(size=(N, 4, 8)), rng.normal(size=LOADS), rng.normal(size=(N, 8))
    of_start, of_end = 0.1 * rng.normal(size=(2, N, 8, LOADS))
    nearer, wrench, moves = share * rng.random(LOADS), np.empty(LOADS), np.empty_like(of_end)
    loop(law_loops, "mix")(of_start, of_end, nearer, moves)
    np.testing.assert_allclose(moves, of_end + nearer * (of_start - of_end), rtol=1e-12)
    memory, moved = np.full((LOADS, LOADS), np.nan), journals.copy()
    pivots = np.zeros(LOADS, dtype=np.intp)
    assert loop(law_loops, "factorise")(law, moves, memory, pivots)
    assert (pivots != np.arange(LOADS)).any(), "rows are exchanged"
    loop(law_loops, "end_wrenches")(law, offset, moves, memory, pivots, moved, wrench)
    np.testing.assert_allclose(moved, journals + moves @ wrench, rtol=1e-12, atol=1e-14)
    again = np.empty(LOADS)
    loop(law_loops, "react")(law, offset, moved, again)
    np.testing.assert_allclose(again, offset - np.einsum("bij,bj->bi", law, moved).ravel(), rtol=1e-12)
    np.testing.assert_allclose(wrench, again, rtol=0, atol=1e-11 * np.abs(wrench).max())


def test_a_law_without_a_solution(rng, loop):
    """1 + L S = 0 in the last component, where pivots are first exchanged."""
    law, of_end = np.zeros((1, 4, 8)), np.zeros((1, 8, 4))
    law[0, :, :4] = np.array([[-1.0, 1.0, 0, 0], [1.0, 3.0, 0, 0], [0, 0, 0, 0], [0, 0, 0, -1.0]])
    of_end[0, :4] = np.eye(4)
    assert not loop(law_loops, "factorise")(law, of_end, np.empty((4, 4)), np.zeros(4, dtype=np.intp))


def test_stiffness_numbers(rng, loop):
    """Two springs on one mass: k S of each alone, and twice that since both stiffen the other."""
    memory, sizes = np.full((8, 8), np.nan), np.zeros((3, 2))
    law, own, mixed = np.zeros((2, 4, 8)), np.zeros((2, 4, 4)), np.zeros((8, 8))
    law[:, 0, 0] = 6.0, 24.0
    own[:, 0, 0] = mixed[0, 0] = mixed[4, 4] = mixed[0, 4] = mixed[4, 0] = 0.5
    find = loop(law_loops, "stiffness_numbers")
    assert find(law, own, mixed, memory, sizes)
    np.testing.assert_allclose(sizes[-1], [6.0, 24.0])
    assert not find(1e-2 * law, own, mixed, memory, sizes)
    shares = np.full(8, np.nan)

    def half(law, own, mixed, shares):
        return loop(law_loops, "half_shares")(law, own, mixed, memory, sizes, shares)

    assert half(law, own, mixed, shares)
    np.testing.assert_allclose(shares, np.repeat(0.5 - 0.5 / np.array([6.0, 24.0]), 4))
    assert half(0.1 * law, own, mixed, shares)  # 0.6 and 2.4
    np.testing.assert_allclose(shares, np.repeat([0.0, 0.5 - 0.5 / 2.4], 4))
    law[1] *= 0.1
    assert not half(0.15 * law, own, mixed, shares)  # 0.9 and 0.36
    assert not half(1e-2 * law, own, mixed, shares)


@pytest.mark.parametrize("slow", [0, 2, 5])
def test_a_whirl_coasts_and_is_pushed(rng, loop, slow):
    size, pairs = 5, 4
    block, growth = complex_numbers(rng, slow, slow), complex_numbers(rng, size - slow)
    matrix, before = complex_numbers(rng, size, pairs + 2), complex_numbers(rng, size)
    wrench, rotation, after = complex_numbers(rng, pairs), rng.normal(size=2), np.empty(2 * size)
    maps = (
        whirl_loops.parts(block),
        growth.view(float),
        whirl_loops.parts(matrix),
        wrench.view(float),
    )
    assert all(part.flags.c_contiguous for part in maps)
    total = np.full((2, size), np.nan)
    loop(whirl_loops, "coast")(*maps, rotation, before.view(float), total, after)
    expected = matrix @ np.concatenate([wrench, rotation])
    expected[:slow] += block @ before[:slow]
    expected[slow:] += growth * before[slow:]
    np.testing.assert_allclose(after.view(complex), expected, rtol=1e-12)
    loop(whirl_loops, "add_product")(maps[2], wrench.view(float), total, after)
    np.testing.assert_allclose(after.view(complex), expected + matrix[:, :pairs] @ wrench, rtol=1e-12)


def test_fields_and_where_they_are_largest(rng, loop):
    nodes = 7
    (of_x, of_y), (in_x, in_y) = rng.normal(size=(2, 3 * nodes, 4)), rng.normal(size=(2, 4))
    static, moments = rng.normal(size=(2, nodes)), rng.normal(size=(2, 2 * nodes))
    flexibility, fields = rng.random(2 * nodes), np.full((4, nodes), np.nan)
    found = loop(field_loops, "fields_at")(of_x, of_y, in_x, in_y, static, moments, flexibility, fields)
    moved = np.array([of_x @ in_x, of_y @ in_y])
    stress = np.hypot(*(moved[:, nodes:] + moments)) * flexibility
    expected = [
        *(static + moved[:, :nodes]), np.hypot(*moved[:, :nodes]), stress.reshape(2, -1).max(axis=0)
    ]  # fmt: skip
    np.testing.assert_allclose(fields, expected, rtol=1e-12)
    assert found == (np.argmax(expected[2]), np.argmax(expected[3]))
    moments[0, nodes + 3] = np.nan
    found = loop(field_loops, "fields_at")(of_x, of_y, in_x, in_y, static, moments, flexibility, fields)
    assert found[1] == 3, "a stress that is not a number is not passed over"


def test_no_step_waits_for_the_compiler():
    """A rotor's loops are there when it is: steps and records of any kind compile nothing."""
    loops = [
        getattr(module, name)
        for module, names in (
            (law_loops, ("react", "begin", "half_shares", "mix", "factorise", "end_wrenches")),
            (whirl_loops, ("coast", "add_product", "step")),
            (field_loops, ("fields_at",)),
        )
        for name in names
    ]
    rotor = Rotor.of_train(load_train("small"), fracture_time=1.5e-4, blade_unbalance=[0.1, 0.0, 0.0])
    before = [len(loop.signatures) for loop in loops]
    law = np.zeros((2, 4)), np.tile(1e8 * np.eye(4), (2, 1, 1)), np.tile(1e5 * np.eye(4), (2, 1, 1))
    rotor.start_from_law(*law, orbit=True)
    strided = [np.repeat(part[..., None], 2, axis=-1)[..., 0] for part in law]  # as views of an FMU's inputs
    for k in range(3):
        rotor.step(k * 1e-4, 1e-4, *strided, rotor.speed)
        rotor.fields()
    rotor.set_state(RotorState.from_bytes(rotor.get_state().to_bytes()))
    rotor.step(3e-4, 1e-4, *strided, rotor.speed)
    assert rotor.go(4e-4, 1e-4, *strided, rotor.speed, 3)
    assert [len(loop.signatures) for loop in loops] == before


@pytest.mark.parametrize("stiffness", [1e7, 1e13])
@pytest.mark.parametrize("kicked", [False, True])
def test_a_whirl_steps_in_one_go_as_in_parts(rng, stiffness, kicked):
    rotor = Rotor.of_train(load_train("small"))
    laws = (
        rng.normal(size=(2, 4)),
        stiffness * np.tile(np.eye(4), (2, 1, 1)),
        np.tile(1e3 * np.eye(4), (2, 1, 1)),
    )
    rotor.start_from_law(*laws, orbit=True)
    state, H, speed = rotor.get_state(), 1e-4, rotor.speed
    coordinates, maps = rotor._maps.coordinates(speed), rotor._maps.step(speed, H)
    parts = SimpleNamespace(**{
        name: getattr(maps, name) for name in ("coast", "add_start", "add_end", "compliance")
    })  # fmt: skip
    kick = 1e-6 * rng.normal(size=state.motion.shape) if kicked else None
    stepper, found = AffineStep(2), []
    stepper.set_law(*laws[1:])
    for way in (maps, parts):
        about = state.motion, state.journals, laws[0], np.ones(4), kick, state.static
        found.append(stepper.advance(coordinates, way, *about))
    (end, journals, nearer, _), (end_in_parts, journals_in_parts, nearer_in_parts, _) = found
    np.testing.assert_allclose(end, end_in_parts, rtol=0, atol=1e-11 * np.abs(end).max())
    np.testing.assert_allclose(journals, journals_in_parts, rtol=0, atol=1e-11 * np.abs(journals).max())
    np.testing.assert_allclose(
        journals, journal_motion(coordinates, end, state.static), rtol=0, atol=1e-11 * np.abs(journals).max()
    )
    assert (nearer is None) == (stiffness < 1e10)
    if nearer is not None:
        np.testing.assert_allclose(nearer, nearer_in_parts, rtol=1e-12)


@pytest.mark.parametrize("stiffness", [1e7, 1e13])
def test_parts_of_a_step_in_one_go_are_steps(rng, stiffness):
    """1 + L S is solved for once then."""
    one, other = (Rotor.of_train(load_train("small")) for _ in range(2))
    law = (
        1e3 * rng.normal(size=(2, 4)),
        stiffness * (np.eye(4) + 0.3 * rng.normal(size=(2, 4, 4))),
        np.tile(1e3 * np.eye(4), (2, 1, 1)),
    )
    step = 1.5e-4
    for rotor in (one, other):
        rotor.start_from_law(*law, orbit=True)
        rotor.step(0.0, step, *law, rotor.speed)  # from the coordinates of the start into those of the speed
    law[0][:] += 1e3
    for k in (1, 2, 3):
        assert one.go(k * step, step, *law, one.speed, 3)
        for part in range(3):
            other.step(k * step + part * step / 3, step / 3, *law, other.speed)
        state, expected = one.get_state(), other.get_state()
        for name in ("motion", "journals"):
            found, alike = getattr(state, name), getattr(expected, name)
            np.testing.assert_allclose(found, alike, rtol=0, atol=1e-11 * np.abs(alike).max())
        assert (state.angle, state.time) == pytest.approx((expected.angle, expected.time), rel=1e-12)
        assert one.holds_mean == other.holds_mean == (stiffness > 1e10)


def test_what_is_not_done_in_one_go():
    """A blade that breaks within the step, a speed that changes, an account of works."""
    law = np.zeros((2, 4)), np.tile(1e8 * np.eye(4), (2, 1, 1)), np.tile(1e5 * np.eye(4), (2, 1, 1))
    rotor, accounts = (
        Rotor.of_train(load_train("small"), fracture_time=3e-4, blade_unbalance=[0.1, 0, 0], track_work=on)
        for on in (False, True)
    )
    for each in (rotor, accounts):
        each.start_from_law(*law, orbit=True)
        each.step(0.0, 1e-4, *law, each.speed)
    assert not accounts.go(1e-4, 1e-4, *law, rotor.speed)
    before = rotor.get_state()
    assert not rotor.go(2.5e-4, 1e-4, *law, rotor.speed)
    assert not rotor.go(1e-4, 1e-4, *law, 1.01 * rotor.speed)
    assert rotor.get_state() is before
    assert rotor.go(1e-4, 1e-4, *law, rotor.speed)
    assert rotor.get_state() is not before
    with pytest.raises(NoFiniteResult):
        rotor.go(2e-4, 5e-5, law[0], np.nan * law[1], law[2], rotor.speed)
    assert rotor.get_state().time == 2e-4
