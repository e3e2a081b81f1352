"""From the rows of shaft.csv to shoulders: rows one behind the other, and rows that lie over them.

A row without ``z`` begins where the one before it ends; a row with ``z`` lies there, over or in the others.
Shoulders are cut wherever a row begins or ends.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from pydantic import ValidationError

from rotor_fmu.train.entry import unit_of
from rotor_fmu.train.schema import LEAST_LENGTH, ShoulderRow
from rotor_fmu.train.shoulder import BOTH, MASS, STIFFNESS, Material, Ring, Shoulder
from rotor_fmu.train.table import TableError, read_table
from rotor_fmu.train.wording import choice, explain

Rows = list[tuple[int, ShoulderRow]]
"""Rows with the number of their line in the file."""

_TOUCHING = 1e-6
"""Rings whose diameters overlap by less lie on one another [m]."""


def read_rows(path: Path, problems: list[str]) -> Rows:
    """Read the rows of a file; what is wrong goes to `problems`."""
    columns = {name: unit_of(ShoulderRow, name) for name in ShoulderRow.model_fields}
    required = [name for name, field in ShoulderRow.model_fields.items() if field.is_required()]
    try:
        table, wrong = read_table(path, columns, required)
    except TableError as error:
        problems.append(str(error))
        return []
    problems += wrong
    rows: Rows = []
    for number, raw in table:
        try:
            rows.append((number, ShoulderRow.model_validate(raw)))
        except ValidationError as error:
            problems.extend(f"row {number}: {text}" for _, text in explain(error, raw, ShoulderRow))
    if not table and not wrong:
        problems.append("no shoulders; at least one row is needed")
    return rows


def unknown_materials(rows: Rows, materials: object) -> Iterator[str]:
    """Yield rows whose material train.toml does not have."""
    if not isinstance(materials, Mapping):
        return  # said elsewhere
    for number, row in rows:
        if row.material not in materials and not (row.material == "" and len(materials) == 1):
            yield f"row {number}: material = {row.material!r}; {choice(row.material, materials)}"


@dataclass(frozen=True)
class _Piece:
    """What a row puts between two places."""

    number: int
    row: ShoulderRow
    front: float
    rear: float
    rings: tuple[Ring, ...]

    def between(self, front: float, rear: float) -> Iterator[Ring]:
        if (front, rear) == (self.front, self.rear):
            yield from self.rings
            return
        span = self.rear - self.front
        for ring in self.rings:
            yield ring.part((front - self.front) / span, (rear - self.front) / span)


def shoulders_of(
    rows: Rows, materials: Mapping[str, Material], unknown: Material, problems: list[str]
) -> tuple[Shoulder, ...]:
    """Lay the rows out.

    Parameters
    ----------
    rows : list
        From `read_rows`.
    materials : mapping
        By name.
    unknown : Material
        In place of one that is not among them.
    problems : list of str
        Takes what does not fit together.

    Returns
    -------
    tuple of Shoulder
        From front to rear.
    """
    only = next(iter(materials.values())) if len(materials) == 1 else unknown
    pieces = []
    lengths: list[float] = []
    for number, row in rows:
        if row.length < LEAST_LENGTH:
            problems.append(
                f"row {number}: length = {row.length!r}; allowed is at least {LEAST_LENGTH:g} m: leave the "
                "row out, or add it to the row before"
            )
        material = materials.get(row.material, unknown) if row.material else only
        front = math.fsum(lengths) if row.z is None else row.z
        if row.z is None:
            lengths.append(row.length)
        rear = math.fsum(lengths) if row.z is None else row.z + row.length
        pieces.append(_Piece(number, row, front, rear, tuple(_rings(row, material))))
    if len(lengths) == len(rows):
        return tuple(_shoulder(piece.row.length, list(piece.rings)) for piece in pieces)
    return tuple(_laid_over(pieces, problems))


def _rings(row: ShoulderRow, material: Material) -> Iterator[Ring]:
    if row.stiffness_outer_diameter is None and row.stiffness_inner_diameter is None:
        ends = row.rear_outer_diameter, row.rear_inner_diameter
        yield Ring(row.outer_diameter, row.inner_diameter, material, *ends, row.counts)
        return
    outer, inner = row.stiffness_diameters
    yield Ring(row.outer_diameter, row.inner_diameter, material, counts=MASS)
    if outer > 0.0:
        yield Ring(outer, inner, material, counts=STIFFNESS)


def _shoulder(length: float, rings: list[Ring]) -> Shoulder:
    first = rings[0]
    if len(rings) == 1 and first.counts == BOTH and not first.tapers:
        return Shoulder(length, first.outer_diameter, first.inner_diameter, first.material)
    return Shoulder.of_rings(length, rings)


def _laid_over(pieces: Sequence[_Piece], problems: list[str]) -> Iterator[Shoulder]:
    """Cut the pieces wherever one of them begins or ends; yield what lies between."""
    chain = sorted({place for p in pieces if p.row.z is None for place in (p.front, p.rear)})
    cuts = list(chain)
    for place in (place for p in pieces if p.row.z is not None for place in (p.front, p.rear)):
        if all(abs(cut - place) >= LEAST_LENGTH for cut in cuts):
            cuts.append(place)
    cuts.sort()
    snapped = [
        _Piece(p.number, p.row, _snapped(p.front, cuts), _snapped(p.rear, cuts), p.rings) for p in pieces
    ]
    if cuts[0] > 0.0:
        problems.append(f"the first row begins at z = {cuts[0]:.6g}; allowed is 0")
    for front, rear in pairwise(cuts):
        here = [p for p in snapped if p.front <= front and rear <= p.rear]
        rings = [(p, ring) for p in here for ring in p.between(front, rear)]
        where = f"between z = {front:.6g} and {rear:.6g}"
        problems += _overlaps(rings, where)
        if not any(ring.stiff for _, ring in rings):
            problems.append(f"nothing that is stiff {where}; allowed is a shaft without gaps")
            rings = rings or [(snapped[0], snapped[0].rings[0])]
        whole = [p.row.length for p in here if (p.front, p.rear) == (front, rear)]
        yield _shoulder(whole[0] if whole else round(rear - front, 12), [ring for _, ring in rings])


def _snapped(place: float, cuts: Sequence[float]) -> float:
    """The cut that a place lies at."""
    return min(cuts, key=lambda cut: abs(cut - place))


def _overlaps(rings: Sequence[tuple[_Piece, Ring]], where: str) -> Iterator[str]:
    """Yield rings that lie in one another and count for the same."""
    said = set()
    for matters in ("stiff", "heavy"):
        counted = sorted(
            ((p, r) for p, r in rings if getattr(r, matters)), key=lambda found: found[1].inner(0.5)
        )
        for (below, inner), (above, outer) in pairwise(counted):
            room = max(inner.outer(share) - outer.inner(share) for share in (0.0, 1.0))
            if room > _TOUCHING and (below.number, above.number) not in said:
                said.add((below.number, above.number))
                reach = max(inner.outer(0.0), inner.outer(1.0))
                yield (
                    f"row {above.number}: inner_diameter = {outer.inner_diameter!r} {where}; allowed is at "
                    f"least {reach:.6g}, to which row {below.number} reaches"
                )
