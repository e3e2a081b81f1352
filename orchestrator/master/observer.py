"""What the time loop tells those who watch a run: record, energy ledger, checkpoints."""

from __future__ import annotations

from orchestrator.master.coupling import Advance
from orchestrator.master.stepping import Stepper


class Observer:
    """Watches a run, and by itself does nothing; all times are simulated times in s.

    The system that it watches is given to it where it is made.
    """

    def begin(self, stepper: Stepper) -> None:
        """Take the start of a run, the end of macro step 0; not told to a run that goes on."""

    def watch(self, start: float, end: float, advance: Advance) -> None:
        """Take the end of an accepted step with what the coupling said of it."""

    def record(self, step: int, time: float, stepper: Stepper) -> None:
        """Take the end of a macro step of this number."""

    def stop(self, step: int | None, time: float, stepper: Stepper) -> None:
        """Take where a run stops before its end: behind a macro step, or None where it is inside one."""
