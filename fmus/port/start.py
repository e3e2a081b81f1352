"""What the rotor's outputs follow at the start: its start parameters, and which of them where."""

from __future__ import annotations

from fmus.port.connector import POSITION, SPEED

START_PARTS = (
    ("", "static"),
    ("_cos", "1X orbit, part with cos(speed t):"),
    ("_sin", "1X orbit, part with sin(speed t):"),
)
"""Ending of the names of the start parameters of a journal, and their text."""

ORBIT_FOLLOWS = (SPEED, "start.from_law", "start.orbit")
"""What each journal follows besides its own start parameters."""


def start_names(bearing: int, position: str) -> tuple[str, ...]:
    """Names of the start parameters of one position of a journal; bearings count from 1."""
    return tuple(f"bearing[{bearing}].start.{position}{part}" for part, _ in START_PARTS)


def shape_follows(bearings: int, wheels: int) -> tuple[str, ...]:
    """Names of what the whole shaft follows: it hangs between its journals and whirls by its unbalance."""
    journals = (name for i in range(1, bearings + 1) for q in POSITION for name in start_names(i, q))
    unbalance = (
        f"wheel[{j}].{key}" for j in range(1, wheels + 1) for key in ("unbalance", "unbalance_phase")
    )
    return *ORBIT_FOLLOWS, "gravity", "reduction", *journals, *unbalance
