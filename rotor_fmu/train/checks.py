"""Checks of a train that span several values: what fits where, and what a film carries."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

from pydantic import ValidationError

from rotor_fmu.train.film_capacity import ECCENTRICITY, most_load
from rotor_fmu.train.joints import Nodes
from rotor_fmu.train.schema import (
    BearingEntry,
    CouplingEntry,
    MassEntry,
    Placed,
    TrainToml,
    WheelEntry,
)
from rotor_fmu.train.toml_source import Problem
from rotor_fmu.train.train import Train
from rotor_fmu.train.wording import explain

POSITION_TOLERANCE = 1e-6
"""How far z may be off the boundary of two shoulders [m]."""

RELATIVE_CLEARANCE = (1e-4, 1e-2)
"""Radial clearance over the journal's radius; machines have 5e-4 to 5e-3."""

SOFTEST_CONTACT = 1e6
"""Least contact modulus that is not zero [Pa]; below it the unit is mistaken."""

FASTEST_JOURNAL = 200.0
"""Surface speed of a journal from which a speed is mistaken [m/s]; machines have up to 120."""


def nearest_node(shaft: Train, z: float) -> int:
    """Node of the boundary of shoulders nearest to an axial position."""
    return min(range(shaft.nodes), key=lambda k: abs(shaft.z[k] - z))


def names_twice(raw: Mapping[str, Any]) -> Iterator[Problem]:
    """Yield wheels, bearings, couplings and masses, as read, that have the name of an earlier one."""
    for kind in ("wheel", "bearing", "coupling", "mass"):
        entries = raw.get(kind)
        seen: set[str] = set()
        for index, entry in enumerate(entries if isinstance(entries, list) else ()):
            name = entry.get("name") if isinstance(entry, dict) else None
            if isinstance(name, str) and name in seen:
                yield (kind, index, "name"), f"{kind}: name = {name!r} occurs twice; allowed are unique names"
            elif isinstance(name, str):
                seen.add(name)


def entry_problems(shaft: Train, kind: str, index: int, entry: Placed) -> Iterator[Problem]:
    """Yield what is wrong with one wheel, bearing, coupling or mass on this shaft.

    Parameters
    ----------
    shaft : Train
        Without what sits on it.
    kind : str
        wheel, bearing, coupling or mass.
    index : int
        Of the entry in the file.
    entry : Placed
        The entry.
    """
    found = list(_position(shaft, entry))
    on_shaft = not found
    if on_shaft and isinstance(entry, CouplingEntry):
        found += _inside(shaft, entry)
    if isinstance(entry, BearingEntry):
        if entry.has_film:
            found += _film(entry)
            found += _seat(shaft, entry) if on_shaft and not entry.sleeve else ()
        if entry.load is not None and entry.height is not None:
            found.append(("height", f"height = {entry.height!r} beside a load; allowed is one of them"))
    elif isinstance(entry, WheelEntry | MassEntry):
        found += _body(entry)
    for key, text in found:
        yield (kind, index, key), f"{kind} {entry.name!r}: {text}"


def film_problems(values: Mapping[str, float | str]) -> Iterator[str]:
    """Yield what is wrong with the data of one film, wherever they come from.

    Parameters
    ----------
    values : mapping
        By the keys of a bearing in a train file, from diameter to friction.
    """
    raw = {"name": "bearing", "z": 0.0, **values}
    try:
        entry = BearingEntry.model_validate(raw)
    except ValidationError as error:
        yield from (text for _, text in explain(error, raw, BearingEntry))
    else:
        yield from (text for _, text in _film(entry))


def _position(shaft: Train, entry: Placed) -> Iterator[tuple[str, str]]:
    if entry.z > shaft.length + POSITION_TOLERANCE:
        yield "z", f"z = {entry.z!r} is outside the shaft; allowed is 0 to {shaft.length:.6g}"
        return
    node = nearest_node(shaft, entry.z)
    if abs(shaft.z[node] - entry.z) > POSITION_TOLERANCE:
        near = ", ".join(f"{value:.6g}" for value in shaft.z[max(node - 1, 0) : node + 2])
        yield "z", f"z = {entry.z!r}; allowed are boundaries of shoulders, the nearest {near}"


def _inside(shaft: Train, entry: Placed) -> Iterator[tuple[str, str]]:
    if nearest_node(shaft, entry.z) in (0, shaft.nodes - 1):
        yield "z", f"z = {entry.z:.6g}; allowed is between the shaft's ends, 0 and {shaft.length:.6g}"


def _film(entry: BearingEntry) -> Iterator[tuple[str, str]]:
    low, high = (factor * entry.diameter / 2.0 for factor in RELATIVE_CLEARANCE)
    if not low <= entry.clearance <= high:
        yield (
            "clearance",
            f"clearance = {entry.clearance!r}; allowed is the radial clearance in m, {low:.3g} to {high:.3g} "
            f"(1e-4 to 1e-2 of the radius) for diameter {entry.diameter:g}; did you give mm or the diametral "
            "one?",
        )
    elif entry.roughness > 0.1 * entry.clearance:
        yield (
            "roughness",
            f"roughness = {entry.roughness!r}; allowed is at most a tenth of the clearance, "
            f"{0.1 * entry.clearance:.3g} m",
        )
    if 0.0 < entry.contact_modulus < SOFTEST_CONTACT:
        yield (
            "contact_modulus",
            f"contact_modulus = {entry.contact_modulus!r}; allowed is 0, for no solid contact, or at least "
            f"{SOFTEST_CONTACT:g} Pa; did you give MPa?",
        )


def _seat(shaft: Train, entry: BearingEntry) -> Iterator[tuple[str, str]]:
    """A bearing sits on a journal of its own diameter that reaches over its whole width."""
    node = nearest_node(shaft, entry.z)
    sides = [(s.surface(0.0), s.surface(1.0)) for s in shaft.shoulders]
    at = [sides[node - 1][1]] if node else []
    at += [sides[node][0]] if node < len(sides) else []
    if any(abs(d - entry.diameter) > POSITION_TOLERANCE for d in at):
        there = f"{at[0]:g}"
        if len(at) == 2 and abs(at[0] - at[1]) > POSITION_TOLERANCE:
            there += f" in front and {at[1]:g} behind, so a place where both are the same"
        yield (
            "diameter",
            f"diameter = {entry.diameter!r}; allowed is the shaft's own diameter there, {there}, or any with "
            "sleeve = true",
        )
        return
    other = [
        k for k, side in enumerate(sides) if any(abs(d - entry.diameter) > POSITION_TOLERANCE for d in side)
    ]
    # At its very ends the shaft may end within the bearing.
    front = max((shaft.z[k + 1] for k in other if k < node), default=0.0 if node else -math.inf)
    rear = min(
        (shaft.z[k] for k in other if k >= node), default=shaft.length if at[1:] or not node else math.inf
    )
    room = 2.0 * min(entry.z - front, rear - entry.z)
    if entry.width > room + 2.0 * POSITION_TOLERANCE:
        yield (
            "width",
            f"width = {entry.width!r}; allowed is at most {room:.6g}: the journal of this diameter reaches "
            f"from z = {max(front, 0.0):.6g} to {min(rear, shaft.length):.6g}",
        )


def _body(entry: WheelEntry | MassEntry) -> Iterator[tuple[str, str]]:
    # Of any body, I_polar = 2 I_transverse - 2 m <z^2>: a thin disc is the limit.
    if entry.polar_inertia > 2.0 * entry.transverse_inertia * (1.0 + 1e-6):
        yield (
            "polar_inertia",
            f"polar_inertia = {entry.polar_inertia!r}; allowed is at most twice the transverse_inertia, "
            f"{2.0 * entry.transverse_inertia:g}, which a thin disc has",
        )


def order_problems(
    shaft: Train, kind: str, entries: Sequence[Placed], nodes: Sequence[int]
) -> Iterator[Problem]:
    """Yield bearings or couplings out of order, or in one another."""
    for index, ((before, first), (after, second)) in enumerate(
        pairwise(zip(entries, nodes, strict=True)), start=1
    ):
        if second <= first:
            yield (
                (kind, index, "z"),
                f"{kind} {after.name!r}: z = {shaft.z[second]:.6g}; allowed is more than that of "
                f"{before.name!r} before it, {shaft.z[first]:.6g}",
            )
        elif isinstance(before, BearingEntry) and isinstance(after, BearingEntry):
            apart = shaft.z[second] - shaft.z[first]
            if apart < (needed := 0.5 * sum(b.width for b in (before, after) if b.has_film)):
                yield (
                    (kind, index, "z"),
                    f"bearing {after.name!r} overlaps {before.name!r}: their middles are {apart:.6g} m "
                    f"apart; allowed is at least half their widths together, {needed:.6g}",
                )


def rotor_problems(shaft: Train, couplings: Sequence[Placed], nodes: Nodes) -> Iterator[Problem]:
    """Yield rotors between couplings that stand on no bearing, and a train on fewer than two."""
    names = ["the front end", *(repr(c.name) for c in couplings), "the rear end"]
    cuts = [0, *nodes["coupling"], shaft.nodes - 1]
    for (front, rear), (first, last) in zip(pairwise(names), pairwise(cuts), strict=True):
        inside = range(first + (first > 0), last + (last == shaft.nodes - 1))
        if not any(node in inside for node in nodes["bearing"]):
            yield (), f"bearing: none between {front} and {rear}; allowed is at least one"
    if len(nodes["bearing"]) < 2:
        yield (), f"bearing: {len(nodes['bearing'])} in all; allowed are at least two"


def side_problems(data: TrainToml, nodes: Nodes) -> Iterator[Problem]:
    """Yield what sits at the place of an elastic coupling without saying on which side, and the contrary."""
    couplings = zip(data.coupling, nodes["coupling"], strict=True)
    elastic = {node: coupling.name for coupling, node in couplings if coupling.elastic}
    bodies: dict[str, Sequence[WheelEntry | MassEntry]] = {"wheel": data.wheel, "mass": data.mass}
    for kind, entries in bodies.items():
        for index, (entry, node) in enumerate(zip(entries, nodes[kind], strict=True)):
            if node in elastic and entry.side is None:
                text = (
                    f"the elastic coupling {elastic[node]!r} is there, too; allowed is side = front or rear"
                )
                yield (kind, index, "z"), f"{kind} {entry.name!r}: z = {entry.z!r}: {text}"
            elif node not in elastic and entry.side is not None:
                text = f"side = {entry.side!r}; allowed is it at the z of an elastic coupling"
                yield (kind, index, "side"), f"{kind} {entry.name!r}: {text}"
    for index, (bearing, node) in enumerate(zip(data.bearing, nodes["bearing"], strict=True)):
        if node in elastic:
            text = f"the elastic coupling {elastic[node]!r} is there; allowed is beside it"
            yield ("bearing", index, "z"), f"bearing {bearing.name!r}: z = {bearing.z!r}: {text}"
    without = [index for index, bearing in enumerate(data.bearing) if bearing.height is None]
    if without and len(without) < len(data.bearing):
        name = data.bearing[without[0]].name
        yield (
            ("bearing", without[0]),
            f"bearing {name!r}: height: missing; it must be given for all bearings or for none",
        )


def speed_problems(speed: float, diameter: float, name: str) -> Iterator[Problem]:
    """Yield a speed [rad/s] that no journal of this diameter [m] has, such as one in rev/min."""
    surface = 0.5 * diameter * speed
    if surface > FASTEST_JOURNAL:
        yield (
            ("speed",),
            f"speed = {speed!r}: the journal of {name!r} would run at {surface:.4g} m/s; allowed is at most "
            f'{FASTEST_JOURNAL:g} m/s. It is in rad/s; did you give rev/min? Those are "{speed:g} rpm"',
        )


def load_problems(train: Train) -> Iterator[Problem]:
    """Yield loads that leave no balance, and bearings whose film does not carry the static load."""
    from rotor_fmu.shaft.statics import target_loads  # with scipy, which nothing else here needs

    try:
        loads = target_loads(train)
    except ValueError as error:
        yield (), str(error)
        return
    if any(seat.height is not None for seat in train.bearings):
        return  # how far journals sink decides
    for index, (seat, load) in enumerate(zip(train.bearings, loads.tolist(), strict=True)):
        if seat.coefficients:
            continue  # stiffness and damping carry whatever there is
        most = most_load(seat, train.speed)
        if abs(load) > most:
            yield (
                ("bearing", index, "load"),
                f"bearing {seat.name!r}: static load {load:.4g} N; its film carries at most {most:.3g} N at "
                f"the eccentricity ratio {ECCENTRICITY:g} (Sommerfeld number "
                f"{seat.sommerfeld(abs(load), train.speed):.3g}). Check viscosity {seat.viscosity:g} Pa s, "
                f"clearance {seat.clearance:g} m, width {seat.width:g} m, speed {train.speed:g} rad/s and "
                "the masses",
            )
