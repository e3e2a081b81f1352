"""Bores as a train file gives them: a word and a few figures, or arcs; and grooves.

The words stand for lobes of equal length that fill the turn, into which grooves are cut.  With no grooves
given lobes have one of 20 deg at each of their ends, as they must be fed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from pydantic_core import PydanticCustomError

from fmus.port.bore import PLAIN, Arc, Bore, check, from_text, grooved, lobes, to_text
from rotor_fmu.train.units import in_si
from rotor_fmu.train.wording import choice

WORDS = {
    "lemon": (2, 0.5),
    "two-lobe": (2, 0.5),
    "offset-halves": (2, 1.0),
    "three-lobe": (3, 0.5),
    "four-lobe": (4, 0.5),
}
"""Number of lobes of a word, and where they come closest, as the share of their length, by default."""

KEYS = frozenset(("preload", "offset", "first", "grooves", "arcs"))
"""What a bearing of a train file says of its bore beside the word."""

_WIDTH = math.radians(20.0)
_GROOVE = {"at": None, "width": _WIDTH}
_ARC = {"start": None, "end": None, "preload": 0.0, "towards": math.nan}
_ANGLES = ("at", "width", "start", "end", "towards")

Rows = tuple[tuple[float, ...], ...]


def groove_rows(value: Any) -> Rows | None:
    """Middle and width of each groove in rad, of ``[{at = "0 deg", width = "20 deg"}, ...]``."""
    return _rows(value, _GROOVE)


def arc_rows(value: Any) -> Rows | None:
    """Arcs of ``[{start = "10 deg", end = "170 deg", preload = 0.5, towards = "90 deg"}, ...]``."""
    return _rows(value, _ARC)


def _rows(value: Any, keys: dict[str, float | None]) -> Rows | None:
    """Numbers of a list of tables, angles in rad.

    Raises
    ------
    PydanticCustomError
        Saying what is allowed.
    """
    if value is None:
        return None
    shape = f"a list of tables with {', '.join(keys)}"
    if not isinstance(value, list | tuple) or not all(isinstance(row, dict) for row in value):
        raise PydanticCustomError("bore", "{shape}", {"shape": shape})
    rows = []
    for row in value:
        wrong = [key for key in (*row, *keys) if key not in keys or (key not in row and keys[key] is None)]
        if wrong:
            raise PydanticCustomError("bore", "{shape}", {"shape": f"{shape}; look at {wrong[0]}"})
        rows.append(tuple(_number(key, row.get(key, keys[key])) for key in keys))
    return tuple(rows)


def _number(key: str, value: Any) -> float:
    if key in _ANGLES and isinstance(value, str):
        try:
            value = in_si(value, "rad")
        except ValueError as error:
            raise PydanticCustomError("bore", "{text}", {"text": f"for {key} {error}"}) from None
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise PydanticCustomError("bore", "{text}", {"text": f"a number for {key}"})
    return float(value)


def bore_text(
    word: str, preload: float, offset: float | None, first: float, grooves: Rows | None, arcs: Rows | None
) -> str:
    """Text of a bore for the unit, see `fmus.port.bore.from_text`.

    Parameters
    ----------
    word : str
        "plain", one of `WORDS`, or such a text.
    preload, offset, first
        See `fmus.port.bore.lobes`; None: as usual for the word.
    grooves, arcs
        From `groove_rows` and `arc_rows`; None where not given.

    Raises
    ------
    ValueError
        Key, value and what is allowed.
    """
    bore: Bore
    if arcs is not None:
        if word != PLAIN:
            raise ValueError(f"bore = {word!r} beside arcs; allowed is one of them")
        bore = tuple(_arc(*row) for row in arcs)
    elif word in WORDS:
        count, usual = WORDS[word]
        if preload <= 0.0:
            raise ValueError(f"preload = {preload!r}; allowed for bore = {word!r} is more than 0, to 0.95")
        bore = lobes(count, preload, usual if offset is None else offset, first)
        if grooves is None:
            grooves = tuple((arc.start, _WIDTH) for arc in bore)
    elif word == PLAIN:
        bore = lobes(1, 0.0) if grooves else ()
    else:
        bore = _of_text(word)
    if preload != 0.0 and word not in WORDS:
        raise ValueError(f"preload = {preload!r}; allowed for bore = {word[:20]!r} is 0")
    return to_text(check(grooved(bore, [(at, width) for at, width in grooves or ()])))


def _arc(start: float, end: float, preload: float, towards: float) -> Arc:
    return Arc(start, end, preload, 0.5 * (start + end) if math.isnan(towards) else towards)


def _of_text(word: str) -> Bore:
    if word.lstrip().startswith("["):
        return from_text(word)
    raise ValueError(f"bore = {word!r}; {choice(word, (PLAIN, *WORDS))}, or arcs")


def leaning(bore: Sequence[Arc], angle: float) -> int:
    """Number of arcs that can push a journal against a load in this direction."""
    return sum(
        arc.covers(angle) or min(_apart(arc.start, angle), _apart(arc.end, angle)) < 0.5 * math.pi
        for arc in bore
    )


def _apart(one: float, other: float) -> float:
    return abs(math.remainder(one - other, 2.0 * math.pi))
