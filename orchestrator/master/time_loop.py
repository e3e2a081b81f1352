"""The time loop: macro steps to the end time, watched, with a named end."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from time import perf_counter

from orchestrator.errors import outcome_of
from orchestrator.fmi.unit import UnitError
from orchestrator.master.coupling import Advance, Coupling
from orchestrator.master.observer import Observer
from orchestrator.master.stepping import StepCounts, StepFailure, Stepper
from orchestrator.master.system import System
from orchestrator.outcome import Outcome

_WHOLE = 1e-9
"""Share of a step by which the end time may miss a whole number of steps and still count as one."""

_LEAVES_UNITS_USABLE = (
    Outcome.STEP_REFUSED,
    Outcome.FILM_FAILED,
    Outcome.TOLERANCE_MISSED,
    Outcome.NOT_FINITE,
)
"""Ends after which the state that was reached can still be asked for, and is recorded."""


@dataclass(frozen=True)
class Course:
    """The macro steps of a run.

    Attributes
    ----------
    end, step : float
        End time and macro step in s. The last step is shortened to end on the end time exactly.
    tolerance : float or None
        Largest relative error of a step, see `Stepper`.
    events : tuple of float
        Instants on which a step ends besides, in s, ascending.
    level : int
        Halvings of a macro step with which the run begins.
    meeting : int
        Macro steps from one instant to which all bearings come to the next, with many rates; they come to
        events and the end besides.
    """

    end: float
    step: float
    tolerance: float | None = None
    events: tuple[float, ...] = ()
    level: int = 0
    meeting: int = 1

    @property
    def steps(self) -> int:
        """How many macro steps reach the end time; the last one may be shorter."""
        return max(1, math.ceil(self.end / self.step - _WHOLE))

    def instant(self, k: int) -> float:
        """End of macro step k in s."""
        return self.end if k >= self.steps else k * self.step

    def meets(self, k: int) -> bool:
        """Whether all bearings come to the end of macro step k."""
        return k % self.meeting == 0 or k >= self.steps

    def happens(self, time: float) -> bool:
        """Whether an event falls on an instant, but for rounding."""
        return any(abs(time - event) <= _WHOLE * self.step for event in self.events)

    def parts(self, k: int) -> Iterator[tuple[float, float, float]]:
        """Yield start, end and length of macro step k, from 1 on, parted at the events inside."""
        start = (k - 1) * self.step
        # An even step is passed as given, bit by bit, so that units can keep what depends on it.
        whole = k < self.steps or abs(self.end - k * self.step) <= _WHOLE * self.step
        length = self.step if whole else self.end - start
        margin = _WHOLE * self.step
        at, last = start, start + length
        for event in self.events:
            if at + margin < event < last - margin:
                yield at, event, event - at
                at = event
        yield at, self.instant(k), length if at == start else last - at


@dataclass(frozen=True)
class RunEnd:
    """How the time loop ended.

    Attributes
    ----------
    outcome : Outcome
        Its name.
    message : str
        Empty, or what failed and when.
    unit : str
        Empty, or name of the unit that failed, or of the bearing where the coupling did.
    time : float
        Simulated time reached in s.
    counts : StepCounts
        What the step control did.
    wall_time, record_time : float
        Wall time of the loop, and of its recording and checkpoints, in s.
    """

    outcome: Outcome
    message: str
    unit: str
    time: float
    counts: StepCounts
    wall_time: float
    record_time: float


def run(
    system: System,
    scheme: Coupling,
    observers: Sequence[Observer],
    course: Course,
    *,
    on_time: Callable[[float], None],
    resume: Callable[[Stepper], int] | None = None,
) -> RunEnd:
    """Carry an initialized system to the end time.

    Parameters
    ----------
    system : System
        Out of Initialization Mode, outputs fetched.
    scheme : Coupling
        How it is carried over a macro step.
    observers : sequence of Observer
        See the run, in this order; where it stops in reverse, so that what saves the others comes last.
    course : Course
        The macro steps.
    on_time : callable
        Called with the simulated time after each macro step.
    resume : callable, optional
        Puts a run back where it was saved, observers included, and returns the number of the macro step.

    Returns
    -------
    RunEnd
        Also when a unit refuses a step, a tolerance is missed, the motion diverges, or the user interrupts.
    """
    begin, recording = perf_counter(), 0.0
    outcome, message, unit = Outcome.FINISHED, "", ""
    time = 0.0

    def on_step(start: float, end: float, advance: Advance) -> None:
        nonlocal time, recording
        watched = perf_counter()
        time = end
        for observer in observers:
            observer.watch(start, end, advance)
        recording += perf_counter() - watched

    def stop(step: int | None) -> None:
        for observer in reversed(observers):
            observer.stop(step, time, stepper)

    stepper = Stepper(system, scheme, course.tolerance, on_step, course.level)
    try:
        if resume is not None:
            first = resume(stepper)
        else:
            first = 0
            for observer in observers:
                observer.begin(stepper)
        time = course.instant(first)
        for k in range(first + 1, course.steps + 1):
            at = course.instant(k)
            for start, end, length in course.parts(k):
                if course.happens(start):
                    stepper.begin_anew(course.level)
                common = end != at or course.meets(k) or course.happens(end)
                stepper.cross(start, end, length, common)
            watched = perf_counter()
            for observer in observers:
                observer.record(k, time, stepper)
            recording += perf_counter() - watched
            try:
                on_time(time)
            except KeyboardInterrupt:  # between two steps: the run can go on from here, and be recorded
                stop(k)
                raise
    except (StepFailure, UnitError) as error:
        assert error.outcome is not None
        outcome, message, unit = error.outcome, f"at t = {time:.9g} s: {error}", error.unit
    except KeyboardInterrupt as error:
        outcome, message = outcome_of(error), f"at t = {time:.9g} s"
    if outcome in _LEAVES_UNITS_USABLE:
        stop(None)
    return RunEnd(outcome, message, unit, time, stepper.counts, perf_counter() - begin, recording)
