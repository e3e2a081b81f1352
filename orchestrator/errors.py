"""What can be wrong before a run starts; a run that has started ends with an `Outcome` instead."""

from __future__ import annotations


class OrchestratorError(Exception):
    """An error whose text is meant for the user as it stands: no traceback is needed."""


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


class Terminated(KeyboardInterrupt):
    """The process was told to end by SIGTERM; it ends as after Ctrl-C, with a status of its own."""


class EquilibriumError(OrchestratorError):
    """No static equilibrium of the train on its films; the text names the bearing and the residual."""
