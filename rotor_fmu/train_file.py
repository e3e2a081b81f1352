"""Reads a train from a folder: ``train.toml`` and the table of shoulders, ``shaft.csv``.

Wheels, bearings and couplings are placed by their axial position ``z``, as on a
drawing; it must be the boundary of two shoulders within `POSITION_TOLERANCE`.
A file with mistakes is refused with all of them, one line each.
"""

from __future__ import annotations

import csv
import tomllib
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from rotor_fmu.train import BearingSeat, Coupling, Material, Shoulder, Train, Wheel
from rotor_fmu.train_schema import BearingEntry, ShoulderRow, TrainToml, explain

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
        raise TrainFileError(
            [
                f"{name_or_path}: no such train; allowed are the bundled {', '.join(bundled_trains())}, "
                "or the path of a folder with train.toml and shaft.csv"
            ]
        )
    problems: list[str] = []
    data = _read_toml(path, problems)
    table = path.parent / str(data.shaft if data else "shaft.csv")
    rows = _read_shaft(table, problems)
    if data is None or problems:
        raise TrainFileError(problems)
    train = _join(path, table, data, rows, problems)
    if train is None or problems:
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
    content = [(n, line) for n, line in enumerate(lines, 1) if line.strip() and not line.lstrip().startswith("#")]
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
    shoulders = []
    for number, row in rows:
        if row.material not in materials:
            problems.append(
                f"{table}: row {number}: material = {row.material!r}; allowed are {', '.join(materials)}"
            )
        else:
            shoulders.append(
                Shoulder(row.length, row.outer_diameter, row.inner_diameter, materials[row.material])
            )
    if problems:
        return None
    bare = Train(data.name, data.speed, data.damping.alpha, data.damping.beta, data.balance_grade,
                 tuple(shoulders), (), ())  # fmt: skip
    z = bare.z

    def place(kind: str, entries: list[Any]) -> list[dict[str, Any]]:
        placed = []
        for entry in entries:
            node = min(range(len(z)), key=lambda k: abs(z[k] - entry.z))
            if abs(z[node] - entry.z) > POSITION_TOLERANCE:
                near = ", ".join(f"{z[k]:.6g}" for k in range(max(node - 1, 0), min(node + 2, len(z))))
                problems.append(
                    f"{path}: {kind} {entry.name!r}: z = {entry.z!r}; allowed are boundaries of shoulders, "
                    f"the nearest {near}"
                )
            placed.append({**entry.model_dump(exclude={"z"}), "node": node})
        return placed

    wheels = place("wheel", data.wheel)
    bearings = place("bearing", data.bearing)
    couplings = place("coupling", data.coupling)
    for kind, placed in (("bearing", bearings), ("coupling", couplings)):
        nodes = [p["node"] for p in placed]
        for before, after in zip(placed, placed[1:], strict=False):
            if after["node"] <= before["node"]:
                problems.append(
                    f"{path}: {kind} {after['name']!r}: z = {z[after['node']]:.6g}; allowed is more than that of "
                    f"{before['name']!r} before it, {z[before['node']]:.6g}"
                )
        for p in placed:
            if nodes.count(p["node"]) == 1 and not 0 < p["node"] < len(z) - 1:
                problems.append(f"{path}: {kind} {p['name']!r}: z = {z[p['node']]:.6g}; allowed is inside the shaft")
    for entry, seat in zip(data.bearing, bearings, strict=True):
        problems.extend(f"{path}: bearing {entry.name!r}: {text}" for text in _check_seat(entry, seat["node"], bare))
    _check_sections(path, bearings, couplings, len(z), problems)
    if problems:
        return None
    return Train(
        name=bare.name,
        speed=bare.speed,
        rayleigh_alpha=bare.rayleigh_alpha,
        rayleigh_beta=bare.rayleigh_beta,
        balance_grade=bare.balance_grade,
        shoulders=bare.shoulders,
        wheels=tuple(Wheel(**w) for w in wheels),
        bearings=tuple(BearingSeat(**b) for b in bearings),
        couplings=tuple(Coupling(**c) for c in couplings),
    )


def _check_seat(entry: BearingEntry, node: int, train: Train) -> list[str]:
    problems = []
    low, high = (factor * entry.diameter / 2.0 for factor in _RELATIVE_CLEARANCE)
    if not low <= entry.clearance <= high:
        problems.append(
            f"clearance = {entry.clearance!r}; allowed for diameter {entry.diameter:g} is {low:.3g} to {high:.3g} "
            "(radial, 1e-4 to 1e-2 of the radius)"
        )
    around = {s.outer_diameter for s in train.shoulders[max(node - 1, 0) : node + 1]}
    if any(abs(d - entry.diameter) > POSITION_TOLERANCE for d in around):
        shafts = " and ".join(f"{d:g}" for d in sorted(around))
        problems.append(f"diameter = {entry.diameter!r}; allowed is that of the shaft there, {shafts}")
    return problems


def _check_sections(
    path: Path, bearings: list[dict[str, Any]], couplings: list[dict[str, Any]], nodes: int, problems: list[str]
) -> None:
    """Two bearings carry the first rotor; each further rotor needs one, its coupling being the other."""
    cuts = [0, *(c["node"] for c in couplings), nodes - 1]
    for r, (first, last) in enumerate(zip(cuts[:-1], cuts[1:], strict=True)):
        count = sum(first < b["node"] < last for b in bearings)
        if count == 0:
            between = couplings[r - 1]["name"] if r else "the front end", (
                couplings[r]["name"] if r < len(couplings) else "the rear end"
            )
            problems.append(
                f"{path}: bearing: none between {between[0]} and {between[1]}; each rotor needs at least one"
            )
    if len(bearings) < 2:
        problems.append(f"{path}: bearing: {len(bearings)} of them; at least two are needed")
