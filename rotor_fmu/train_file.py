"""Reads a train from a folder: ``train.toml`` and the table of shoulders, ``shaft.csv``.

Wheels, bearings and couplings are placed by their axial position ``z``, as on a
drawing; it must be the boundary of two shoulders within `POSITION_TOLERANCE`.
A file with mistakes is refused with all of them, one line each.
"""

from __future__ import annotations

import csv
import difflib
import tomllib
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from rotor_fmu.train import BearingSeat, Coupling, Material, Shoulder, Train, Wheel
from rotor_fmu.train_schema import BearingEntry, Placed, ShoulderRow, TrainToml, explain

POSITION_TOLERANCE = 1e-6
"""How far z may be off the boundary of two shoulders [m]."""

DATA = Path(__file__).parent / "data"
_COLUMNS = tuple(ShoulderRow.model_fields)
_RELATIVE_CLEARANCE = (1e-4, 1e-2)


class TrainFileError(ValueError):
    """A train that cannot be read; the message has one line a problem."""

    def __init__(self, problems: list[str]) -> None:
        super().__init__("\n".join(problems))
        self.problems = tuple(problems)


def bundled_trains() -> tuple[str, ...]:
    """Names of the trains that come with the package."""
    return tuple(sorted(path.parent.name for path in DATA.glob("*/train.toml")))


def load_train(name_or_path: str | Path) -> Train:
    """Read a train.

    Parameters
    ----------
    name_or_path : str or Path
        A bundled train's name, or a folder with ``train.toml``, or that file.

    Returns
    -------
    Train
        The train.

    Raises
    ------
    TrainFileError
        With every problem found: file, key or row, value, and what is allowed.
    """
    if str(name_or_path) in bundled_trains():
        path = DATA / str(name_or_path) / "train.toml"
    else:
        path = Path(name_or_path)
        path = path / "train.toml" if path.is_dir() else path
    if not path.is_file():
        known = bundled_trains()
        close = difflib.get_close_matches(str(name_or_path), known, n=1)
        raise TrainFileError(
            [
                f"{name_or_path}: no such train; {f'did you mean {close[0]!r}? ' if close else ''}"
                f"allowed are the bundled {', '.join(known)}, "
                "or the path of a folder with train.toml and shaft.csv"
            ]
        )
    problems: list[str] = []
    data = _read_toml(path, problems)
    table = path.parent / (data.shaft if data else "shaft.csv")
    rows = _read_shaft(table, problems)
    train = _join(path, table, data, rows, problems) if data and not problems else None
    if train is None:
        raise TrainFileError(problems)
    return train


def _read_toml(path: Path, problems: list[str]) -> TrainToml | None:
    try:
        raw: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, OSError) as error:
        problems.append(f"{path}: not TOML: {error}")
        return None
    try:
        return TrainToml.model_validate(raw)
    except ValidationError as error:
        problems.extend(f"{path}: {line}" for line in explain(error, raw, TrainToml))
        return None


def _read_shaft(path: Path, problems: list[str]) -> list[tuple[int, ShoulderRow]]:
    """Rows with the number of their line in the file."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (UnicodeDecodeError, OSError) as error:
        problems.append(f"{path}: not readable: {error}")
        return []
    content = [(n, line) for n, line in enumerate(lines, 1) if line.strip() and line.lstrip()[0] != "#"]
    header = tuple(cell.strip() for cell in content[0][1].split(",")) if content else ()
    if header != _COLUMNS:
        problems.append(f"{path}: header {','.join(header)!r}; allowed is {','.join(_COLUMNS)!r}")
        return []
    rows = []
    for number, line in content[1:]:
        cells = [cell.strip() for cell in next(csv.reader([line]))]
        if len(cells) != len(_COLUMNS):
            problems.append(f"{path}: row {number}: {len(cells)} values; allowed are {len(_COLUMNS)}")
            continue
        raw = dict(zip(_COLUMNS, cells, strict=True))
        try:
            rows.append((number, ShoulderRow.model_validate(raw)))
        except ValidationError as error:
            problems.extend(f"{path}: row {number}: {line}" for line in explain(error, raw, ShoulderRow))
    if len(content) == 1:
        problems.append(f"{path}: no shoulders; at least one row is needed")
    return rows


def _join(
    path: Path, table: Path, data: TrainToml, rows: list[tuple[int, ShoulderRow]], problems: list[str]
) -> Train | None:
    """Place wheels, bearings and couplings on the shaft and check what spans both files."""
    materials = {name: Material(name, **entry.model_dump()) for name, entry in data.materials.items()}
    for number, row in rows:
        if row.material not in materials:
            known = ", ".join(materials)
            problems.append(f"{table}: row {number}: material = {row.material!r}; allowed are {known}")
    if problems:
        return None
    shaft = Train(
        name=data.name,
        speed=data.speed,
        rayleigh_alpha=data.damping.alpha,
        rayleigh_beta=data.damping.beta,
        balance_grade=data.balance_grade,
        shoulders=tuple(
            Shoulder(row.length, row.outer_diameter, row.inner_diameter, materials[row.material])
            for _, row in rows
        ),
        wheels=(),
        bearings=(),
    )
    found: list[str] = []
    wheels, bearings, couplings = (
        [_place(shaft, kind, entry, found) for entry in getattr(data, kind)]
        for kind in ("wheel", "bearing", "coupling")
    )
    if not found:
        found += _check_order(shaft, "bearing", bearings) + _check_order(shaft, "coupling", couplings)
        found += _check_rotors(shaft, bearings, couplings)
    for entry, seat in zip(data.bearing, bearings, strict=True):
        found += [f"bearing {entry.name!r}: {text}" for text in _check_seat(shaft, entry, seat["node"])]
    problems.extend(f"{path}: {text}" for text in found)
    if problems:
        return None
    return replace(
        shaft,
        wheels=tuple(Wheel(**w) for w in wheels),
        bearings=tuple(BearingSeat(**b) for b in bearings),
        couplings=tuple(Coupling(**c) for c in couplings),
    )


def _place(shaft: Train, kind: str, entry: Placed, found: list[str]) -> dict[str, Any]:
    """The entry with its node instead of z."""
    z = shaft.z
    node = min(range(len(z)), key=lambda k: abs(z[k] - entry.z))
    if abs(z[node] - entry.z) > POSITION_TOLERANCE:
        near = ", ".join(f"{value:.6g}" for value in z[max(node - 1, 0) : node + 2])
        found.append(
            f"{kind} {entry.name!r}: z = {entry.z!r}; allowed are boundaries of shoulders, the nearest {near}"
        )
    return {**entry.model_dump(exclude={"z"}), "node": node}


def _check_order(shaft: Train, kind: str, placed: list[dict[str, Any]]) -> list[str]:
    found = []
    ends = (0, shaft.nodes - 1)
    for p in placed:
        if p["node"] in ends:
            found.append(
                f"{kind} {p['name']!r}: z = {shaft.z[p['node']]:.6g}; allowed is between the shaft's ends, "
                f"0 and {shaft.length:.6g}"
            )
    for before, after in pairwise(placed):
        if after["node"] <= before["node"]:
            found.append(
                f"{kind} {after['name']!r}: z = {shaft.z[after['node']]:.6g}; allowed is more than that of "
                f"{before['name']!r} before it, {shaft.z[before['node']]:.6g}"
            )
    return found


def _check_seat(shaft: Train, entry: BearingEntry, node: int) -> list[str]:
    found = []
    low, high = (factor * entry.diameter / 2.0 for factor in _RELATIVE_CLEARANCE)
    if not low <= entry.clearance <= high:
        found.append(
            f"clearance = {entry.clearance!r}; allowed is the radial clearance, {low:.3g} to {high:.3g} "
            f"(1e-4 to 1e-2 of the radius) for diameter {entry.diameter:g}"
        )
    around = {s.outer_diameter for s in shaft.shoulders[max(node - 1, 0) : node + 1]}
    if any(abs(d - entry.diameter) > POSITION_TOLERANCE for d in around):
        there = " and ".join(f"{d:g}" for d in sorted(around))
        found.append(f"diameter = {entry.diameter!r}; allowed is the shaft's own diameter there, {there}")
    return found


def _check_rotors(shaft: Train, bearings: list[dict[str, Any]], couplings: list[dict[str, Any]]) -> list[str]:
    """Every rotor between couplings stands on a bearing, and the train on two at least."""
    found = []
    names = ["the front end", *(repr(c["name"]) for c in couplings), "the rear end"]
    cuts = [0, *(c["node"] for c in couplings), shaft.nodes - 1]
    for (front, rear), (first, last) in zip(pairwise(names), pairwise(cuts), strict=True):
        if not any(first < b["node"] < last for b in bearings):
            found.append(f"bearing: none between {front} and {rear}; allowed is at least one")
    if len(bearings) < 2:
        found.append(f"bearing: {len(bearings)} in all; allowed are at least two")
    return found
