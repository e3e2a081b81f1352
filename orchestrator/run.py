"""The time loop: macro steps to the end time, watched, with a named end."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

from orchestrator.coupling import Coupling
from orchestrator.outcome import Outcome
from orchestrator.recorder import Recorder
from orchestrator.system import System
from orchestrator.unit import Status, UnitError

_WHOLE = 1e-9
"""Share of a step by which the end time may miss a whole number of steps and still count as one."""


@dataclass(frozen=True)
class RunEnd:
    """How the time loop ended.

    Attributes
    ----------
    outcome : Outcome
        Its name.
    message : str
        Empty, or what failed and when.
    time : float
        Simulated time reached in s.
    steps : int
        Macro steps carried out.
    wall_time, record_time : float
        Wall time of the loop, and of its recording, in s.
    """

    outcome: Outcome
    message: str
    time: float
    steps: int
    wall_time: float
    record_time: float


def step_count(end: float, step: float) -> int:
    """Return how many macro steps reach the end time; the last one may be shorter."""
    return max(1, math.ceil(end / step - _WHOLE))


def run(
    system: System,
    scheme: Coupling,
    recorder: Recorder,
    *,
    end: float,
    step: float,
    on_time: Callable[[float], None],
) -> RunEnd:
    """Carry an initialized system from 0 to the end time.

    Parameters
    ----------
    system : System
        Out of Initialization Mode, outputs fetched.
    scheme : Coupling
        How it is carried over a macro step.
    recorder : Recorder
        Sees the start and every macro step.
    end, step : float
        End time and macro step in s. The last step is shortened to end on the end time exactly.
    on_time : callable
        Called with the simulated time after each macro step.

    Returns
    -------
    RunEnd
        Also when a unit refuses a step, the motion diverges, or the user interrupts.
    """
    steps = step_count(end, step)
    begin, recording = perf_counter(), 0.0
    outcome, message = Outcome.FINISHED, ""
    time, done = 0.0, 0
    try:
        recorder.observe(0, 0.0)
        for k in range(1, steps + 1):
            last = k == steps
            start = (k - 1) * step
            # An even step is passed as given, bit by bit, so that units can keep what depends on it.
            whole = not last or abs(end - k * step) <= _WHOLE * step
            advance = scheme.advance(system, start, step if whole else end - start)
            if not math.isfinite(system.journals.sum()):
                outcome = Outcome.NOT_FINITE
                message = f"at t = {start:.9g} s: a journal's motion is not finite after the step"
                break
            time, done = end if last else k * step, k
            watched = perf_counter()
            recorder.observe(k, time, advance.defect)
            recording += perf_counter() - watched
            on_time(time)
    except UnitError as error:
        outcome = Outcome.STEP_REFUSED if error.status is Status.DISCARD else Outcome.UNIT_FAILED
        message = f"at t = {time:.9g} s: {error}"
    except KeyboardInterrupt:
        outcome, message = Outcome.INTERRUPTED, f"at t = {time:.9g} s"
    return RunEnd(outcome, message, time, done, perf_counter() - begin, recording)
