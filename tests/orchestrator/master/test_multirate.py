"""Many rates: which bearing is evaluated when, by pure functions and on the oscillator of three FMUs."""

import numpy as np
import pytest

from orchestrator.case.course import course_of
from orchestrator.case.simulate import Execution, simulate
from orchestrator.errors import ScenarioError
from orchestrator.master.coupling import LinearImplicit, Multirate
from orchestrator.master.coupling import rates as known
from orchestrator.master.coupling.rates import BEFORE, BEND, CALM, INTERVAL, KNOWN, LINEAR, SIZE, SPAN, STANDS
from orchestrator.master.stepping import Stepper
from orchestrator.master.system import law_wrenches
from orchestrator.master.time_loop import Course
from orchestrator.observers.ledger import Ledger
from rotor_fmu.train.file import load_train
from tests.orchestrator.oscillator import DISPLACEMENT, begin, exact_motion, make_system, released
from tests.orchestrator.toy_train import toy_fmu_folder, toy_scenario

CUBIC = {"stiffness": 1e6, "cubic": 4e12}
LOAD, MACRO, END = 4e3, 2e-3, 0.04  # N, the largest force in the motion; s


SCALARS = ("bend_on", "due_at", "defects", "relative", "intervals_after")


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


def due(end, moved, tolerance, bend):
    """Who is due at `end`, where a step in x of these lengths has moved forces by as much."""
    tangents, motion = np.zeros((3, 32)), np.zeros((3, 8))
    tangents[:, 0], motion[:, 0] = -1.0, moved
    found, said = np.zeros(3), np.zeros(3, dtype=bool)
    given = rates(bend=bend), tangents, np.zeros((3, 8)), motion, np.ones(3), np.zeros(3, dtype=bool)
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
    assert np.isnan(known.relative(1.0, 1.0, defect, levers, size, table, again, np.zeros(3), again)).all()


@both_ways
def test_a_defect_is_what_the_law_has_missed():
    rng = np.random.default_rng(1)
    wrenches, laws, motion = (rng.normal(size=(3, n)) for n in (4, 36, 8))
    defect = np.full((3, 4), np.nan)
    known.defects(wrenches, laws, motion, np.array([True, True, False]), defect)
    missed = wrenches - law_wrenches(laws, motion)
    np.testing.assert_allclose(defect, np.where([[1], [1], [0]], missed, 0.0), rtol=1e-12)


def bent_law(wrench, tangent, before, ratio, where):
    """The law of a bearing that stands at 1.0, of which an interval of 1 is over and `ratio` begins."""
    given, laws = [np.array(each)[None] for each in (wrench, tangent, where)], np.full((1, 36), 7.0)
    table, changed = np.zeros((1, known.WIDTH)), np.zeros(1, dtype=bool)
    table[0, STANDS], table[0, SPAN], table[0, INTERVAL] = 1.0 + 1e-9, float(ratio > 0.0), ratio
    table[0, BEFORE:] = before
    known.bend_on(0.5, 0.1, True, table, *given, laws, changed)  # it stands elsewhere
    assert not changed[0] and np.all(laws == 7.0)
    known.bend_on(1.0, 0.1, True, table, *given, laws, changed)
    assert changed[0] and table[0, STANDS] == 1.0
    known.bend_on(1.0, 0.1, True, table, *given, laws, changed)
    assert not changed[0]
    return laws[0]


def missed(h):
    """What a bent law misses of the mean wrench of -q^3 on a straight way over an interval h."""
    at = lambda q: (-(q**3), np.eye(1, 32)[0] * 3.0 * q**2)  # noqa: E731
    (wrench, tangent), (_, before), where = at(1.0), at(1.0 - h), np.eye(1, 8)[0]
    law = bent_law(wrench * np.eye(1, 4)[0], tangent, before, 1.0, where)
    assert law[0] - law[4] == pytest.approx(wrench)  # where it stands it is exact
    return abs(law[0] - law[4] * (1.0 + 0.5 * h) + ((1.0 + h) ** 4 - 1.0) / (4.0 * h))


def test_a_bent_law_has_the_mean_wrench_to_third_order_and_a_tangent_to_second(way, monkeypatch):
    unbent = abs(-1.0 - 3.0 * 0.02 + (1.04**4 - 1.0) / 0.16)  # of the tangent
    assert missed(0.04) < 0.3 * unbent
    if way == "as it stands":  # compiled, numbers are fixed
        for share, order in ((1.0, 3.0), (0.0, 2.0)):
            monkeypatch.setattr(known, "SHARE", share)
            assert np.log2(missed(0.04) / missed(0.02)) == pytest.approx(order, abs=0.1)


@both_ways
def test_a_law_follows_no_change_beyond_a_share_of_itself_and_none_without_an_interval_before():
    tangent, before = np.full(32, 2.0), np.full(32, -5.0)
    bends = [bent_law(np.zeros(4), tangent, before, ratio, np.zeros(8))[4:] for ratio in (1.0, 0.0)]
    np.testing.assert_allclose(bends[0], 2.0 * (1.0 + known.SHARE / 3.0 * known.MOST))
    np.testing.assert_array_equal(bends[1], 2.0)


def carry(system, tolerance, level=3, on_step=lambda *_: None):
    """Times, x of the front journal and who was evaluated after every accepted step, and the stepper."""
    system.set_scale(LOAD, [1.0, 1.0])
    path = [(0.0, system.journals[0, 0], True, True)]

    def note(start, end, advance):
        path.append((end, system.journals[0, 0], *advance.evaluated))
        on_step(start, end, advance)

    stepper = Stepper(system, Multirate(tolerance), tolerance, note)
    stepper.level = level
    for k in range(round(END / MACRO)):
        stepper.cross(k * MACRO, (k + 1) * MACRO, MACRO)
    return np.array(path).T, stepper


def test_the_error_follows_the_tolerance(store, toy_fmus):
    error, evaluations = [], []
    for tolerance in (1e-2, 1e-3, 1e-4):
        system = released(store, toy_fmus, **CUBIC)
        (times, x, *_), stepper = carry(system, tolerance)
        error.append(np.max(np.abs(x - exact_motion(times, **CUBIC))) / DISPLACEMENT)
        evaluations.append(system.bearing_group.evaluations)
        assert stepper.counts.largest_relative_error <= tolerance
        system.close()
    assert error[0] > 3.0 * error[1] > 9.0 * error[2]
    assert error[2] < 2e-3
    assert evaluations[0] < evaluations[1] < evaluations[2]


def uneven(store, toy_fmus):
    """A front bearing whose spring bends, and a linear one behind on which nothing happens."""
    start = {"bearing[1].start.x": DISPLACEMENT, "start.orbit": False}
    system = make_system(store, toy_fmus, rotor=start)
    front = {"spring.stiffness": 1e6, "spring.damping": 1e3, "spring.cubic": 4e12}
    system.bearings[0].set_parameters(front)
    begin(system)
    return system


def test_the_calm_bearing_waits_and_no_unit_steps_twice_over_a_time(store, toy_fmus):
    """Accepted steps of each unit follow one another, and meet common instants."""
    system = uneven(store, toy_fmus)
    taken = {unit.name: [] for unit in system.units}
    for unit in system.units:
        step_of = unit.do_step

        def do_step(time, step, unit=unit, step_of=step_of):
            taken[unit.name].append((time, step))
            step_of(time, step)

        unit.do_step = do_step
    (times, x, front, rear), _ = carry(system, 1e-3)
    system.close()
    common = MACRO * np.arange(round(END / MACRO) + 1)
    later = times >= MACRO  # its defect is rounding: in the first macro step its interval has grown to that
    np.testing.assert_array_equal(times[later & (rear > 0)], common[1:])
    assert front.sum() > 3 * rear.sum()
    assert np.max(np.abs(x - exact_motion(times, **CUBIC))) < 0.02 * DISPLACEMENT
    for name, on_time in (("rear", times[rear > 0]), ("rotor", times)):
        start, length = np.array(taken[name]).T
        kept = np.append(start[1:] > start[:-1], True)  # what was taken back was repeated from the same start
        np.testing.assert_allclose(start[kept], on_time[:-1], rtol=1e-12)
        np.testing.assert_allclose(start[kept] + length[kept], on_time[1:], rtol=1e-12)


def test_linear_bearings_need_no_evaluation_but_at_common_instants(store, toy_fmus):
    """And the motion is that of evaluating them at every step."""
    system, each = released(store, toy_fmus), released(store, toy_fmus)
    system.set_scale(LOAD, [1.0, 1.0])
    scheme, step = Multirate(1e-6), MACRO / 8
    for k in range(160):
        scheme.advance(system, k * step, step, k % 8 == 7)
        LinearImplicit().advance(each, k * step, step)
        np.testing.assert_allclose(system.journals, each.journals, rtol=1e-9, atol=1e-15)
    assert system.bearing_group.evaluations < 0.2 * each.bearing_group.evaluations
    system.close()
    each.close()


def test_behind_an_event_steps_and_intervals_begin_anew(store, toy_fmus):
    """A step of the calm rear bearing, which bends not at all, would be the whole macro step."""
    system = uneven(store, toy_fmus)
    system.set_scale(LOAD, [1.0, 1.0])
    path = []
    stepper = Stepper(system, Multirate(1e-3), 1e-3, lambda *step: path.append(step))
    course = Course(END, MACRO, 1e-3, events=(0.5 * END,), level=5)
    for k in range(1, course.steps + 1):
        for start, end, length in course.parts(k):
            if course.happens(start):
                stepper.begin_anew(course.level)
                before, path = path, []
            stepper.cross(start, end, length)
    system.close()
    assert min(end - start for start, end, _ in before[-8:]) > 1.9 * MACRO / 2**course.level
    spans = [end - start for start, end, _ in path[:4]]
    assert spans[0] == pytest.approx(MACRO / 2**course.level)
    assert max(np.divide(spans[1:], spans[:-1])) < 2.0 + 1e-6
    assert path[0][2].evaluated.all()
    assert stepper.scheme.memory["span"].min() > 0.0


def test_units_that_cannot_be_taken_back_are_carried_on_in_shorter_steps(store, toy_fmus):
    system = released(store, toy_fmus, **CUBIC)
    for unit in system.units:
        unit.file.description.coSimulation.canGetAndSetFMUstate = False
    stuck = released(store, toy_fmus, **CUBIC)
    (times, x, *_), stepper = carry(stuck, 1e-3, level=0)
    assert stepper.counts.taken_back == 0
    assert stepper.counts.largest_relative_defect > 1e-3  # the first steps were too long
    assert np.max(np.abs(x - exact_motion(times, **CUBIC))) < 0.05 * DISPLACEMENT
    assert np.diff(times)[-1] < MACRO
    stuck.close()
    system.close()


def test_the_ledger_counts_the_defect_over_the_interval_of_each_bearing(store, toy_fmus):
    """Undamped springs, one cubic: the film's work is what their potential loses, and the gap is small."""
    system = released(store, toy_fmus, stiffness=1e6, damping=0.0, cubic=4e12)
    ledger, behind = Ledger(system), list[Ledger]()

    def watch(*step):
        state = ledger.arrays()
        if not behind and state["open.time"].any():  # as behind a checkpoint between two evaluations
            behind.append(Ledger(system))
            behind[0].restore({name: values.copy() for name, values in state.items()})
        for each in (ledger, *behind):
            each.watch(*step)

    carry(system, 3e-4, on_step=watch)
    balance = ledger.balance()
    np.testing.assert_array_equal(behind[0].balance().bearings, balance.bearings)
    lost = sum(
        sign * (0.5e6 * x**2 + 1e12 * x**4)
        for sign, x in ((1.0, DISPLACEMENT), (-1.0, system.journals[0, 0]))
    )
    assert balance.bearings[0, 0] == pytest.approx(lost, abs=1e-3 * balance.exchanged)
    assert np.abs(balance.residue).sum() < 1e-3 * balance.exchanged
    system.close()


def test_one_thread_or_two_give_the_same_record(toy_fmus, tmp_path):
    fmus = toy_fmu_folder(toy_fmus, tmp_path / "fmus")
    blade = {"wheel": "wheel", "unbalance": 0.1, "time": 0.0205}
    scenario = toy_scenario(tmp_path, event=blade, coupling="multirate")
    one, two = (simulate(scenario, fmus, None, Execution(threads=n)) for n in (1, 2))
    assert one.outcome.ok, one.message
    assert one.record.identical(two.record)


def test_common_instants_are_as_far_apart_as_records_and_the_revolution_allow(tmp_path):
    """The turbine turns at 25 Hz: a twentieth of its revolution is 2 ms."""
    turbine = load_train("turbine")

    def course(**changes):
        scenario = toy_scenario(tmp_path, step=1e-4, coupling="multirate", **changes)
        made, stride = course_of(scenario, turbine)
        return made.step, stride, made.level, made.tolerance

    assert course(record={"interval": 5e-4}) == (pytest.approx(5e-4), 1, 3, Multirate.tolerance)
    assert course(record={"interval": 2.4e-3}) == (pytest.approx(1.2e-3), 2, 4, Multirate.tolerance)
    assert course(record={"interval": 1e-4}, tolerance=0.1) == (1e-4, 1, 0, 0.1)
    with pytest.raises(
        ScenarioError, match=r"tolerance = 0\.3; allowed is at most 0\.1 with coupling multirate"
    ):
        course(tolerance=0.3)
