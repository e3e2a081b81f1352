"""How a run can end, and what to do about it."""

from __future__ import annotations

from enum import Enum


class Outcome(Enum):
    """The end of a run: but for `FINISHED` and `UNRESOLVED` the record stops early.

    Attributes
    ----------
    value : str
        Stable name, written to the record's attribute ``status``.
    advice : str
        One sentence: what it means and what helps.
    """

    advice: str

    FINISHED = ("finished", "The run reached its end time.")
    NO_EQUILIBRIUM = (
        "no-equilibrium",
        "No static equilibrium was found; check the loads against viscosity, clearance and speed, "
        "or start with a shallower depth.",
    )
    STEP_REFUSED = (
        "step-refused",
        "A unit could not carry out a step; the message names it and its state. A smaller step or the "
        "coupling linear-implicit usually helps.",
    )
    FILM_FAILED = (
        "film-failed",
        "The journal of a bearing went where its film has no solution; the message gives its state. Check "
        "unbalance, clearance, viscosity and solid contact there, or take a smaller step.",
    )
    UNIT_HUNG = (
        "unit-hung",
        "A unit did not come back from a call within its budget of time and was given up; the message names "
        "it. Another depth at that bearing, or a larger budget if the unit is merely slow.",
    )
    UNIT_FAILED = (
        "unit-failed",
        "A unit ended with an error that it cannot recover from; the message holds what it logged.",
    )
    TOLERANCE_MISSED = (
        "tolerance-missed",
        "A step did not meet the tolerance even at a thousandth of its length; a coarser tolerance or the "
        "coupling newton helps, or there is a jump in a unit.",
    )
    UNRESOLVED = (
        "unresolved",
        "The run reached its end, but the exchange of rotor and bearings was not resolved and its numbers "
        "mean nothing; take a smaller step or the coupling linear-implicit.",
    )
    NOT_FINITE = (
        "not-finite",
        "The coupled motion grew without bound; take a smaller step or the coupling linear-implicit.",
    )
    NOT_WRITTEN = (
        "not-written",
        "The results could not be written: disk full, or a folder that is read-only. Make room, or name "
        "another folder with --out, and run again.",
    )
    INTERRUPTED = ("interrupted", "The run was stopped by the user; the record holds what was simulated.")
    TERMINATED = (
        "terminated",
        "The process was told to end (SIGTERM); the record holds what was simulated, and a run with "
        "checkpoints can be resumed.",
    )

    def __new__(cls, value: str, advice: str) -> Outcome:
        """Make the first item the value, the second the advice."""
        member = object.__new__(cls)
        member._value_ = value
        member.advice = advice
        return member

    @property
    def ok(self) -> bool:
        """Whether the run is finished and its record complete."""
        return self is Outcome.FINISHED
