"""Errors whose text is meant for the user: each knows how a run ends for it, and so the exit status."""

from __future__ import annotations

from orchestrator.outcome import INPUT_ERROR, Outcome


class OrchestratorError(Exception):
    """An error whose text is meant for the user as it stands: no traceback is needed.

    Attributes
    ----------
    outcome : Outcome or None
        How a run ends for it; None where the input is wrong and no run starts.
    unit : str
        The unit, or the bearing, that it is about; empty where that is none or unknown.
    """

    outcome: Outcome | None = None
    unit: str = ""

    @property
    def exit_status(self) -> int:
        """Exit status of the command."""
        return INPUT_ERROR if self.outcome is None else self.outcome.status

    @property
    def text(self) -> str:
        """What went wrong, and what helps."""
        return str(self) if self.outcome is None else f"{self}. {self.outcome.advice}"


class ScenarioError(OrchestratorError):
    """A scenario that cannot be run.

    Parameters
    ----------
    source : str
        File name of the scenario.
    problems : list of str
        One line each: key, value, what is allowed.
    """

    def __init__(self, source: str, problems: list[str]) -> None:
        self.source = source
        self.problems = tuple(problems)
        super().__init__("\n".join(f"{source}: {problem}" for problem in problems))


class FmuError(OrchestratorError):
    """An FMU file that is missing, unreadable, or cannot be instantiated."""


class PortError(OrchestratorError):
    """A unit that lacks variables of the port, or declares them differently."""


class NotWrittenError(OrchestratorError):
    """Results that could not be written; the text names folder, reason, needed and free room."""

    outcome = Outcome.NOT_WRITTEN


class EquilibriumError(OrchestratorError):
    """No static equilibrium of the train on its films; the text names the bearing and the residual."""

    outcome = Outcome.NO_EQUILIBRIUM


class Terminated(KeyboardInterrupt):
    """The process was told to end by SIGTERM or SIGHUP; it ends as after Ctrl-C, with a status of its own."""


def outcome_of(stop: KeyboardInterrupt) -> Outcome:
    """Return how a run ends that a signal stopped."""
    return Outcome.TERMINATED if isinstance(stop, Terminated) else Outcome.INTERRUPTED
