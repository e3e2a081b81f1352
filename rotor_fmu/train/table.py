"""Tables as spreadsheets write them: byte order marks, empty rows, ``;``, decimal commas, units."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from rotor_fmu.train.toml_source import LARGEST
from rotor_fmu.train.units import in_si
from rotor_fmu.train.wording import choice

Row = tuple[int, dict[str, float | str]]
"""Number of its line in the file, and what it holds by column; empty cells are left out."""

_SEPARATORS = ";\t,"
_HEADER = re.compile(r"\s*(.*?)\s*(?:[\[(]\s*(.*?)\s*[\])])?\s*")
_COMMA = re.compile(r"[-+]?\d*,\d+(?:[eE][-+]?\d+)?(?:\s.*)?")
_POINT = re.compile(r"[-+]?\d*\.\d+(?:[eE][-+]?\d+)?(?:\s.*)?")


class TableError(ValueError):
    """A table that cannot be read; says where, what is there and what is allowed."""


@dataclass(frozen=True)
class _Column:
    name: str
    unit: str
    """As its header says it; empty for SI."""


def read_table(
    path: Path, columns: Mapping[str, str], required: Sequence[str]
) -> tuple[list[Row], list[str]]:
    """Read a table with a header.

    The separator is the one of comma, semicolon and tabulator that the header has most of.  Columns may stand
    in any order; a header may say a unit in brackets, ``outer diameter [mm]``.  Rows that begin with # are
    comments, and so is a column named remark.

    Parameters
    ----------
    path : Path
        The file.
    columns : mapping
        SI unit by the name of each column that there may be; empty for texts.
    required : sequence of str
        Columns that must be there.

    Returns
    -------
    rows, problems : list
        The rows that can be read, and a line for each that cannot.

    Raises
    ------
    TableError
        When the file or its header cannot be read.
    """
    read = [line for line in _cells(_text(path)) if any(line[1])]
    content = [(n, cells) for n, cells, _ in read]
    if not content:
        raise TableError(f"no header; needed is a row with {', '.join(required)}")
    header = _header(content[0][1], columns, required)
    rows: list[Row] = []
    problems: list[str] = []
    commas = read[0][2] != "," and _decimal_comma(content[1:], header, columns)
    for number, cells in content[1:]:
        found, wrong = _row(cells, header, columns, commas)
        problems += (f"row {number}: {text}" for text in wrong)
        if not wrong:
            rows.append((number, found))
    return rows, problems


def _text(path: Path) -> str:
    try:
        if path.exists() and not path.is_file():  # a device or a pipe, which has no end
            raise TableError("not readable: no file")
        if path.is_file() and (size := path.stat().st_size) > LARGEST:
            raise TableError(f"not readable: {size} bytes, allowed are {LARGEST}")
        data = path.read_bytes()
    except (ValueError, OSError) as error:
        raise error if isinstance(error, TableError) else TableError(f"not readable: {error}") from None
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        raise TableError(f"not readable: {error}; save it as CSV UTF-8") from None


def _cells(text: str) -> Iterator[tuple[int, list[str], str]]:
    """Yield number, cells and separator of each line that is no comment; the first decides on that."""
    separator = ""
    for number, line in enumerate(text.replace("\r\n", "\n").replace("\r", "\n").split("\n"), 1):
        if not line.strip() or line.lstrip(' "').startswith("#"):
            continue
        told = re.fullmatch(r'"?sep=(.)"?[;,\t]*', line.strip(" "))
        separator = separator or (told[1] if told else max(_SEPARATORS, key=line.count))
        if told:
            continue
        try:
            cells = next(csv.reader([line], delimiter=separator), [])
        except csv.Error:
            cells = [line]
        yield number, [cell.strip() for cell in cells], separator


def _header(cells: Sequence[str], columns: Mapping[str, str], required: Sequence[str]) -> list[_Column]:
    header = []
    for cell in cells:
        found = _HEADER.fullmatch(cell)
        assert found is not None
        name = re.sub(r"[\s\-_]+", "_", found[1]).casefold()
        header.append(_Column(name, found[2] or ""))
        if name and name != "remark" and name not in columns:
            head, _, unit = cell.strip().rpartition(" ")
            if re.sub(r"[\s\-_]+", "_", head).casefold() in columns:
                raise TableError(
                    f"header: column {cell!r}; did you mean '{head} [{unit}]'? A unit has brackets"
                )
            raise TableError(f"header: column {cell!r}; {choice(name, [*columns, 'remark'])}")
        if found[2] and name in columns:
            if not columns[name]:
                raise TableError(f"header: column {cell!r}; allowed is {name} without a unit")
            try:
                in_si(f"1 {found[2]}", columns[name])
            except ValueError as error:
                raise TableError(f"header: column {cell!r}; allowed is {error}") from None
    names = [column.name for column in header if column.name]
    if twice := [name for name in dict.fromkeys(names) if names.count(name) > 1 and name != "remark"]:
        raise TableError(f"header: column {twice[0]!r} occurs twice; allowed is once")
    if missing := [name for name in required if name not in names]:
        allowed = ", ".join([*columns, "remark"])
        raise TableError(f"header {','.join(cells)!r}; missing {', '.join(missing)}; allowed are {allowed}")
    return header


def _decimal_comma(
    content: Sequence[tuple[int, Sequence[str]]], header: Sequence[_Column], columns: Mapping[str, str]
) -> bool:
    """Whether numbers have decimal commas: some have, and none has a decimal point."""
    numbers = [
        cell
        for _, cells in content
        for cell, column in zip(cells, header, strict=False)
        if columns.get(column.name)
    ]
    return any(map(_COMMA.fullmatch, numbers)) and not any(map(_POINT.fullmatch, numbers))


def _row(
    cells: Sequence[str], header: Sequence[_Column], columns: Mapping[str, str], commas: bool
) -> tuple[dict[str, float | str], list[str]]:
    """What a row holds, and what is wrong with it."""
    if len(cells) < len(header) and any(column.name for column in header[len(cells) :]):
        named = sum(bool(column.name) for column in header)
        return {}, [f"{len(cells)} values; allowed are {named}"]
    if any(cell for cell in cells[len(header) :]):
        return {}, [f"{len(cells)} values; allowed are {len(header)}"]
    found: dict[str, float | str] = {}
    wrong: list[str] = []
    for place, (cell, column) in enumerate(zip(cells, header, strict=False), 1):
        if not cell or column.name == "remark":
            continue
        if not column.name:
            wrong.append(f"value {cell!r} in column {place}; allowed is none, for the column has no header")
            continue
        unit = columns[column.name]
        found[column.name] = _number(cell, column.unit, unit, commas) if unit else cell
    return found, wrong


def _number(cell: str, unit: str, si: str, commas: bool) -> float | str:
    """The number in SI; what is none stays as it is, for the check of the value to refuse."""
    text = cell.replace(",", ".", 1) if commas else cell
    try:
        number = float(text)
    except ValueError:
        return text
    try:
        return in_si(f"{text} {unit}", si) if unit else number
    except ValueError:
        return number  # nan and inf
