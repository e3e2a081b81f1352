"""The arithmetic of many rates, compiled and as it stands."""

import numpy as np
import pytest

from orchestrator.master.coupling import rates as known
from orchestrator.master.coupling.rates import BEFORE, BEND, CALM, INTERVAL, KNOWN, LINEAR, SIZE, SPAN, STANDS

SCALARS = ("bend_on", "due_at", "relative", "intervals_after")


@pytest.fixture(params=["compiled", "as it stands"])
def way(request, monkeypatch):
    """The loops compiled, and as the Python they are written in."""
    if request.param == "as it stands":
        for name in SCALARS:
            monkeypatch.setattr(known, name, getattr(known, name).py_func)
    return request.param


both_ways = pytest.mark.usefixtures("way")


def rates(**given):
    """Three bearings that stand at 0 and are due after 4."""
    table = np.zeros((3, known.WIDTH))
    table[:, INTERVAL], table[:, SIZE] = 4.0, 1.0
    for name, values in given.items():
        table[:, KNOWN.index(name)] = values
    return table


def due(end, moved, tolerance, bend, force=1.0, loads=1.0):
    """Who is due at `end`, where a step in x of these lengths has moved these forces by as much."""
    tangents, motion = np.zeros((3, 32)), np.zeros((3, 8))
    tangents[:, 0], motion[:, 0] = -1.0, moved
    found, said = np.zeros(3), np.zeros(3, dtype=bool)
    wrenches = np.outer(force * np.ones(3), [0.6, 0.8, 0.0, 0.0])
    about = wrenches, tangents, np.zeros((3, 8)), motion
    given = rates(bend=bend), *about, loads * np.ones(3), np.ones(3), np.zeros(3, dtype=bool)
    known.due_at(end, tolerance, False, *given, found, said)
    np.testing.assert_allclose(found, moved)
    return said


def after(table, end, who, moved, sizes, tolerance):
    """What is known behind such defects."""
    out = np.full_like(table, np.nan)
    known.intervals_after(end, tolerance, table, np.ones((3, 32)), who, moved, sizes, np.ones(3), out)
    assert np.isfinite(out).all()
    return out


@both_ways
def test_a_bearing_is_due_at_the_end_of_its_interval_or_when_its_defect_must_have_grown():
    moved, bend = np.array([0.1, 0.1, 0.2]), np.array([0.0, 1.0, 1.0])  # the last one: 0.04 is to be expected
    assert due(3.0, moved, 0.02, bend).tolist() == [False, False, True]
    assert due(4.0, moved, 0.02, bend).all()
    little = np.array([0.0, 2.0 * LINEAR, 2.0 * LINEAR])  # what bends a little may bend more
    assert due(3.0, np.array([9.0, 0.1, 0.3]), 0.02, little).tolist() == [False, False, True]


@both_ways
def test_a_film_that_bears_nothing_is_always_due_for_its_tangent_tells_nothing():
    force = known.SLACK * np.array([0.99, 1.01, 0.0])
    still, moved = np.zeros(3), np.full(3, 1.01 * known.SLACK)
    assert due(0.1, still, 1.0, still, force).tolist() == [True, False, True]
    assert not due(0.1, moved, 1.0, still, force).any()  # its tangent does tell
    assert not due(0.1, still, 1.0, still, force, loads=1.0 / known.LIGHT).any()  # it never bore more


@both_ways
def test_what_a_bearing_is_expected_to_bend_fades():
    then = after(rates(bend=8.0), 4.0, np.array([True, True, False]), np.ones(3), np.ones(3), 0.01)
    assert then[:, BEND].tolist() == [4.0, 4.0, 8.0]


@both_ways
def test_intervals_double_where_calm_halve_where_rough_and_wait_for_those_not_evaluated():
    who = np.array([True, True, False])
    sizes = np.array([0.9 * CALM * 0.01, 0.011, 0.0])
    then = after(rates(), 4.0, who, np.full(3, 0.1), sizes, 0.01)
    assert then[:, INTERVAL].tolist() == [8.0, 2.0, 4.0]
    assert then[:, STANDS].tolist() == [4.0, 4.0, 0.0]
    assert then[:, SPAN].tolist() == [4.0, 4.0, 0.0]
    assert then[:, BEFORE:].tolist() == [[1.0] * 32] * 2 + [[0.0] * 32]
    np.testing.assert_allclose(then[:, BEND], [sizes[0] / 0.01, sizes[1] / 0.01, 0.0])
    early = after(rates(), 1.0, who, np.full(3, 0.1), sizes, 0.01)  # a common instant: calm, but not for long
    assert early[:, INTERVAL].tolist() == [4.0, 0.5, 4.0]


@both_ways
def test_a_step_answers_for_bearings_that_stand_at_its_start_and_once_for_others():
    defect, again = np.diag([3.0, 5.0, 4.0])[:, [0, 1, 2, 2]], np.zeros(3, dtype=bool)
    defect[:, 3] = 0.0
    levers, size, table = np.array([1.0, 1.0, 0.5]), np.full(3, 10.0), rates(stands=[1.0, 0.5, 0.5])

    def found(tolerance):
        sizes, rough = np.zeros(3), np.zeros(3, dtype=bool)
        told = known.relative(1.0, tolerance, defect, levers, size, table, again, sizes, rough)
        np.testing.assert_allclose(sizes, [0.3, 0.5, 0.8])  # a moment counts by its lever
        assert rough.tolist() == (sizes > tolerance).tolist()
        return told

    assert found(1.0) == (pytest.approx(0.8), pytest.approx(0.3))
    assert found(0.6) == (pytest.approx(0.8), pytest.approx(0.8))
    again[2] = True
    assert found(0.4) == (pytest.approx(0.8), pytest.approx(0.5))
    defect[0, 0] = np.nan
    assert np.isnan(
        known.relative(1.0, 1.0, defect, levers, size, table, again, np.zeros(3), np.zeros(3, dtype=bool))
    ).all()


def bent_law(wrench, tangent, before, ratio, where, *, step=0.1, common=False, again=False):
    """The law of a bearing that stands at 1.0, of which an interval of 1 is over and `ratio` begins."""
    given, laws = [np.array(each)[None] for each in (wrench, tangent, where)], np.full((1, 36), 7.0)
    table, changed = np.zeros((1, known.WIDTH)), np.zeros(1, dtype=bool)
    numbers = np.full(1, 7)
    table[0, STANDS], table[0, SPAN], table[0, INTERVAL] = 1.0 + 1e-9, float(ratio > 0.0), ratio
    table[0, BEFORE:] = before
    asked = True, common, table, np.array([again])
    known.bend_on(0.5, step, *asked, *given, laws, changed, numbers)  # it stands elsewhere
    assert not changed[0] and np.all(laws == 7.0)
    assert known.bend_on(1.0, step, *asked, *given, laws, changed, numbers) == changed[0]
    assert changed[0] and table[0, STANDS] == 1.0
    assert known.bend_on(1.0, step, *asked, *given, laws, changed, numbers) == changed[0]
    assert not changed[0]
    return laws[0]


def missed(h):
    """What a bent law misses of -q^3 on a straight way over an interval h, at its end and in the mean."""
    at = lambda q: (-(q**3), np.eye(1, 32)[0] * 3.0 * q**2)  # noqa: E731
    (wrench, tangent), (_, before), where = at(1.0), at(1.0 - h), np.eye(1, 8)[0]
    law = bent_law(wrench * np.eye(1, 4)[0], tangent, before, 1.0, where)
    assert law[0] - law[4] == pytest.approx(wrench)  # where it stands it is exact
    mean = law[0] - law[4] * (1.0 + 0.5 * h) + ((1.0 + h) ** 4 - 1.0) / (4.0 * h)
    return abs(law[0] - law[4] * (1.0 + h) + (1.0 + h) ** 3), abs(mean)


def test_a_bent_law_meets_the_wrench_at_the_end_to_third_order_and_a_tangent_to_second(way, monkeypatch):
    at_the_end, in_the_mean = missed(0.04)
    assert at_the_end == pytest.approx(2.5 * 0.04**3)  # a tangent misses 3 h^2 + h^3
    assert in_the_mean < 0.5 * abs(-1.0 - 3.0 * 0.02 + (1.04**4 - 1.0) / 0.16)  # that of the tangent
    if way == "as it stands":  # compiled, numbers are fixed
        for share, order in ((0.5, 3.0), (0.0, 2.0)):
            monkeypatch.setattr(known, "SHARE", share)
            assert np.log2(missed(0.04)[0] / missed(0.02)[0]) == pytest.approx(order, abs=0.1)


@both_ways
def test_a_law_follows_no_change_beyond_a_share_of_itself_and_none_without_an_interval_before():
    tangent, before = np.full(32, 2.0), np.full(32, -5.0)
    bends = [bent_law(np.zeros(4), tangent, before, ratio, np.zeros(8))[4:] for ratio in (1.0, 0.0)]
    np.testing.assert_allclose(bends[0], 2.0 * (1.0 + known.SHARE * known.MOST))
    np.testing.assert_array_equal(bends[1], 2.0)


@both_ways
def test_a_law_bends_for_as_long_as_it_will_serve():
    """That is the step, not the interval, where the bearing is evaluated at its end in any case."""
    laws = [
        bent_law(np.zeros(4), np.full(32, 2.0), np.full(32, 1.9), 1.0, np.zeros(8), step=0.25, **asked)[4:]
        for asked in ({}, {"common": True}, {"again": True})
    ]
    for law, ratio in zip(laws, (1.0, 0.25, 0.25), strict=True):
        np.testing.assert_allclose(law, 2.0 + known.SHARE * 0.1 * ratio)
