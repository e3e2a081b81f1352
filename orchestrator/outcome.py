"""How a run can end: its name, the exit status of the command, and what to do about it."""

from __future__ import annotations

from enum import Enum

INPUT_ERROR = 2
"""Exit status where something given is wrong: option, scenario, train, FMU, folder. Nothing was simulated."""

PROCESS_DIED = 8
"""Exit status where a run's own process ended without a result; its exit code or signal is said."""


class Outcome(Enum):
    """The end of a run: the record is whole for `FINISHED`, `UNRESOLVED`, `BEYOND_MODEL` and `UNSTABLE` only.

    Attributes
    ----------
    value : str
        Stable name, written to the record's attribute ``status``.
    status : int
        Exit status of the command, 0 only for a finished, valid run; 130 and 143 are what shells give for
        SIGINT and SIGTERM.
    advice : str
        One sentence: what it means and what helps.
    """

    status: int
    advice: str

    FINISHED = ("finished", 0, "The run reached its end time.")
    NO_EQUILIBRIUM = (
        "no-equilibrium",
        3,
        "No static equilibrium was found; check the loads against viscosity, clearance and speed, "
        "or start with a shallower depth.",
    )
    STEP_REFUSED = (
        "step-refused",
        4,
        "A unit could not carry out a step; the message names it and its state. A smaller step or the "
        "coupling linear-implicit usually helps.",
    )
    FILM_FAILED = (
        "film-failed",
        11,
        "The journal of a bearing went where its film has no solution; the message gives its state. Check "
        "unbalance, clearance, viscosity and solid contact there, or take a smaller step.",
    )
    UNIT_HUNG = (
        "unit-hung",
        12,
        "A unit did not come back from a call within its budget of time and was given up; the message names "
        "it. Another depth at that bearing, or a larger budget if the unit is merely slow.",
    )
    UNIT_FAILED = (
        "unit-failed",
        5,
        "A unit ended with an error that it cannot recover from; the message holds what it logged.",
    )
    TOLERANCE_MISSED = (
        "tolerance-missed",
        9,
        "A step did not meet the tolerance even at a thousandth of its length; a coarser tolerance or the "
        "coupling newton helps, or there is a jump in a unit.",
    )
    UNRESOLVED = (
        "unresolved",
        10,
        "The run reached its end, but its steps did not resolve the motion: forces may be off by more than a "
        "tenth. Take a smaller step, a smaller tolerance, or the coupling linear-implicit.",
    )
    BEYOND_MODEL = (
        "beyond-model",
        15,
        "The run reached its end, but the train left what its model describes; the message says when and "
        "what. Later numbers are of no real machine: check unbalance and units.",
    )
    UNSTABLE = (
        "unstable",
        14,
        "The train is unstable: its whirl grew by itself before any event, and there is no steady state. "
        "Change speed, load, clearance, viscosity or bearing; bladeloss stability shows the threshold.",
    )
    NOT_FINITE = (
        "not-finite",
        6,
        "The coupled motion grew without bound; take a smaller step or the coupling linear-implicit.",
    )
    NOT_WRITTEN = (
        "not-written",
        13,
        "The results could not be written: disk full, or a folder that is read-only. Make room, or name "
        "another folder with --out, and run again.",
    )
    INTERRUPTED = (
        "interrupted",
        130,
        "The run was stopped by the user; the record holds what was simulated.",
    )
    TERMINATED = (
        "terminated",
        143,
        "The process was told to end (SIGTERM, SIGHUP); the record holds what was simulated, and a run with "
        "checkpoints can be resumed.",
    )

    def __new__(cls, value: str, status: int, advice: str) -> Outcome:
        """Make the first item the value, the others attributes."""
        member = object.__new__(cls)
        member._value_ = value
        member.status, member.advice = status, advice
        return member

    @property
    def ok(self) -> bool:
        """Whether the run is finished and its record complete."""
        return self is Outcome.FINISHED


def outcome_table() -> str:
    """Return all outcomes as a table in Markdown: value, exit status, advice."""
    rows = [f"| `{outcome.value}` | {outcome.status} | {outcome.advice} |" for outcome in Outcome]
    return "\n".join(["| outcome | exit status | what it means, and what helps |", "|---|---|---|", *rows])


def status_lines() -> str:
    """Return all exit statuses in two columns, for the help of a command."""
    words = {1: "internal or file error", INPUT_ERROR: "wrong input, no run", PROCESS_DIED: "process died"}
    words |= {outcome.status: outcome.value for outcome in Outcome}
    cells = [f"{status:<3}  {words[status]:<22}" for status in sorted(words)]
    half = (len(cells) + 1) // 2
    return "\n".join(
        f"  {left}  {right}".rstrip() for left, right in zip(cells[:half], [*cells[half:], ""], strict=False)
    )
