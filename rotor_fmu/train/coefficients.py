"""Stiffness and damping of a bearing as a train file gives them: numbers, matrices, tables over speed.

Bearings of which only these are known need no bore; so do seals, and tilting pads from other programs.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from pydantic_core import PydanticCustomError

from fmus import port
from rotor_fmu.train.table import TableError, read_table

Matrix = tuple[float, ...]
"""Four rows of four, one behind the other."""

MATRIX = "a number for x and y alike, [xx, yy], or a matrix of 2x2 or 4x4 (x, y, tilt_x, tilt_y)"

_UNITS = {"K": ("N/m", "N/rad", "N", "N m/rad"), "C": ("N s/m", "N s/rad", "N s", "N m s/rad")}
"""Of forces by displacements and rotations, and of moments by these."""


def _columns() -> dict[str, tuple[int, str]]:
    """Place in a row of `fmus.port.coefficient_rows`, and unit, by the name of a column."""
    columns = {"speed": (0, "rad/s")}
    for first, letter in ((1, "K"), (17, "C")):
        for row in range(4):
            for column in range(4):
                place = first + 4 * row + column, _UNITS[letter][2 * (row > 1) + (column > 1)]
                columns[f"{letter}{row + 1}{column + 1}".casefold()] = place
                if row < 2 and column < 2:
                    columns[f"{letter}{'xy'[row]}{'xy'[column]}".casefold()] = place
    return columns


_COLUMNS = _columns()


def matrix(value: Any) -> Matrix:
    """A 4x4 matrix, row by row, of what a train file may give for one.

    Raises
    ------
    PydanticCustomError
        Saying what is allowed.
    """
    if isinstance(value, int | float) and not isinstance(value, bool):
        value = [value, value]
    rows = value if isinstance(value, list | tuple) else []
    if len(rows) == 2 and not any(isinstance(row, list | tuple) for row in rows):
        rows = [[rows[0], 0.0], [0.0, rows[1]]]
    size = len(rows)
    if size not in (2, 4) or any(not isinstance(row, list | tuple) or len(row) != size for row in rows):
        raise PydanticCustomError("matrix", MATRIX)
    full = [0.0] * 16
    for i, row in enumerate(rows):
        for j, number in enumerate(row):
            if isinstance(number, bool) or not isinstance(number, int | float) or not math.isfinite(number):
                raise PydanticCustomError("matrix", MATRIX)
            full[4 * i + j] = float(number)
    return tuple(full)


def constant(stiffness: Matrix | None, damping: Matrix | None) -> str:
    """The text of `fmus.port.coefficient_rows` for the same coefficients at all speeds."""
    zero = (0.0,) * 16
    return port.coefficient_text([(0.0, *(stiffness or zero), *(damping or zero))])


def table_text(path: Path) -> str:
    """The text of `fmus.port.coefficient_rows` of a table over speed, see `rotor_fmu.train.table`.

    Its head names the columns: ``speed`` in rad/s, or with a unit, ``speed [rpm]``; ``Kxx, Kxy, Kyx, Kyy,
    Cxx, ...``, or ``K11`` to ``C44`` in the order x, y, tilt_x, tilt_y, in N/m and N s/m, or as ``Kxx
    [kN/mm]``.  What has no column is zero.

    Raises
    ------
    ValueError
        Naming the file, the row, and what is allowed.
    """
    try:
        found, problems = read_table(path, {name: unit for name, (_, unit) in _COLUMNS.items()}, ["speed"])
        if problems:
            raise TableError(problems[0])
        columns = {name for _, given in found for name in given} | {"speed"}
        text = port.coefficient_text(sorted(_row(number, given, columns) for number, given in found))
        port.coefficient_rows(text)
    except ValueError as error:
        raise ValueError(f"{path.name}: {error}") from None
    return text


def _row(number: int, given: Mapping[str, float | str], columns: Iterable[str]) -> list[float]:
    row = [0.0] * 33
    seen: dict[int, str] = {}
    for name in sorted(columns):
        (place, unit), value = _COLUMNS[name], given.get(name, "")
        if place in seen:
            raise TableError(f"columns {seen[place]!r} and {name!r} are the same; allowed is one of them")
        if isinstance(value, str) or not math.isfinite(value):
            raise TableError(f"row {number}: {name} = {value!r}; allowed is a number in {unit}")
        seen[place], row[place] = name, value
    return row
