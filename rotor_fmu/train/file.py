"""Reads a train from a folder: ``train.toml`` and the table of shoulders, ``shaft.csv``.

What sits on the shaft is placed by its axial position ``z``, as on a
drawing; it must be the boundary of two shoulders within `POSITION_TOLERANCE`.
A file with mistakes is refused with all of them, one line each, with line or row.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from rotor_fmu.train.bore import KEYS
from rotor_fmu.train.checks import (
    POSITION_TOLERANCE,
    entry_problems,
    load_problems,
    names_twice,
    nearest_node,
    order_problems,
    rotor_problems,
    side_problems,
    speed_problems,
)
from rotor_fmu.train.coefficients import constant, table_text
from rotor_fmu.train.derived import based
from rotor_fmu.train.joints import Nodes, with_joints
from rotor_fmu.train.oil import CURVE
from rotor_fmu.train.pedestal import with_foundation
from rotor_fmu.train.schema import (
    BORE,
    COEFFICIENTS,
    BearingEntry,
    CouplingEntry,
    MassEntry,
    Placed,
    TrainToml,
    WheelEntry,
)
from rotor_fmu.train.shaft_table import Rows, read_rows, shoulders_of, unknown_materials
from rotor_fmu.train.toml_source import Problem, TomlError, TomlSource, read_toml
from rotor_fmu.train.train import BearingSeat, Coupling, LumpedMass, Material, Shoulder, Train, Wheel
from rotor_fmu.train.wording import choice, explain

__all__ = ["DATA", "POSITION_TOLERANCE", "TrainFileError", "bundled_trains", "load_train", "train_file"]

DATA = Path(__file__).parents[1] / "data"
_MODELS: dict[str, type[Placed]] = {
    "wheel": WheelEntry,
    "bearing": BearingEntry,
    "coupling": CouplingEntry,
    "mass": MassEntry,
}
_ANY = Material("", 1.0, 0.0, 1.0)
"""In place of a material that is not known, where only the geometry counts."""


class TrainFileError(ValueError):
    """A train that cannot be read; the message has one line a problem."""

    def __init__(self, problems: list[str]) -> None:
        super().__init__("\n".join(problems))
        self.problems = tuple(problems)


def bundled_trains() -> tuple[str, ...]:
    """Names of the trains that come with the package."""
    return tuple(sorted(path.parent.name for path in DATA.glob("*/train.toml")))


def derived_trains(train: str) -> tuple[str, ...]:
    """Names of the trains that come with the package and are derived from one, as ``turbine/lemon``."""
    found = (path.stem for path in sorted((DATA / train).glob("*.toml")))
    return tuple(f"{train}/{name}" for name in found if name not in ("train", "limits"))


def bundled_file(name: str) -> Path | None:
    """File of a bundled train, as ``turbine``, or of one derived from it, as ``turbine/lemon``, or None."""
    train, slash, derived = name.partition("/")
    path = DATA / train / (f"{derived}.toml" if slash else "train.toml")
    known = train in bundled_trains() and (derived.isidentifier() or not slash)
    return path if known and path.is_file() else None


def load_train(name_or_path: str | Path, raw: Mapping[str, Any] | None = None) -> Train:
    """Read a train.

    Parameters
    ----------
    name_or_path : str or Path
        A bundled train's name, or a folder with ``train.toml``, or that file.
    raw : mapping, optional
        In place of what the file says; then problems have no lines.

    Returns
    -------
    Train
        The train.

    Raises
    ------
    TrainFileError
        With every problem found: file, line or row, key, value, and what is allowed.
    """
    path = train_file(name_or_path)
    problems: list[str] = []
    try:
        source = read_toml(path)
        if raw is not None:
            source = TomlSource("")
            source.raw = dict(raw)
        source, path = based(source, path)
    except TomlError as error:
        problems.append(f"{path}: {error}")
        source = TomlSource("")
    shaft_file = source.raw.get("shaft")
    table = path.parent / (shaft_file if isinstance(shaft_file, str) else "shaft.csv")
    in_table: list[str] = []
    rows = read_rows(table, in_table)
    train, found = None, list[Problem]()
    if not problems:
        given = _coefficients(source, path.parent)
        train, found = _checked(source, rows if not in_table else [], given, in_table)
        if train is not None and not found:
            train, found = with_foundation(train, source.raw.get("foundation"), path.parent)
        in_table += unknown_materials(rows, source.raw.get("materials"))
    located = source.located(found) if raw is None else (text for _, text in found)
    problems += (f"{path}: {text}" for text in located)
    problems += (f"{table}: {text}" for text in in_table)
    if train is None or problems:
        raise TrainFileError(problems)
    return train


def train_file(name_or_path: str | Path) -> Path:
    """The file of a train, given as for `load_train`; raises TrainFileError where there is none."""
    bundled = bundled_file(str(name_or_path))
    if bundled is not None:
        return bundled
    path = Path(name_or_path)
    path = path / "train.toml" if path.is_dir() else path
    if not path.is_file():
        raise TrainFileError(
            [
                f"{name_or_path}: no such train; {choice(path.name, bundled_trains())}, which are "
                "bundled, or the path of a folder with train.toml and shaft.csv"
            ]
        )
    return path


def _coefficients(source: TomlSource, folder: Path) -> dict[int, str | ValueError]:
    """Stiffness and damping by the index of the bearing, or what is wrong with its table."""
    given: dict[int, str | ValueError] = {}
    for index, entry in _sound(source.raw.get("bearing"), BearingEntry):
        try:
            if entry.table is not None:
                given[index] = table_text(folder / entry.table)
            elif entry.stiffness is not None or entry.damping is not None:
                given[index] = constant(entry.stiffness, entry.damping)
        except ValueError as error:
            given[index] = error
    return given


def _checked(
    source: TomlSource, rows: Rows, given: Mapping[int, str | ValueError], in_table: list[str]
) -> tuple[Train | None, list[Problem]]:
    """Return the train, or None with what is wrong in train.toml, by itself and on this shaft."""
    data, found = None, list[Problem]()
    found += ((("bearing", i, "table"), str(x)) for i, x in given.items() if isinstance(x, ValueError))
    try:
        data = TrainToml.model_validate(source.raw)
    except ValidationError as error:
        found += explain(error, source.raw, TrainToml)
    found += names_twice(source.raw)
    if not rows:
        return None, found
    known = data.materials if data else {}
    materials = {name: Material(name, **entry.model_dump()) for name, entry in known.items()}
    shaft = _train(data, shoulders_of(rows, materials, _ANY, in_table), {}, given)
    if in_table:
        return None, found
    for kind, model in _MODELS.items():
        for index, entry in _sound(source.raw.get(kind), model):
            found += entry_problems(shaft, kind, index, entry)
    if data is None or found:
        return None, found
    nodes: Nodes = {kind: [nearest_node(shaft, entry.z) for entry in getattr(data, kind)] for kind in _MODELS}
    found += order_problems(shaft, "bearing", data.bearing, nodes["bearing"])
    found += order_problems(shaft, "coupling", data.coupling, nodes["coupling"])
    if not found:
        found += rotor_problems(shaft, data.coupling, nodes)
        found += side_problems(data, nodes)
    if found or any(unknown_materials(rows, source.raw.get("materials"))):
        return None, found
    shoulders, nodes = with_joints(shaft.shoulders, data, nodes)
    train = _train(data, shoulders, nodes, given)
    films = [seat for seat in train.bearings if seat.has_film]
    widest = max(films, key=lambda seat: seat.diameter, default=None)
    if widest is not None:
        found += speed_problems(train.speed, widest.diameter, widest.name)
    return train, [*found, *load_problems(train)]


def _sound(entries: Any, model: type[BaseModel]) -> Iterator[tuple[int, Any]]:
    """Yield those entries of a list that are right by themselves, whatever the others are."""
    for index, entry in enumerate(entries if isinstance(entries, list) else ()):
        try:
            yield index, model.model_validate(entry)
        except ValidationError:
            continue  # said with the whole file


def _train(
    data: TrainToml | None,
    shoulders: tuple[Shoulder, ...],
    nodes: Nodes,
    given: Mapping[int, str | ValueError],
) -> Train:
    """Return the train; without nodes only its shaft, without data only the geometry of that."""
    if data is None:
        return Train("", 1.0, 0.0, 0.0, 0.0, shoulders, (), ())
    parts: dict[str, list[dict[str, Any]]] = {kind: [] for kind in _MODELS}
    for kind, places in nodes.items():
        joint = CouplingEntry.model_fields.keys() - {"name"} if kind == "coupling" else set()
        parts[kind] = [
            {**entry.model_dump(exclude={"z", "side", *COEFFICIENTS, *KEYS, *CURVE, *joint}), "node": node}
            for entry, node in zip(getattr(data, kind), places, strict=True)
        ]
    for index, seat in enumerate(parts["bearing"]):
        assert data is not None
        entry = data.bearing[index]
        seat |= {"coefficients": given.get(index, ""), "has_film": entry.has_film, "bore": entry.bore_text}
        seat["pedestal"] = entry.pedestal.pedestal if entry.pedestal else None
        seat |= entry.in_seat
        if not seat["has_film"]:
            around = shoulders[max(seat["node"] - 1, 0) : seat["node"] + 1]
            journal = min(shoulder.outer_diameter for shoulder in around)
            seat |= {key: share * journal if key != "viscosity" else share for key, share in BORE.items()}
    return Train(
        name=data.name,
        speed=data.speed,
        rayleigh_alpha=data.damping.alpha,
        rayleigh_beta=data.damping.beta,
        balance_grade=data.balance_grade,
        shoulders=shoulders,
        wheels=tuple(Wheel(**wheel) for wheel in parts["wheel"]),
        bearings=tuple(BearingSeat(**bearing) for bearing in parts["bearing"]),
        couplings=tuple(Coupling(**coupling) for coupling in parts["coupling"]),
        masses=tuple(LumpedMass(**mass) for mass in parts["mass"]),
        gravity=(data.gravity[0], data.gravity[1]),
    )
