"""TOML text that knows on which line each of its keys stands, so that a problem can say where it is."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

Location = tuple[str | int, ...]
"""Keys and indices that lead to a value, outermost first."""

Problem = tuple[Location, str]
"""What is wrong and where; the location may end in a key that is missing."""

LARGEST = 1_000_000
"""Bytes of a file that is still read; ours have some thousands."""

LOCATED = 100
"""Problems of a file whose lines are looked for, which takes some ten parses each."""


class TomlError(ValueError):
    """Text that is no TOML; says on which line."""


class TomlSource:
    """A parsed TOML text.

    Parameters
    ----------
    text : str
        The TOML.

    Attributes
    ----------
    raw : dict
        What it says.

    Raises
    ------
    TomlError
        When it is no TOML.
    """

    def __init__(self, text: str) -> None:
        self._lines = text.replace("\r\n", "\n").split("\n")
        try:
            self.raw: dict[str, Any] = tomllib.loads(text)
        except RecursionError:
            raise TomlError("not TOML: nested too deeply") from None
        except ValueError as error:
            raise TomlError(f"not TOML: {error}") from None

    def line(self, location: Location) -> int | None:
        """Line, from 1 on, where the value at a location begins; of a missing one, that of what holds it.

        Neither tomllib nor tomlkit keeps the places of what it has read. So the parser itself is asked: the
        line is the first whose text up to there has the value. So every way to write TOML counts, and lines
        inside of a long value are passed over.
        """
        while location and not _holds(self.raw, location):
            location = location[:-1]
        if not location:
            return None
        low, high = 0, len(self._lines)  # the value begins behind line `low`, at `high` at the latest
        while high - low > 1:
            middle = probe = (low + high) // 2
            while probe < high and (data := self._upto(probe)) is None:
                probe += 1
            # Lines from the middle on that only parse together are one value, which begins before it.
            if probe == high or _holds(data, location):
                high = middle
            else:
                low = probe
        return high

    def located(self, problems: Iterable[Problem]) -> Iterator[str]:
        """Yield the texts of problems, the first `LOCATED` of them with the number of their line in front."""
        for count, (location, text) in enumerate(problems):
            line = self.line(location) if count < LOCATED else None
            yield text if line is None else f"line {line}: {text}"

    def _upto(self, line: int) -> Mapping[str, Any] | None:
        try:
            return tomllib.loads("\n".join(self._lines[:line]) + "\n")
        except ValueError:
            return None


def read_toml(path: Path) -> TomlSource:
    """Read a TOML file.

    Raises
    ------
    TomlError
        When it cannot be read, is too large, or is no TOML.
    """
    try:
        size = path.stat().st_size
        if not path.is_file() or size > LARGEST:
            kind = f"{size} bytes, allowed are {LARGEST}" if path.is_file() else "no file"
            raise TomlError(f"not readable: {kind}")
        return TomlSource(path.read_text(encoding="utf-8-sig"))
    except UnicodeDecodeError as error:
        raise TomlError(f"not TOML: {error}") from None
    except OSError as error:
        raise TomlError(f"not readable: {error.strerror or error}") from None


def _holds(data: Any, location: Sequence[Any]) -> bool:
    for step in location:
        kind = dict if isinstance(step, str) else list
        if not isinstance(data, kind) or not (step in data if kind is dict else step < len(data)):
            return False
        data = data[step]
    return True
