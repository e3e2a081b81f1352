"""Exit statuses of the command: 0 only for a finished, valid run."""

from __future__ import annotations

from orchestrator.outcome import Outcome

INPUT_ERROR = 2
"""Something given is wrong: option, scenario, train, FMU, folder.  Nothing was simulated or written."""

STATUS = {
    Outcome.FINISHED: 0,
    Outcome.NO_EQUILIBRIUM: 3,
    Outcome.STEP_REFUSED: 4,
    Outcome.UNIT_FAILED: 5,
    Outcome.NOT_FINITE: 6,
    Outcome.TOLERANCE_MISSED: 9,
    Outcome.UNRESOLVED: 10,
    Outcome.FILM_FAILED: 11,
    Outcome.UNIT_HUNG: 12,
    Outcome.NOT_WRITTEN: 13,
    Outcome.INTERRUPTED: 130,
    Outcome.TERMINATED: 143,
}
"""Exit status of each outcome; 130 and 143 are what shells give for SIGINT and SIGTERM."""

PROCESS_DIED = 8
"""A run's own process ended without a result; its exit code or signal is said."""

OTHER_OUTCOME = 7
"""For an outcome without a status of its own."""


def of_outcome(outcome: Outcome) -> int:
    """Exit status for the outcome of a run."""
    return STATUS.get(outcome, OTHER_OUTCOME)


def outcome_table() -> str:
    """Return all outcomes as a table in Markdown: value, exit status, advice."""
    rows = [f"| `{outcome.value}` | {of_outcome(outcome)} | {outcome.advice} |" for outcome in Outcome]
    return "\n".join(["| outcome | exit status | what it means, and what helps |", "|---|---|---|", *rows])


def status_lines() -> str:
    """Return all exit statuses in two columns, for the help of a command."""
    others = {1: "internal or file error", INPUT_ERROR: "wrong input, no run", PROCESS_DIED: "process died"}
    words = others | {status: outcome.value for outcome, status in STATUS.items()}
    cells = [f"{status:<3}  {words[status]:<22}" for status in sorted(words)]
    half = (len(cells) + 1) // 2
    return "\n".join(
        f"  {left}  {right}".rstrip() for left, right in zip(cells[:half], [*cells[half:], ""], strict=False)
    )
