"""The limits: what may stand in limits.toml, and where it is read from."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, get_args

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from orchestrator.errors import OrchestratorError
from orchestrator.scenario.file import train_folder
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.toml_source import TomlError, read_toml
from rotor_fmu.train.wording import choice

FILE = "limits.toml"
ATTRIBUTE = "limits"
"""Of a record: the limits that its machine was given."""
_USUAL = Path(__file__).parent / FILE
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
Row = Annotated[tuple[Positive, ...], Field(min_length=1, strict=False)]


class LimitsError(OrchestratorError):
    """A file of limits that cannot be used."""


class _Limit(BaseModel):
    """One limit: where it is from, and whether that was read."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)
    source: str
    read: bool = True


class ShaftVibration(_Limit):
    """Peak to peak of a journal against its bearing [m] at the angles of probes [rad], by speed [rad/s]."""

    probes: Annotated[tuple[float, ...], Field(min_length=1, strict=False)]
    speed: Row
    zone_ab: Row
    zone_bc: Row
    zone_cd: Row

    def at(self, speed: float) -> tuple[float, float, float]:
        """The bounds of the zones A to D at a speed."""
        ab, bc, cd = (
            float(np.interp(abs(speed), self.speed, zone))
            for zone in (self.zone_ab, self.zone_bc, self.zone_cd)
        )
        return ab, bc, cd


class LeastFilm(_Limit):
    """Least film [m] by diameter [m] and sliding speed [m/s]; one column more than there are speeds."""

    diameter: Row
    sliding: Row
    least: Annotated[tuple[Row, ...], Field(strict=False)]

    def at(self, diameter: float, sliding: float) -> float:
        """The least film of a shaft; of the largest where none is as large."""
        row = min(int(np.searchsorted(self.diameter, diameter)), len(self.diameter) - 1)
        return self.least[row][int(np.searchsorted(self.sliding, abs(sliding)))]


class SpecificLoad(_Limit):
    """Force over diameter times width [Pa], lasting and for a short time."""

    steady: Positive
    short: Positive


class LaminarFilm(_Limit):
    """Taylor's vortices, see `orchestrator.results.film_regime`."""


class LogDecrement(_Limit):
    """Least logarithmic decrement of a mode."""

    least: Positive


class Contact(_Limit):
    """Solid contact, which has no limit but none."""


class Wiped(_Limit):
    """Share of a bore in which the contact may reach the hardness of the softer metal."""

    largest: Annotated[float, Field(ge=0.0, le=1.0)]


class Stress(_Limit):
    """Largest nominal normal stress of the shaft [Pa]."""

    largest: Positive


class Limits(BaseModel):
    """All limits; what is None is not judged."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    shaft_vibration: ShaftVibration | None = None
    least_film: LeastFilm | None = None
    specific_load: SpecificLoad | None = None
    laminar_film: LaminarFilm | None = None
    log_decrement: LogDecrement | None = None
    contact: Contact | None = None
    wiped: Wiped | None = None
    stress: Stress | None = None


def load_limits(own: Path | None = None) -> Limits:
    """The usual limits, with those of a file of the machine in their place.

    Parameters
    ----------
    own : Path, optional
        A file in the shape of the usual one; a table in it replaces values of that table, key by key.

    Raises
    ------
    LimitsError
        With a line for each problem: file, key, what is allowed.
    """
    tables = tomllib.loads(_USUAL.read_text(encoding="utf-8"))
    if own is not None:
        for name, table in _read(own).items():
            known = tables.get(name, {})
            tables[name] = {**known, "read": True, **table} if isinstance(table, Mapping) else table
    return _checked(tables, str(own or _USUAL))


def own_file(scenario: Scenario) -> Path | None:
    """The file of limits beside the files of a scenario's train, None where there is none."""
    path = train_folder(scenario) / FILE
    return path if path.is_file() else None


def limits_of(text: str) -> Limits:
    """The limits that `to_text` wrote."""
    return Limits.model_validate_json(text)


def to_text(limits: Limits) -> str:
    """Limits as text, for the attributes of a record."""
    return limits.model_dump_json(exclude_none=True)


def _read(path: Path) -> dict[str, Any]:
    try:
        return read_toml(path).raw
    except TomlError as error:
        raise LimitsError(f"{path}: {error}") from None


def _checked(tables: Mapping[str, Any], source: str) -> Limits:
    try:
        limits = Limits.model_validate(tables)
    except ValidationError as error:
        lines = []
        for problem in error.errors():
            key = ".".join(str(step) for step in problem["loc"])
            if problem["type"] == "extra_forbidden":
                lines.append(f"{source}: {key}: unknown; {_choice(problem['loc'])}")
            else:
                lines.append(f"{source}: {key} = {problem['input']!r}: {problem['msg']}")
        raise LimitsError("\n".join(lines)) from None
    problems = list(_shapes(limits))
    if problems:
        raise LimitsError("\n".join(f"{source}: {text}" for text in problems))
    return limits


def _choice(place: tuple[int | str, ...]) -> str:
    """What is allowed in place of an unknown key."""
    if len(place) == 1:
        return choice(str(place[0]), Limits.model_fields)
    inner = next(a for a in get_args(Limits.model_fields[str(place[0])].annotation) if a is not type(None))
    return choice(str(place[-1]), inner.model_fields)


def _shapes(limits: Limits) -> list[str]:
    """What is wrong with the sizes and the order of tables."""
    found = []
    if (v := limits.shaft_vibration) is not None:
        sizes = {len(row) for row in (v.speed, v.zone_ab, v.zone_bc, v.zone_cd)}
        if len(sizes) > 1 or list(v.speed) != sorted(v.speed):
            found.append("shaft_vibration: allowed are ascending speeds, and as many bounds of each zone")
    if (f := limits.least_film) is not None and (
        len(f.least) != len(f.diameter) or {len(row) for row in f.least} != {len(f.sliding) + 1}
    ):
        found.append(
            "least_film: allowed are a row for each diameter, with one value more than sliding speeds"
        )
    return found
