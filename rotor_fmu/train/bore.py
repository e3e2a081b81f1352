"""Bores as a train file gives them: a word and a few figures, or arcs; and grooves.

The words stand for lobes of equal length that fill the turn, into which grooves are cut.  With no grooves
given lobes have one of 20 deg at each of their ends, as they must be fed.  Tilting pads stand each in the
middle of its share of the turn.  Pockets are cut into what there is, deeper or fed or both.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Any

from pydantic import BeforeValidator, Field
from pydantic_core import PydanticCustomError

from fmus import port
from fmus.port.bore import (
    PLAIN,
    TURN,
    Arc,
    Bore,
    check,
    from_text,
    grooved,
    lobes,
    pocketed,
    tilting,
    to_text,
)
from rotor_fmu.train.entry import Entry, angle, positive, within
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

TILTING = "tilting-pads"
"""The word for a bore of tilting pads."""

_WIDTH = math.radians(20.0)
_GROOVE = {"at": None, "width": _WIDTH}
_ARC = {"start": None, "end": None, "preload": 0.0, "towards": math.nan}
_POCKET = {"at": None, "width": None, "share": None, "depth": 0.0, "fed": 0.0}
_ANGLES = ("at", "width", "start", "end", "towards")
_BETWEEN_PADS = math.radians(10.0)

Rows = tuple[tuple[float, ...], ...]


def groove_rows(value: Any) -> Rows | None:
    """Middle and width of each groove in rad, of ``[{at = "0 deg", width = "20 deg"}, ...]``."""
    return _rows(value, _GROOVE)


def arc_rows(value: Any) -> Rows | None:
    """Arcs of ``[{start = "10 deg", end = "170 deg", preload = 0.5, towards = "90 deg"}, ...]``."""
    return _rows(value, _ARC)


def pocket_rows(value: Any) -> Rows | None:
    """Pockets of ``[{at = "60 deg", width = "90 deg", share = 0.75, depth = "0.4 mm", fed = true}, ...]``."""
    return _rows(value, _POCKET)


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
    if key == "fed" and isinstance(value, bool):
        return float(value)
    unit = "rad" if key in _ANGLES else "m"
    if isinstance(value, str):
        try:
            value = in_si(value, unit)
        except ValueError as error:
            raise PydanticCustomError("bore", "{text}", {"text": f"for {key} {error}"}) from None
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise PydanticCustomError("bore", "{text}", {"text": f"a number for {key}"})
    return float(value)


class BoreKeys(Entry):
    """Keys of a `[[bearing]]` about its bore."""

    bore: str = PLAIN
    preload: float = within(0.0, 0.95, "", 0.0)
    offset: float | None = within(0.0, 1.0, "", None)
    first: float = angle(0.0)
    grooves: Annotated[Rows | None, BeforeValidator(groove_rows)] = None
    arcs: Annotated[Rows | None, BeforeValidator(arc_rows)] = None
    pads: int | None = Field(None, ge=2, le=port.MOST_PADS)
    pad_arc: float | None = within(0.1, 3.1, "rad; did you give degrees?", None)
    pivot_stiffness: float | None = positive(1e15, "N/m; did you give N/mm?", None)
    pockets: Annotated[Rows | None, BeforeValidator(pocket_rows)] = None

    def text(self, clearance: float) -> str:
        """Text of the bore for the unit, see `fmus.port.bore.from_text`; depths are over the clearance.

        Raises
        ------
        ValueError
            Key, value and what is allowed.
        """
        if self.bore == TILTING:
            return to_text(check(self._tilting()))
        for key in ("pads", "pad_arc", "pivot_stiffness"):
            if getattr(self, key) is not None:
                raise ValueError(f"{key}: allowed beside bore = {TILTING!r} only")
        bore = check(grooved(self._fixed(), [(at, width) for at, width in self._cut()]))
        if self.pockets:
            whole = bore or lobes(1, 0.0)
            cuts = [(at, width, share, d / clearance, bool(fed)) for at, width, share, d, fed in self.pockets]
            bore = check(pocketed(whole, cuts))
        return to_text(bore)

    def _cut(self) -> Rows:
        """Its grooves; those of lobes as usual where none are given."""
        if self.grooves is None and self.arcs is None and self.bore in WORDS:
            return tuple((arc.start, _WIDTH) for arc in self._fixed())
        return self.grooves or ()

    def _tilting(self) -> Bore:
        for key in ("grooves", "arcs", "pockets"):
            if getattr(self, key) is not None:
                raise ValueError(f"{key}: allowed beside bore = {TILTING!r} is none")
        count = self.pads or 4
        arc = TURN / count - _BETWEEN_PADS if self.pad_arc is None else self.pad_arc
        offset = 0.5 if self.offset is None else self.offset
        stiffness = self.pivot_stiffness
        return tilting(
            count, arc, self.preload, offset, self.first, 0.0 if stiffness is None else 1.0 / stiffness
        )

    def _fixed(self) -> Bore:
        """The arcs before grooves and pockets are cut."""
        word, preload = self.bore, self.preload
        if word in WORDS and self.arcs is None:
            count, usual = WORDS[word]
            if preload <= 0.0:
                text = "is more than 0, to 0.95"
                raise ValueError(f"preload = {preload!r}; allowed for bore = {word!r} {text}")
            return lobes(count, preload, usual if self.offset is None else self.offset, self.first)
        bore = _of_text(word) if word != PLAIN and word not in WORDS else ()
        if self.arcs is not None and word != PLAIN:
            raise ValueError(f"bore = {word[:20]!r} beside arcs; allowed is one of them")
        if preload != 0.0:
            raise ValueError(f"preload = {preload!r}; allowed for bore = {word[:20]!r} is 0")
        if self.arcs is not None:
            return tuple(_arc(*row) for row in self.arcs)
        return lobes(1, 0.0) if word == PLAIN and self.grooves else bore


KEYS = frozenset(BoreKeys.model_fields)
"""What a bearing of a train file says of its bore."""


def _arc(start: float, end: float, preload: float, towards: float) -> Arc:
    return Arc(start, end, preload, 0.5 * (start + end) if math.isnan(towards) else towards)


def _of_text(word: str) -> Bore:
    if word.lstrip().startswith("["):
        return from_text(word)
    raise ValueError(f"bore = {word!r}; {choice(word, (PLAIN, *WORDS, TILTING))}, or arcs")


def leaning(bore: Sequence[Arc], angle: float) -> int:
    """Number of arcs that can push a journal against a load in this direction."""
    return sum(
        arc.covers(angle) or min(_apart(arc.start, angle), _apart(arc.end, angle)) < 0.5 * math.pi
        for arc in bore
    )


def _apart(one: float, other: float) -> float:
    return abs(math.remainder(one - other, 2.0 * math.pi))
