"""Writes a train as the folder that `rotor_fmu.train.file` reads: train.toml and shaft.csv."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, TypeAlias

import tomlkit

from fmus import port
from rotor_fmu.train.schema import BORE
from rotor_fmu.train.seat import DIRECTIONS, Pedestal
from rotor_fmu.train.train import BearingSeat, Coupling, LumpedMass, Ring, Shoulder, Train, Wheel

Placed: TypeAlias = Coupling | BearingSeat | Wheel | LumpedMass

SHAFT_HEADER = "length,outer_diameter,inner_diameter,material"
_MORE = ",rear_outer_diameter,rear_inner_diameter,counts,z"
FOUNDATION = "foundation.csv"
_SINCE = (
    "height",
    "sleeve",
    "feed_pressure",
    "feed_content",
    "feed_flow",
    "bore",
    "pedestal",
    "supply_temperature",
    "heat_capacity",
    "heat_storage",
    "viscosity_40",
    "viscosity_100",
)
"""Keys that are written where they differ from their defaults."""


def write_train(train: Train, folder: Path) -> None:
    """Write ``train.toml`` and ``shaft.csv`` into a folder, which is made if missing.

    Parameters
    ----------
    train : Train
        The train.
    folder : Path
        Where to write.
    """
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "shaft.csv").write_text(shaft_csv(train), encoding="utf-8")
    (folder / "train.toml").write_text(train_toml(train), encoding="utf-8")
    if train.foundation:
        (folder / FOUNDATION).write_text(foundation_csv(train), encoding="utf-8")
    for seat in train.bearings:
        if len(port.coefficient_rows(seat.coefficients)) > 1:
            (folder / _table_file(seat)).write_text(table_csv(seat), encoding="utf-8")


def foundation_csv(train: Train) -> str:
    """The modes of the foundation, SI units."""
    places = [f"{seat.name}.{direction}" for seat in train.bearings for direction in DIRECTIONS]
    rows = ([mode.frequency, mode.damping_ratio, *mode.shape] for mode in train.foundation)
    lines = [["frequency", "damping", *places], *([repr(x) for x in row] for row in rows)]
    return "\n".join(",".join(line) for line in lines) + "\n"


def table_csv(seat: BearingSeat) -> str:
    """Stiffness and damping of a bearing over speed, SI units."""
    numbers = [f"{letter}{k // 4 + 1}{k % 4 + 1}" for letter in "KC" for k in range(16)]
    rows = ([repr(x) for x in row] for row in port.coefficient_rows(seat.coefficients))
    return "\n".join(",".join(row) for row in (["speed", *numbers], *rows)) + "\n"


def shaft_csv(train: Train) -> str:
    """The shoulders from front to rear, one a row; what sits behind a shoulder is noted as a comment."""
    notes: dict[int, list[str]] = {}
    for part in _parts(train):
        notes.setdefault(part.node, []).append(f"{_kind(part)} {part.name}")
    plain = all(shoulder.plain or shoulder.joint for shoulder in train.shoulders)
    lines = [
        f"# Shoulders of train {train.name}, front to rear; metres",
        SHAFT_HEADER + ("" if plain else _MORE),
    ]
    for k, shoulder in enumerate(train.shoulders):
        if k in notes:
            lines.append(f"# z = {_z(train, k)!r}: {', '.join(notes[k])}")
        for index, ring in enumerate(shoulder.rings):
            lines.append(_row(shoulder, ring, plain, _z(train, k) if index else None))
    return "\n".join(lines) + "\n"


def _row(shoulder: Shoulder, ring: Ring, plain: bool, z: float | None) -> str:
    cells = [repr(value) for value in (shoulder.length, ring.outer_diameter, ring.inner_diameter)]
    cells.append(ring.material.name)
    if not plain:
        rear = ring.rear_outer_diameter, ring.rear_inner_diameter
        cells += ["" if value is None else repr(value) for value in rear]
        cells += [ring.counts, "" if z is None else repr(z)]
    return ",".join(cells)


def train_toml(train: Train) -> str:
    """Everything that is not a shoulder; wheels, bearings and couplings are placed by z."""
    content: dict[str, Any] = {
        "name": train.name,
        "speed": train.speed,
        "balance_grade": train.balance_grade,
        "damping": {"alpha": train.rayleigh_alpha, "beta": train.rayleigh_beta},
        "materials": {},
    }
    if train.foundation:
        content["foundation"] = FOUNDATION
    if train.gravity != Train.gravity:
        content["gravity"] = list(train.gravity)
    for material in train.materials:
        properties = material.properties
        content["materials"][properties.pop("name")] = properties
    for part in _parts(train):
        content.setdefault(_kind(part), []).append(dict(_entries(train, part)))
    return tomlkit.dumps(content)


def _entries(train: Train, part: Placed) -> Iterator[tuple[str, Any]]:
    scales = BORE if isinstance(part, BearingSeat) and not part.has_film else {}
    for field in fields(part):
        value = getattr(part, field.name)
        if field.name == "node":
            yield "z", _z(train, part.node)
        elif isinstance(part, BearingSeat) and field.name == "coefficients":
            yield from _given(part)
        elif field.name == "viscosity" and isinstance(part, BearingSeat) and part.oil is not None:
            continue  # follows from the oil
        elif field.name in (*scales, "has_film") or (field.name in _SINCE and value == field.default):
            continue
        elif isinstance(value, Pedestal):
            yield field.name, {key: list(pair) for key, pair in asdict(value).items() if pair is not None}
        elif isinstance(value, str | bool):
            yield field.name, value
        elif value is not None:
            yield field.name, float(value)
    if isinstance(part, Coupling):
        joint = train.joint_of(part)
        yield from asdict(joint).items() if joint else ()
    elif not isinstance(part, BearingSeat):
        yield from _side(train, part.node)


def _side(train: Train, node: int) -> Iterator[tuple[str, str]]:
    """Yield the side of an elastic coupling on which a body sits."""
    for coupling in train.couplings:
        if train.joint_of(coupling) and node in (coupling.node - 1, coupling.node):
            yield "side", "rear" if node == coupling.node else "front"


def _given(seat: BearingSeat) -> Iterator[tuple[str, Any]]:
    """Stiffness and damping that are given: two matrices, or the name of their table."""
    rows = port.coefficient_rows(seat.coefficients)
    if len(rows) > 1:
        yield "table", _table_file(seat)
    for row in rows[:1] if len(rows) == 1 else ():
        yield "stiffness", [list(row[1 + i : 5 + i]) for i in range(0, 16, 4)]
        yield "damping", [list(row[17 + i : 21 + i]) for i in range(0, 16, 4)]


def _table_file(seat: BearingSeat) -> str:
    return f"{seat.name}.csv"


def _parts(train: Train) -> tuple[Placed, ...]:
    return (*train.couplings, *train.bearings, *train.wheels, *train.masses)


def _kind(part: Placed) -> str:
    kinds = {Coupling: "coupling", BearingSeat: "bearing", Wheel: "wheel", LumpedMass: "mass"}
    return kinds[type(part)]


def _z(train: Train, node: int) -> float:
    return round(train.z[node], 9)
