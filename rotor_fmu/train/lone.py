"""A bearing on its own: a TOML file with speed, load and the keys of one bearing, without a train."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from rotor_fmu.train.bore import KEYS
from rotor_fmu.train.checks import film_problems, speed_problems
from rotor_fmu.train.entry import Entry, angle, positive, within
from rotor_fmu.train.file import TrainFileError
from rotor_fmu.train.oil import CURVE
from rotor_fmu.train.schema import COEFFICIENTS, BearingEntry
from rotor_fmu.train.toml_source import Problem, TomlError, read_toml
from rotor_fmu.train.train import BearingSeat
from rotor_fmu.train.wording import explain


class LoneEntry(Entry):
    """The file: speed, load on the journal and its direction, the bearing, settings of its film."""

    speed: float = positive(1e4, "rad/s; 3000 rev/min are 314.16")
    load: float = within(-1e9, 1e9, "N")
    load_angle: float = angle(-0.5 * math.pi)
    bearing: BearingEntry
    film: dict[str, Any] = {}  # noqa: RUF012 (pydantic copies it)


@dataclass(frozen=True)
class LoneBearing:
    """A bearing, its speed [rad/s], its load [N] in a direction [rad], and the settings of its film."""

    seat: BearingSeat
    speed: float
    load: float
    load_angle: float
    film: dict[str, Any]


def load_bearing(path: Path) -> LoneBearing | None:
    """Read a bearing on its own; None where a file is of another kind.

    Raises
    ------
    TrainFileError
        With every problem found.
    """
    try:
        source = read_toml(path)
    except TomlError as error:
        raise TrainFileError([f"{path}: {error}"]) from None
    given = source.raw.get("bearing")
    if not isinstance(given, dict):
        return None
    raw = {**source.raw, "bearing": {"name": path.stem, "z": 0.0, **given}}
    problems: list[Problem] = []
    entry = None
    try:
        entry = LoneEntry.model_validate(raw)
    except ValidationError as error:
        problems += explain(error, raw, LoneEntry)
    else:
        problems += ((("bearing",), text) for text in film_problems(given))
        problems += speed_problems(entry.speed, entry.bearing.diameter or 0.0, entry.bearing.name)
    if entry is None or problems:
        raise TrainFileError([f"{path}: {text}" for text in source.located(problems)])
    bearing = entry.bearing
    kept = bearing.model_dump(exclude={"z", *COEFFICIENTS, *KEYS, *CURVE})
    seat = BearingSeat(**{**kept, "node": 0, "bore": bearing.bore_text, "pedestal": None, **bearing.in_seat})
    return LoneBearing(seat, entry.speed, entry.load, entry.load_angle, entry.film)
