"""Step control: carries a system over an interval in one step, or in halves of halves of it.

Steps are the interval divided by powers of two, so that units which keep what depends on the
step size keep little.  A step whose error exceeds the tolerance, whose iteration does not
converge, or that a unit discards is taken back and halved; steps grow again when the film is
calm, in pairs, so that they always end on the interval's end.  The error of a step is the larger of
its defect, which sees the interface, and of what comes of its length (`step_error`).  A scheme of many
rates lets bearings stay behind within the interval; where units cannot be taken back, it goes on in
halves after a step that was too long.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import ArrayLike

from orchestrator.errors import OrchestratorError
from orchestrator.fmi.unit import Status, UnitError
from orchestrator.master.coupling import Advance, Coupling, NotConverged
from orchestrator.master.interface import within
from orchestrator.master.jumps import Jumps
from orchestrator.master.step_error import error_of_step
from orchestrator.master.system import System
from orchestrator.outcome import Outcome

DEEPEST = 10
"""Halvings of the first step at most; the shortest step is 1/1024 of it."""

CALM = 1.0 / 8.0
"""Share of the tolerance below which the error, of second order in the step, allows twice the step."""

BEYOND_ALL_BOUNDS = 1e6
"""Position, tilt or rate of a journal, SI units, at which a run has diverged; stresses still fit a record."""

OF_LENGTH = 0.4
"""Weight of the error from a step's length against its defect; with it equal tolerances give equal errors
whether the defect decides (linear-implicit) or the length does (newton)."""

EASY = 3
"""Passes of an iterating scheme up to which twice the step is tried."""


class Verdict(Enum):
    """What became of a step."""

    EASY = "twice of it would do"
    RIGHT = "accepted"
    LONG = "accepted for want of a way back, half of it should follow"
    TAKEN_BACK = "taken back"


@dataclass
class StepCounts:
    """What the step control did.

    Attributes
    ----------
    accepted, rejected, discarded : int
        Steps that count; steps taken back for their defect or for lack of convergence, and because a
        unit did not accept them.
    iterations : int
        Passes through the units in all accepted steps.
    jumps : int
        Accepted steps whose error is above the tolerance since the law of a bearing jumps.
    shortest : float
        Shortest accepted step in s.
    largest_relative_defect, largest_relative_error : float
        Over all accepted steps, see `System.relative`; the error is that which the tolerance bounds.
    """

    accepted: int = 0
    rejected: int = 0
    discarded: int = 0
    iterations: int = 0
    jumps: int = 0
    shortest: float = math.inf
    largest_relative_defect: float = 0.0
    largest_relative_error: float = 0.0

    @property
    def taken_back(self) -> int:
        """Steps taken back."""
        return self.rejected + self.discarded

    def attributes(self, evaluations: int) -> dict[str, float]:
        """Attributes of the record, with the steps of bearing units in all."""
        return {
            "accepted_steps": self.accepted,
            "rejected_steps": self.rejected,
            "discarded_steps": self.discarded,
            "iterations": self.iterations,
            "jumps": self.jumps,
            "evaluations": evaluations,
            "shortest_step": self.shortest if self.accepted else 0.0,
            "largest_relative_defect": self.largest_relative_defect,
            "largest_relative_error": self.largest_relative_error,
        }


class StepFailure(OrchestratorError):
    """A step that cannot be carried out even at the shortest size; `unit` is the worst bearing."""

    def __init__(self, text: str, bearing: str = "") -> None:
        self.unit = bearing
        super().__init__(f"{bearing}: {text}" if bearing else text)


class ToleranceMissed(StepFailure):
    """The defect, or the residual of an iteration, stays above the tolerance."""

    outcome = Outcome.TOLERANCE_MISSED


class NotFinite(StepFailure):
    """The motion is no longer finite."""

    outcome = Outcome.NOT_FINITE


class Stepper:
    """Carries a system over intervals.

    A step whose error no halving makes less is accepted and counted as a jump, see
    `orchestrator.master.jumps`; behind it steps grow again to that with which the jump was met.

    Parameters
    ----------
    system : System
        Out of Initialization Mode, outputs fetched.
    scheme : Coupling
        How it is carried over a step.
    tolerance : float or None
        Largest relative error of a step; None accepts every step that the units accept.
    on_step : callable
        Called after each accepted step with its start, its end and its `Advance`.
    level : int
        Halvings of the interval to begin with.

    Attributes
    ----------
    counts : StepCounts
        What was done so far.
    level : int
        Halvings of the interval in use.
    scheme : Coupling
        As given.
    """

    def __init__(
        self,
        system: System,
        scheme: Coupling,
        tolerance: float | None,
        on_step: Callable[[float, float, Advance], None],
        level: int = 0,
    ) -> None:
        if (tolerance is not None or scheme.iterates) and not scheme.many_rates:
            system.rollback.require(f"coupling {scheme.name}" if scheme.iterates else "a tolerance")
        self._system, self.scheme, self._on_step = system, scheme, on_step
        self._tolerance = tolerance
        self._before = system.motion.copy()
        self._jumps = Jumps()
        self._marks = not scheme.iterates and system.rollback.possible
        self.counts = StepCounts()
        self.level, self._deepest, self._halvings = level, level + DEEPEST, 1

    def begin_anew(self, level: int) -> None:
        """Take note of an event: steps of many rates begin behind it with so many halvings again."""
        self.scheme.begin_anew()
        if self.scheme.many_rates:
            self.level = max(self.level, level)

    def cross(self, start: float, end: float, length: float, common: bool = True) -> None:
        """Carry the system over an interval; its length is given besides, free of rounding.

        At a `common` end all bearings are evaluated.

        Raises
        ------
        StepFailure, UnitError
            When even the shortest step fails; the system stands at the last accepted one.
        """
        done = 0
        while done < 2**self.level:
            step = length / 2**self.level
            last = done + 1 == 2**self.level
            verdict = self._attempt(
                start + done * step, end if last else start + (done + 1) * step, step, last and common
            )
            done += verdict is not Verdict.TAKEN_BACK
            if verdict in (Verdict.TAKEN_BACK, Verdict.LONG) and self.level < self._deepest:
                more = self._halvings if verdict is Verdict.TAKEN_BACK else 1
                more = min(more, self._deepest - self.level)
                self.level, done = self.level + more, done << more
                self._jumps.taken_back()
                continue
            easy = verdict is Verdict.EASY
            while self.level and done % 2 == 0 and (easy or self.level > self._jumps.behind):
                self.level, done, easy = self.level - 1, done // 2, False
            self._jumps.grown(self.level)

    def _attempt(self, time: float, end: float, step: float, common: bool) -> Verdict:
        """Take a step, to a `common` instant or not."""
        if self._marks:
            self._system.rollback.mark()
        self._before[:] = self._system.motion
        try:
            advance = self._advance(time, step, common)
            sizes = self._sizes(advance)
            problem = self._problem(advance, sizes, step)
            if isinstance(problem, ToleranceMissed) and self._jumps.found(max(sizes), self.level, end):
                self.counts.jumps, problem = self.counts.jumps + 1, None
                assert advance.of_length is not None
                advance.of_length[:] *= self._jumps.share(self.level)
        except NotConverged as error:
            problem = ToleranceMissed(f"{error}, with a step of {step:.3g} s")
        except UnitError as error:
            if error.status is not Status.DISCARD or not self._system.rollback.possible:
                raise
            self._take_back()
            self.counts.discarded += 1
            if self.level == self._deepest:
                raise
            return Verdict.TAKEN_BACK
        bears = self.scheme.many_rates and not self._system.rollback.possible
        if problem is not None and not (bears and isinstance(problem, ToleranceMissed)):
            if possible := self._system.rollback.possible:
                self._take_back()
            self.counts.rejected += 1
            fixed = self._tolerance is None and not self.scheme.iterates
            if fixed or not possible or self.level == self._deepest:
                raise problem
            return Verdict.TAKEN_BACK
        self._jumps.passed(end)
        self._count(advance, step, sizes)
        self._on_step(time, end, advance)
        if problem is not None:
            return Verdict.LONG
        if self.scheme.iterates and advance.iterations > EASY:
            return Verdict.RIGHT
        easy = self._tolerance is None or max(sizes) <= CALM * self._tolerance
        return Verdict.EASY if easy else Verdict.RIGHT

    def _take_back(self) -> None:
        self._system.rollback.take_back()
        self._halvings = self.scheme.refuse()

    def _advance(self, time: float, step: float, common: bool) -> Advance:
        """Carry the system over a step, and estimate its error."""
        system = self._system
        done = self.scheme.advance(system, time, step, common)
        of_length = error_of_step(self._before, system.motion, system.squares, step)
        return Advance(done.iterations, done.defect, of_length, done.evaluated, done.errors)

    def _sizes(self, advance: Advance) -> tuple[float, float]:
        """Relative defect of a step, and weighted relative error from its length."""
        assert advance.of_length is not None
        of_length = OF_LENGTH * self._system.relative(advance.of_length)
        errors = advance.errors
        return self._system.relative(advance.defect) if errors is None else errors.answered, of_length

    def _problem(self, advance: Advance, sizes: tuple[float, float], step: float) -> StepFailure | None:
        system = self._system
        if not (math.isfinite(sum(sizes)) and within(system.journals, BEYOND_ALL_BOUNDS)):
            journals = np.where(np.abs(system.journals) < BEYOND_ALL_BOUNDS, system.journals, np.nan)
            motion = np.column_stack([journals, system.forces])
            return NotFinite(
                "the motion of the journal is not finite after the step",
                self._name(np.count_nonzero(~np.isfinite(motion), axis=1)),
            )
        if self._tolerance is not None and max(sizes) > self._tolerance:
            worst = advance.defect if sizes[0] >= sizes[1] else advance.of_length
            assert worst is not None
            return ToleranceMissed(
                f"relative defect {sizes[0]:.3g}, and {sizes[1]:.3g} from the length of the step, "
                f"{step:.3g} s; allowed is {self._tolerance:.3g}",
                self._name(np.max(np.abs(worst) / system.scale(), axis=1)),
            )
        return None

    def _name(self, badness: ArrayLike) -> str:
        """Name of the bearing of the largest value."""
        return self._system.bearings[int(np.argmax(badness))].name

    def _count(self, advance: Advance, step: float, sizes: tuple[float, float]) -> None:
        counts = self.counts
        counts.accepted += 1
        counts.iterations += advance.iterations
        counts.shortest = min(counts.shortest, step)
        defect = sizes[0] if advance.errors is None else advance.errors.largest
        counts.largest_relative_defect = max(counts.largest_relative_defect, defect)
        counts.largest_relative_error = max(counts.largest_relative_error, *sizes)
