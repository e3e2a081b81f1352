"""Many rates: which bearing is evaluated when, on the oscillator of three FMUs."""

import numpy as np
import pytest

from orchestrator.case.course import course_of
from orchestrator.case.simulate import Execution, simulate
from orchestrator.errors import ScenarioError
from orchestrator.master.coupling import LinearImplicit, Multirate
from orchestrator.master.coupling.multirate import PARTS, SOON
from orchestrator.master.coupling.rates import STANDS
from orchestrator.master.stepping import Stepper
from orchestrator.master.time_loop import Course
from orchestrator.observers.ledger import Ledger
from rotor_fmu.train.file import load_train
from tests.orchestrator.oscillator import DISPLACEMENT, begin, exact_motion, make_system, released
from tests.orchestrator.toy_train import toy_fmu_folder, toy_scenario

CUBIC = {"stiffness": 1e6, "cubic": 4e12}
LOAD, MACRO, END = 4e3, 2e-3, 0.04  # N, the largest force in the motion; s


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


def test_what_a_step_that_counted_left_is_not_due_in_the_repetition_of_the_next(store, toy_fmus):
    system = uneven(store, toy_fmus)
    system.set_scale(LOAD, [1.0, 1.0])
    scheme = Multirate(1e-3)
    scheme.advance(system, 0.0, 1e-4)
    scheme._room.rough[:] = True  # as of a jump, which is accepted
    scheme._at(system, 1e-4, 1e-4)
    scheme.refuse()
    assert not scheme._room.again.any()
    system.close()


def test_a_bearing_that_was_hit_while_it_stood_behind_is_evaluated_soon_in_the_repetition(store, toy_fmus):
    system = uneven(store, toy_fmus)
    system.set_scale(LOAD, [1.0, 1.0])
    scheme = Multirate(1e-3)
    for k in range(3):
        scheme.advance(system, k * 1e-4, 1e-4, common=False)
    room = scheme._room
    room.rates[:, STANDS] = 2e-4, 1e-4
    room.rough[:] = True, False
    assert scheme.refuse() == 1
    room.rough[:] = False, True
    assert scheme.refuse() == SOON
    assert room.again.tolist() == [False, True]
    assert scheme.refuse() == 1, "it is no surprise in the repetition"
    system.close()


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
        later = np.minimum.accumulate(np.append(start[1:], np.inf)[::-1])[::-1]
        kept = start < later  # the rest was taken back
        start, end = start[kept], start[kept] + length[kept]
        np.testing.assert_allclose(start[1:], end[:-1], rtol=1e-12)
        if name == "rotor":  # was not told to go in parts: the master takes it through them
            parts = np.diff(np.searchsorted(end, on_time * (1.0 + 1e-9)))
            assert set(parts) == {PARTS}
            end = end[np.cumsum(parts) - 1]
        np.testing.assert_allclose(end, on_time[1:], rtol=1e-12)


def test_linear_bearings_need_no_evaluation_but_at_common_instants(store, toy_fmus):
    """And the motion is that of evaluating them at every step of the rotor."""
    system, each = released(store, toy_fmus), released(store, toy_fmus)
    system.set_scale(LOAD, [1.0, 1.0])
    scheme, step = Multirate(1e-6), MACRO / 8
    for k in range(160):
        scheme.advance(system, k * step, step, k % 8 == 7)
        for part in range(PARTS):
            LinearImplicit().advance(each, (k + part / PARTS) * step, step / PARTS)
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
