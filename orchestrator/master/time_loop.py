"""The time loop: macro steps to the end time, watched, with a named end."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from time import perf_counter

from orchestrator.errors import Terminated
from orchestrator.fmi.unit import UnitError
from orchestrator.master.coupling import Advance, Coupling
from orchestrator.master.stepping import NotFinite, StepCounts, StepFailure, Stepper
from orchestrator.master.system import System
from orchestrator.observers.ledger import Ledger
from orchestrator.observers.recorder import Recorder
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
        Largest relative defect of a step, see `Stepper`.
    event : float or None
        Instant on which a step ends besides, in s.
    """

    end: float
    step: float
    tolerance: float | None = None
    event: float | None = None

    @property
    def steps(self) -> int:
        """How many macro steps reach the end time; the last one may be shorter."""
        return max(1, math.ceil(self.end / self.step - _WHOLE))

    def instant(self, k: int) -> float:
        """End of macro step k in s."""
        return self.end if k >= self.steps else k * self.step

    def parts(self, k: int) -> Iterator[tuple[float, float, float]]:
        """Yield start, end and length of macro step k, from 1 on; two parts where the event falls inside."""
        start, event = (k - 1) * self.step, self.event
        # An even step is passed as given, bit by bit, so that units can keep what depends on it.
        whole = k < self.steps or abs(self.end - k * self.step) <= _WHOLE * self.step
        length = self.step if whole else self.end - start
        margin = _WHOLE * self.step
        if event is not None and start + margin < event < start + length - margin:
            yield start, event, event - start
            yield event, self.instant(k), start + length - event
        else:
            yield start, self.instant(k), length


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


Save = Callable[[int, float, Stepper, bool], None]
"""Called with number and end of each macro step that was carried out, 0 for the start, the stepper, and
whether it is the last call."""


def run(
    system: System,
    scheme: Coupling,
    recorder: Recorder,
    course: Course,
    *,
    on_time: Callable[[float], None],
    ledger: Ledger | None = None,
    save: Save | None = None,
    resume: Callable[[Stepper], int] | None = None,
) -> RunEnd:
    """Carry an initialized system to the end time.

    Parameters
    ----------
    system : System
        Out of Initialization Mode, outputs fetched.
    scheme : Coupling
        How it is carried over a macro step.
    recorder : Recorder
        Sees the start and every step.
    course : Course
        The macro steps.
    on_time : callable
        Called with the simulated time after each macro step.
    ledger : Ledger, optional
        Sees the start and every step, too.
    save : callable, optional
        See `Save`.
    resume : callable, optional
        Puts a run back where it was saved, and returns the number of the macro step.

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
        recorder.watch(end, advance.defect)
        if ledger is not None:
            ledger.watch(end - start)
        recording += perf_counter() - watched

    stepper = Stepper(system, scheme, course.tolerance, on_step)
    try:
        first = 0
        if resume is not None:
            first = resume(stepper)
        else:
            recorder.watch(0.0)
            recorder.record(0, 0.0)
            if ledger is not None:
                ledger.begin()
            if save is not None:
                save(0, 0.0, stepper, False)
        time = course.instant(first)
        for k in range(first + 1, course.steps + 1):
            for start, stop, length in course.parts(k):
                stepper.cross(start, stop, length)
            watched = perf_counter()
            recorder.record(k, time)
            if save is not None:
                save(k, time, stepper, False)
            recording += perf_counter() - watched
            try:
                on_time(time)
            except KeyboardInterrupt:  # between two steps: the run can go on from here, and be recorded
                if save is not None:
                    save(k, time, stepper, True)
                recorder.close(time)
                raise
    except StepFailure as error:
        outcome = Outcome.NOT_FINITE if isinstance(error, NotFinite) else Outcome.TOLERANCE_MISSED
        message, unit = f"at t = {time:.9g} s: {error}", error.bearing
    except UnitError as error:
        outcome = error.outcome
        message, unit = f"at t = {time:.9g} s: {error}", error.unit
    except KeyboardInterrupt as error:
        outcome = Outcome.TERMINATED if isinstance(error, Terminated) else Outcome.INTERRUPTED
        message = f"at t = {time:.9g} s"
    if outcome in _LEAVES_UNITS_USABLE:
        recorder.close(time)
    return RunEnd(outcome, message, unit, time, stepper.counts, perf_counter() - begin, recording)
