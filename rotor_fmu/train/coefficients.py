"""Stiffness and damping of a bearing as a train file gives them: numbers, matrices, tables over speed.

Bearings of which only these are known need no bore; so do seals, and tilting pads from other programs.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from pydantic_core import PydanticCustomError

from fmus import port

Matrix = tuple[float, ...]
"""Four rows of four, one behind the other."""

MATRIX = "a number for x and y alike, [xx, yy], or a matrix of 2x2 or 4x4 (x, y, tilt_x, tilt_y)"

_SPEED = {"rad/s": 1.0, "rpm": math.pi / 30.0, "1/min": math.pi / 30.0, "hz": 2.0 * math.pi}
_PER_LENGTH = {"n{}/m": 1.0, "n{}/mm": 1e3, "kn{}/m": 1e3, "kn{}/mm": 1e6, "mn{}/m": 1e6}
_FACTORS = {"K": {k.format(""): x for k, x in _PER_LENGTH.items()}}
_FACTORS["C"] = {k.format("s"): x for k, x in _PER_LENGTH.items()}
_COLUMN = re.compile(r"(?P<name>[A-Za-z]+[0-9]*)\s*(?:\[(?P<unit>[^\]]*)\])?")
_PLACES = {
    letter + first + second: (letter, 4 * "xy".index(first) + "xy".index(second))
    for letter in "KC"
    for first in "xy"
    for second in "xy"
} | {f"{letter}{k // 4 + 1}{k % 4 + 1}": (letter, k) for letter in "KC" for k in range(16)}


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
    """The text of `fmus.port.coefficient_rows` of a table over speed.

    Its head names the columns: ``speed`` in rad/s, or with a unit, ``speed [rpm]``; ``Kxx, Kxy, Kyx, Kyy,
    Cxx, ...``, or ``K11`` to ``C44`` in the order x, y, tilt_x, tilt_y, in N/m and N s/m, or as ``Kxx
    [kN/mm]``.  What has no column is zero.

    Raises
    ------
    ValueError
        Naming the file, the row, and what is allowed.
    """
    try:
        lines = list(csv.reader(path.read_text(encoding="utf-8-sig").splitlines()))
    except (OSError, ValueError, csv.Error) as error:
        raise ValueError(f"{path.name}: not readable: {error}") from None
    numbered = [(n, [c.strip() for c in line]) for n, line in enumerate(lines, 1)]
    content = [(n, cells) for n, cells in numbered if any(cells) and not cells[0].startswith("#")]
    if len(content) < 2:
        raise ValueError(f"{path.name}: a head and at least one row are needed")
    columns = list(_columns(path.name, content[0][1]))
    rows = []
    for number, cells in content[1:]:
        row = [0.0] * 33
        try:
            for (place, factor), cell in zip(columns, cells, strict=True):
                row[place] = factor * float(cell)
        except ValueError:
            wanted = f"{len(columns)} numbers"
            raise ValueError(
                f"{path.name}: row {number}: {','.join(cells)!r}; allowed are {wanted}"
            ) from None
        rows.append(row)
    text = port.coefficient_text(sorted(rows))
    try:
        port.coefficient_rows(text)
    except ValueError as error:
        raise ValueError(f"{path.name}: {error}") from None
    return text


def _columns(file: str, head: list[str]) -> Iterator[tuple[int, float]]:
    """Place in a row and factor of each column."""
    seen = set()
    for cell in head:
        found = _COLUMN.fullmatch(cell)
        name, unit = (found["name"], found["unit"]) if found else (cell, None)
        known = name.lower() == "speed" or name in _PLACES
        if not known or name in seen:
            word = "occurs twice" if known else "is no column"
            raise ValueError(f"{file}: {name!r} {word}; allowed are speed, Kxx to Cyy, or K11 to C44")
        seen.add(name)
        letter, k = ("", 0) if name.lower() == "speed" else _PLACES[name]
        place = 0 if not letter else 1 + k + (16 if letter == "C" else 0)
        factors = _FACTORS.get(letter, _SPEED)
        factor = 1.0 if unit is None else factors.get(re.sub(r"[\s.*]", "", unit).lower())
        if factor is None or (unit is not None and letter and (k % 4 > 1 or k > 7)):
            raise ValueError(
                f"{file}: unit [{unit}] of {name}; allowed are {', '.join(factors)}, or none for SI"
            )
        yield place, factor
    if "speed" not in {name.lower() for name in seen}:
        raise ValueError(f"{file}: no column 'speed'; it must be given, in rad/s or as speed [rpm]")
