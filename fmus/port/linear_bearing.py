"""Stiffness and damping of a linear bearing: its parameters, and their table over speed as text."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

from fmus.port.connector import (
    DAMPING_UNITS,
    KINEMATIC_TEXT,
    KINEMATIC_UNITS,
    POSITION,
    STIFFNESS_UNITS,
    VELOCITY,
    WRENCH,
    WRENCH_TEXT,
    WRENCH_UNITS,
)
from fmus.port.variable import Value, Variable

STIFFNESS = tuple(f"stiffness[{i},{j}]" for i in range(1, 5) for j in range(1, 5))
DAMPING = tuple(f"damping[{i},{j}]" for i in range(1, 5) for j in range(1, 5))
STATIC_WRENCH = tuple(f"static.{name}" for name in WRENCH)
STATIC_POSITION = tuple(f"position.{name}" for name in POSITION)
TABLE = "coefficients"

_NUMBERS = 1 + len(STIFFNESS) + len(DAMPING)
_USUAL = {"stiffness[1,1]": 1e9, "stiffness[2,2]": 1e9, "damping[1,1]": 1e6, "damping[2,2]": 1e6}


def _coefficients(names: Sequence[str], symbol: str, units: tuple[tuple[str, str], ...]) -> list[Variable]:
    rates = POSITION if symbol == "stiffness" else VELOCITY
    return [
        Variable(
            name,
            "parameter",
            units[(k // 4) // 2][(k % 4) // 2],
            f"{symbol} -d{WRENCH[k // 4]}/d{rates[k % 4]}",
            _USUAL.get(name, 0.0),
            nominal=1e9 if symbol == "stiffness" else 1e6,
        )
        for k, name in enumerate(names)
    ]


LINEAR_PARAMETERS: tuple[Variable, ...] = (
    *(
        Variable(name, "parameter", unit, f"static wrench on the rotor: {text}", 0.0, nominal=1e6)
        for name, unit, text in zip(STATIC_WRENCH, WRENCH_UNITS, WRENCH_TEXT, strict=True)
    ),
    *(
        Variable(name, "parameter", unit, f"where the static wrench acts: {text}", 0.0, nominal=1e-4)
        for name, unit, text in zip(STATIC_POSITION, KINEMATIC_UNITS[:4], KINEMATIC_TEXT[:4], strict=True)
    ),
    *_coefficients(STIFFNESS, "stiffness", STIFFNESS_UNITS),
    *_coefficients(DAMPING, "damping", DAMPING_UNITS),
    Variable(
        TABLE,
        "parameter",
        "",
        "stiffness and damping over speed in place of the above: rows divided by semicolons, each the speed "
        "in rad/s, 16 stiffnesses and 16 dampings row by row; empty for none",
        "",
        kind="String",
    ),
)
"""Parameters of a linear bearing behind those of every bearing."""


def coefficient_text(rows: Iterable[Sequence[float]]) -> str:
    """Write rows of speed, stiffness and damping as the text of `TABLE`; no digit is lost."""
    return "; ".join(" ".join(repr(float(x)) for x in row) for row in rows)


def coefficient_rows(text: str) -> tuple[tuple[float, ...], ...]:
    """Read the text of `TABLE`.

    Returns
    -------
    tuple of tuple of float
        Speed, 16 stiffnesses and 16 dampings a row, speeds ascending; none of an empty text.

    Raises
    ------
    ValueError
        Saying what is wrong.
    """
    if not text.strip():
        return ()
    rows = []
    for number, part in enumerate(text.split(";"), 1):
        try:
            row = tuple(float(word) for word in part.split())
        except ValueError as error:
            raise ValueError(f"{TABLE}: row {number}: {error}") from None
        if len(row) != _NUMBERS or not all(map(math.isfinite, row)):
            raise ValueError(f"{TABLE}: row {number} has {len(row)} numbers; allowed are {_NUMBERS}, finite")
        rows.append(row)
    if any(after[0] <= before[0] for before, after in pairwise(rows)):
        raise ValueError(f"{TABLE}: speeds must ascend")
    return tuple(rows)


def coefficient_values(text: str) -> dict[str, Value]:
    """The text of a table as values of `LINEAR_PARAMETERS`: numbers where there is but one row."""
    rows = coefficient_rows(text)
    if len(rows) != 1:
        return {TABLE: text}
    return {TABLE: "", **dict(zip((*STIFFNESS, *DAMPING), rows[0][1:], strict=True))}


def rows_of_values(values: Mapping[str, Value]) -> tuple[tuple[float, ...], ...]:
    """Rows that values of `LINEAR_PARAMETERS` stand for: those of the table, or one at no speed."""
    rows = coefficient_rows(str(values.get(TABLE, "")))
    return rows or ((0.0, *(float(values[name]) for name in (*STIFFNESS, *DAMPING))),)
