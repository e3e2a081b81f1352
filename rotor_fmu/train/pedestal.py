"""What a bearing stands on, as a train file gives it: a pedestal, or the modes of a whole foundation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from rotor_fmu.train.entry import Entry
from rotor_fmu.train.seat import DIRECTIONS, FoundationMode, Pair, Pedestal
from rotor_fmu.train.table import TableError, read_table
from rotor_fmu.train.toml_source import Problem
from rotor_fmu.train.train import Train


def _pair_of(low: float, high: float) -> BeforeValidator:
    """One number for both directions, or two."""
    allowed = {"allowed": f"a number from {low:g} to {high:g} for both directions, or two of them"}

    def check(value: Any) -> Pair:
        pair = list(value) if isinstance(value, list | tuple) else [value, value]
        numbers = all(isinstance(x, int | float) and not isinstance(x, bool) for x in pair)
        if len(pair) != 2 or not numbers or not all(low <= x <= high for x in pair):
            raise PydanticCustomError("pair", "{allowed}", allowed)
        return float(pair[0]), float(pair[1])

    return BeforeValidator(check)


class PedestalEntry(Entry):
    """pedestal = { ... } of a [[bearing]], see `Pedestal`."""

    mass: Annotated[Pair, _pair_of(1e-3, 1e7)] = Field(description="kg")
    stiffness: Annotated[Pair, _pair_of(0.0, 1e30)] = Field(description="N/m; did you give N/mm?")
    damping: Annotated[Pair, _pair_of(0.0, 1e12)] = Field((0.0, 0.0), description="N s/m")
    inertia: Annotated[Pair | None, _pair_of(1e-6, 1e8)] = Field(None, description="kg m2")
    tilt_stiffness: Annotated[Pair | None, _pair_of(0.0, 1e30)] = Field(None, description="N m/rad")
    tilt_damping: Annotated[Pair, _pair_of(0.0, 1e12)] = Field((0.0, 0.0), description="N m s/rad")

    @model_validator(mode="after")
    def _tilts_with_inertia(self) -> PedestalEntry:
        if (self.inertia is None) != (self.tilt_stiffness is None):
            raise ValueError("inertia and tilt_stiffness: allowed are both, or none where it does not tilt")
        return self

    @property
    def pedestal(self) -> Pedestal:
        """As the train has it."""
        return Pedestal(**self.model_dump())


def foundation_modes(path: Path, bearings: Sequence[str]) -> tuple[FoundationMode, ...]:
    """Read the modes of a foundation.

    Its columns are ``frequency`` [rad/s], or ``frequency [Hz]``; ``damping``, a ratio; ``mass`` [kg], modal,
    where shapes are not mass-normalised; and of each bearing ``NAME.x``, ``NAME.y``, ``NAME.tilt_x``,
    ``NAME.tilt_y``, of which what is missing does not move.

    Raises
    ------
    ValueError
        With a line for each problem.
    """
    places = {
        f"{_as_column(name)}.{direction}": 4 * index + k
        for index, name in enumerate(bearings)
        for k, direction in enumerate(DIRECTIONS)
    }
    plain = "rad/rad"
    columns = {"frequency": "rad/s", "damping": plain, "mass": "kg", **dict.fromkeys(places, plain)}
    try:
        rows, problems = read_table(path, columns, ("frequency", "damping"))
    except TableError as error:
        raise ValueError(f"{path.name}: {error}") from None
    modes = []
    bounds = {"frequency": (1e-3, 1e7), "damping": (0.0, 10.0), "mass": (1e-6, 1e9)}
    for number, row in rows:
        for name, value in row.items():
            low, high = bounds.get(name, (-1e6, 1e6))
            if not isinstance(value, float) or not low <= value <= high:
                problems.append(f"row {number}: {name} = {value!r}; allowed is {low:g} to {high:g}")
        if lacking := [name for name in ("frequency", "damping") if name not in row]:
            problems.append(f"row {number}: {lacking[0]} is missing")
        if problems:
            continue
        shape = [0.0] * (4 * len(bearings))
        for name, place in places.items():
            shape[place] = float(row.get(name, 0.0)) / math.sqrt(float(row.get("mass", 1.0)))
        modes.append(FoundationMode(float(row["frequency"]), float(row["damping"]), tuple(shape)))
    if not problems and not modes:
        problems.append("no row; allowed is one a mode")
    if problems:
        raise ValueError("; ".join(f"{path.name}: {text}" for text in problems))
    return tuple(modes)


def with_foundation(train: Train, file: str | None, folder: Path) -> tuple[Train, list[Problem]]:
    """The train on the foundation of a table, and what is wrong with that."""
    if file is None:
        return train, []
    if any(seat.pedestal is not None for seat in train.bearings):
        return train, [(("foundation",), "given beside pedestals; allowed is one of them")]
    try:
        modes = foundation_modes(folder / file, [seat.name for seat in train.bearings])
    except ValueError as error:
        return train, [(("foundation",), str(error))]
    return replace(train, foundation=modes), []


def _as_column(name: str) -> str:
    """A bearing's name as the header of a table is read."""
    return "".join("_" if c in " -_" else c for c in name).casefold()
