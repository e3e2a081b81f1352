"""Step control on the toy train: tolerance, refused steps, events, and what cannot be met."""

import itertools

import numpy as np
import pytest

from orchestrator.case.simulate import simulate
from orchestrator.errors import FmuError
from orchestrator.master.coupling import LinearImplicit, Newton
from orchestrator.master.jumps import STUBBORN, Jumps
from orchestrator.master.stepping import DEEPEST, StepFailure, Stepper, ToleranceMissed
from orchestrator.master.time_loop import Course
from orchestrator.outcome import Outcome
from orchestrator.results.summary import summarise
from orchestrator.results.summary_table import to_text
from tests.faults import fault
from tests.orchestrator.oscillator import DISPLACEMENT, begin, exact_motion, make_system, released
from tests.orchestrator.toy_train import toy_fmu_folder, toy_scenario

CUBIC = {"stiffness": 1e6, "cubic": 4e12}
LOAD = 4e3  # N, the largest force in the motion
STEP, END = 1e-3, 0.04


@pytest.fixture(scope="module")
def fmus(toy_fmus, tmp_path_factory):
    return toy_fmu_folder(toy_fmus, tmp_path_factory.mktemp("named"))


def carry(system, scheme, tolerance, end=END):
    """Times and x of the front journal after every accepted step, and the stepper."""
    system.set_scale(LOAD, [1.0, 1.0])
    path = [(0.0, system.journals[0, 0])]
    on_step = lambda _start, stop, _advance: path.append((stop, system.journals[0, 0]))  # noqa: E731
    stepper = Stepper(system, scheme, tolerance, on_step)
    for k in range(round(end / STEP)):
        stepper.cross(k * STEP, (k + 1) * STEP, STEP)
    return np.array(path).T, stepper


def test_the_error_follows_the_tolerance(store, toy_fmus):
    error, steps = [], []
    for tolerance in (1e-2, 1e-3, 1e-4):
        system = released(store, toy_fmus, **CUBIC)
        (times, x), stepper = carry(system, LinearImplicit(), tolerance)
        error.append(np.max(np.abs(x - exact_motion(times, **CUBIC))) / DISPLACEMENT)
        steps.append(stepper.counts.accepted)
        assert stepper.counts.largest_relative_defect <= tolerance
        assert stepper.counts.rejected > 0
        system.close()
    assert error[0] > 3.0 * error[1] > 9.0 * error[2]
    assert error[2] < 2e-3
    assert steps[0] < steps[1] < steps[2]


def test_steps_are_the_macro_step_in_powers_of_two_and_meet_its_end(store, toy_fmus):
    system = released(store, toy_fmus, **CUBIC)
    (times, _), _ = carry(system, LinearImplicit(), 1e-3)
    system.close()
    parts = STEP / np.diff(times)
    np.testing.assert_allclose(parts, 2.0 ** np.round(np.log2(parts)), rtol=1e-9)
    assert len(np.unique(np.round(parts))) > 1
    assert np.isin(STEP * np.arange(1, round(END / STEP) + 1), times).all()


def test_where_the_law_is_exact_the_length_of_the_step_still_counts(store, toy_fmus):
    """A linear film has no defect at any step; a tolerance that only the defect met would be no tolerance."""
    error, steps = [], []
    for tolerance in (None, 5e-6, 1e-6):
        system = released(store, toy_fmus)
        (times, x), stepper = carry(system, LinearImplicit(), tolerance)
        system.close()
        assert stepper.counts.largest_relative_defect < 1e-12
        error.append(np.max(np.abs(x - exact_motion(times))) / DISPLACEMENT)
        steps.append(len(times) - 1)
    assert steps[0] == round(END / STEP) < steps[1] < steps[2]
    assert error[0] > 2.0 * error[1] > 4.0 * error[2]


@pytest.mark.parametrize("share", [0.1, 0.3])
def test_a_jump_of_the_force_is_stepped_over_and_counted(store, toy_fmus, share):
    """Halving finds its instant only; a jump too large for a result is still an end by name."""
    system = released(store, toy_fmus, jump=share * LOAD, **CUBIC)
    if share > 0.2:
        with pytest.raises(ToleranceMissed, match=r"allowed is 0\.02"):
            carry(system, LinearImplicit(), 0.02)
    else:
        (times, x), stepper = carry(system, LinearImplicit(), 0.02)
        crossings = np.count_nonzero(np.diff(x > 0.0))
        assert 1 <= stepper.counts.jumps <= crossings
        assert stepper.counts.largest_relative_error == pytest.approx(share, rel=0.2)
        behind = np.flatnonzero(np.diff(times) < STEP / 3)
        assert len(behind) < 0.3 * len(times)  # steps grow again
    system.close()


def test_what_is_missed_over_a_jump_counts_as_an_impulse():
    """The step over it is a quarter of that with which it was met, and so is what the shaft feels."""
    jumps = Jumps()
    assert [jumps.found(0.04, level, 1.0) for level in (2, 3, 4)] == [False, False, True]
    assert jumps.share(4) == 0.25


def test_before_a_large_error_counts_as_a_jump_more_halvings_are_tried():
    jumps = Jumps()
    assert [jumps.found(0.1, level, 1.0) for level in range(6)] == [False] * STUBBORN + [True]
    jumps = Jumps()
    falling = [0.1, 0.12, 0.1, 0.08, 0.05, 0.03]  # as of what is damped so fast that long steps do not see it
    assert not any(jumps.found(error, level, 1.0) for level, error in enumerate(falling))


def test_a_step_taken_back_leaves_no_trace(store, toy_fmus):
    """The accepted steps alone, on fresh units, give the same motion to the bit."""
    system = released(store, toy_fmus, **CUBIC)
    (times, x), _ = carry(system, LinearImplicit(), 1e-3, end=0.01)
    system.close()
    fresh = released(store, toy_fmus, **CUBIC)
    again = [fresh.journals[0, 0]]
    for start, stop in itertools.pairwise(times):
        step = STEP / 2.0 ** np.round(np.log2(STEP / (stop - start)))
        LinearImplicit().advance(fresh, start, step)
        again.append(fresh.journals[0, 0])
    fresh.close()
    np.testing.assert_array_equal(again, x)


def test_newton_iterates_instead_of_halving(store, toy_fmus):
    system = released(store, toy_fmus, **CUBIC)
    (times, _), stepper = carry(system, Newton(1e-6), None)
    system.close()
    assert len(times) == round(END / STEP) + 1
    assert stepper.counts.iterations > stepper.counts.accepted
    assert stepper.counts.rejected == 0


@fault(
    "coupling",
    "an iteration that does not converge",
    "the step is taken back and halved",
    guard="orchestrator.master.stepping:Stepper._attempt",
)
def test_newton_that_does_not_converge_halves(store, toy_fmus):
    system = released(store, toy_fmus, **CUBIC)
    _, stepper = carry(system, Newton(1e-6, limit=2), None, end=5e-3)
    system.close()
    assert stepper.counts.rejected > 0
    assert stepper.counts.shortest < STEP


def refusing(store, toy_fmus, **more):
    start = {"bearing[1].start.x": DISPLACEMENT, "start.orbit": False}
    window = {"refuse_from": 4.2e-3, "refuse_to": 6e-3, "refuse_over": 3e-4}
    system = make_system(store, toy_fmus, rotor=start, bearing={**window, **more})
    begin(system)
    return system


def test_a_refused_step_is_halved_there_and_steps_grow_again(store, toy_fmus):
    system = refusing(store, toy_fmus)
    (times, x), stepper = carry(system, LinearImplicit(), None, end=0.01)
    system.close()
    steps = np.diff(times)
    assert stepper.counts.discarded > 0 and stepper.counts.rejected == 0
    np.testing.assert_allclose(steps[:4], STEP)
    np.testing.assert_allclose(steps[-3:], STEP)
    assert steps.min() == pytest.approx(STEP / 4)
    np.testing.assert_allclose(x, exact_motion(times), atol=0.01 * DISPLACEMENT)


@fault(
    "film",
    "a film that fails for good",
    "the step is halved to a thousandth, then the run ends at the last accepted step, with the unit's reason",
    guard="orchestrator.master.stepping:Stepper._attempt",
)
def test_what_is_always_refused_ends_at_the_last_accepted_step(store, toy_fmus):
    system = refusing(store, toy_fmus, refuse_after=7e-3)
    system.set_scale(LOAD, [1.0, 1.0])
    reached = []
    stepper = Stepper(system, LinearImplicit(), None, lambda _start, stop, _advance: reached.append(stop))
    with pytest.raises(Exception, match="used up"):
        for k in range(10):
            stepper.cross(k * STEP, (k + 1) * STEP, STEP)
    assert 7e-3 - STEP / 2**DEEPEST <= reached[-1] <= 7e-3
    x = system.journals[0, 0]
    assert x == pytest.approx(exact_motion(np.array([0.0, reached[-1]]))[-1], abs=0.01 * DISPLACEMENT)
    system.close()


def test_a_tolerance_below_rounding_is_missed_by_name(store, toy_fmus):
    system = released(store, toy_fmus, **CUBIC)
    with pytest.raises(ToleranceMissed, match=r"allowed is 1e-18") as missed:
        carry(system, LinearImplicit(), 1e-18)
    assert isinstance(missed.value, StepFailure)
    assert system.journals[0, 0] == DISPLACEMENT
    system.close()


def test_a_run_whose_tolerance_is_missed_keeps_its_record(fmus, tmp_path):
    blade = {"wheel": "wheel", "unbalance": 0.1, "time": 0.0205}
    result = simulate(toy_scenario(tmp_path, event=blade, tolerance=1e-30), fmus)
    assert result.outcome is Outcome.TOLERANCE_MISSED
    assert "relative defect" in result.message
    assert result.record.sizes["time"] >= 1
    assert result.record.attrs["status"] == "tolerance-missed"


def test_controlled_steps_end_on_the_fracture_and_records_stay_regular(fmus, tmp_path):
    blade = {"wheel": "wheel", "unbalance": 0.1, "time": 0.0205}
    result = simulate(toy_scenario(tmp_path, event=blade, tolerance=1e-3), fmus)
    assert result.outcome is Outcome.FINISHED
    assert result.steps == 51
    np.testing.assert_allclose(result.record["time"], 1e-3 * np.arange(51), rtol=1e-12)
    attributes = result.record.attrs
    assert (attributes["accepted_steps"], attributes["rejected_steps"]) == (51, 0)
    assert attributes["evaluations"] == result.evaluations == 102
    assert attributes["tolerance"] == 1e-3
    text = to_text(summarise(result))
    assert "51 steps of 0.5 to 1 ms, 0 rejected" in text


def test_a_macro_step_is_parted_at_an_event_inside():
    course = Course(0.01, 1e-3, events=(2.25e-3,))
    assert list(course.parts(3)) == [
        (2e-3, 2.25e-3, pytest.approx(2.5e-4)),
        (2.25e-3, 3e-3, pytest.approx(7.5e-4)),
    ]
    assert list(course.parts(2)) == [(1e-3, 2e-3, 1e-3)]
    assert list(Course(0.01, 1e-3, events=(2e-3,)).parts(3)) == [(2e-3, 3e-3, 1e-3)]
    several = Course(0.01, 1e-3, events=(2.25e-3, 2.5e-3, 2.5e-3, 2.75e-3, 3e-3))
    assert [start for start, _, _ in several.parts(3)] == [2e-3, 2.25e-3, 2.5e-3, 2.75e-3]
    assert sum(length for _, _, length in several.parts(3)) == pytest.approx(1e-3)
    assert list(Course(2.5e-3, 1e-3).parts(3)) == [(2e-3, 2.5e-3, pytest.approx(5e-4))]


@fault(
    "unit",
    "an FMU without states in a coupling that takes steps back",
    "FmuError; unit, `canGetAndSetFMUstate`, couplings that do without",
    guard="orchestrator.master.rollback:Rollback.require",
)
def test_units_that_cannot_be_taken_back_are_named(store, toy_fmus):
    system = released(store, toy_fmus)
    system.rotor.file.description.coSimulation.canGetAndSetFMUstate = False
    stuck = released(store, toy_fmus)
    with pytest.raises(FmuError, match="coupling newton takes steps back, and rotor cannot keep"):
        Stepper(stuck, Newton(), None, lambda *_: None)
    Stepper(stuck, LinearImplicit(), None, lambda *_: None).cross(0.0, STEP, STEP)
    stuck.close()
    system.close()
