"""The bore of a bearing: plain, or arcs between axial grooves; what trains, units and films say of it.

Angles run from x to y, with the rotation of a positive speed.  Seen from the middle of the bearing an arc is
part of a circle whose centre is moved, so that with lengths over the clearance C between this circle and
the journal the gap is ::

    H = 1 - x cos(phi) - y sin(phi) - preload cos(phi - towards)

What no arc covers is a groove over the whole width that holds the feed pressure.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import astuple, dataclass
from itertools import pairwise

PLAIN = "plain"
"""The word for a bore without arcs."""

MOST_ARCS = 12
TURN = 2.0 * math.pi
_STEP = 1e-9  # of the gap where two arcs touch, over the clearance
_ROUND = 1e-12  # of angles


@dataclass(frozen=True)
class Arc:
    """A part of a bore with one centre.

    Attributes
    ----------
    start, end : float
        Where it begins and ends, in rad from x to y; ``start < end <= start + 2 pi``.
    preload : float
        By how much its centre is moved, over the clearance: 1 - least gap of the centred journal over C
        where the arc reaches that far; 0 to less than 1.
    towards : float
        Angle at which the arc comes closest to a centred journal.
    """

    start: float
    end: float
    preload: float = 0.0
    towards: float = 0.0

    @property
    def length(self) -> float:
        """Angle that it covers."""
        return self.end - self.start

    @property
    def shift(self) -> tuple[float, float]:
        """What is added to a position to have it seen from the arc's centre, over the clearance."""
        return self.preload * math.cos(self.towards), self.preload * math.sin(self.towards)

    def gap(self, angle: float, x: float = 0.0, y: float = 0.0) -> float:
        """Gap over the clearance at an angle."""
        sx, sy = self.shift
        return 1.0 - (x + sx) * math.cos(angle) - (y + sy) * math.sin(angle)

    def covers(self, angle: float) -> bool:
        """Whether an angle lies on the arc."""
        return (angle - self.start) % TURN <= self.length

    def room(self, angle: float) -> float:
        """Displacement in a direction, over the clearance, at which the journal touches the arc.

        Infinity where it never does.
        """
        # gap 0 at phi: r = (1 - preload cos(phi - towards)) / cos(phi - angle); inside the arc e(r) = 1
        ends = [(self.gap(phi), math.cos(phi - angle)) for phi in (self.start, self.end)]
        reach = min((gap / along for gap, along in ends if along > _ROUND), default=math.inf)
        mixed = self.preload * math.cos(self.towards - angle)
        radius = math.sqrt(max(mixed * mixed + 1.0 - self.preload**2, 0.0)) - mixed
        sx, sy = self.shift
        touch = math.atan2(radius * math.sin(angle) + sy, radius * math.cos(angle) + sx)
        if self.covers(touch):
            reach = min(reach, radius)
        return reach


Bore = tuple[Arc, ...]
"""The arcs in the order of their angles; none for a plain bore."""


def check(bore: Sequence[Arc]) -> Bore:
    """Return the arcs of a bore in order.

    Raises
    ------
    ValueError
        What is wrong with which arc; angles in degrees.
    """
    if len(bore) > MOST_ARCS:
        raise ValueError(f"{len(bore)} arcs; allowed are at most {MOST_ARCS}")
    for number, arc in enumerate(bore, start=1):
        if not all(math.isfinite(value) for value in astuple(arc)):
            raise ValueError(f"arc {number}: allowed are finite numbers only")
        if not 0.0 <= arc.preload < 1.0:
            raise ValueError(f"arc {number}: preload = {arc.preload:.6g}; allowed is 0 to less than 1")
        if not math.radians(5.0) <= arc.length <= TURN + _ROUND:
            raise ValueError(
                f"arc {number}: from {math.degrees(arc.start):.6g} to {math.degrees(arc.end):.6g} deg; "
                "allowed is 5 to 360 deg from its start to its end"
            )
    ordered = tuple(sorted(bore, key=lambda arc: arc.start))
    for before, after in pairwise((*ordered, *ordered[:1])):
        turn = TURN if after is ordered[0] else 0.0
        groove = after.start + turn - before.end
        here, there = math.degrees(before.end), math.degrees(after.start)
        where = f"arcs that end at {here:.6g} and start at {there:.6g} deg"
        if groove < -_ROUND:
            raise ValueError(f"{where}: they overlap by {math.degrees(-groove):.3g} deg")
        if groove <= _ROUND and abs(before.gap(before.end) - after.gap(after.start)) > _STEP:
            raise ValueError(f"{where}: the gap has a step; allowed is a step in a groove between them only")
    return ordered


def lobes(count: int, preload: float, offset: float = 0.5, first: float = 0.0) -> Bore:
    """A bore of equal lobes that touch.

    Parameters
    ----------
    count : int
        How many.
    preload : float
        Of each.
    offset : float
        Where a lobe comes closest, as the share of its length from its start: 0.5 in its middle.
    first : float
        Angle at which one of them begins.
    """
    length = TURN / count
    starts = [first + k * length for k in range(count)]
    return tuple(Arc(start, start + length, preload, start + offset * length) for start in starts)


def grooved(bore: Sequence[Arc], grooves: Sequence[tuple[float, float]]) -> Bore:
    """Cut grooves into a bore.

    Parameters
    ----------
    bore : sequence of Arc
        Its arcs; those of a plain bore are one of a full turn.
    grooves : sequence of (float, float)
        Angle of the middle and width of each, in rad.
    """
    parts = list(bore)
    for middle, width in grooves:
        left: list[Arc] = []
        for arc in parts:
            low = (middle - 0.5 * width - arc.start) % TURN + arc.start
            for start in (low - TURN, low):
                stop = start + width
                if stop <= arc.start or start >= arc.end:
                    continue
                if start - arc.start > _ROUND:
                    left.append(Arc(arc.start, start, arc.preload, arc.towards))
                arc = Arc(min(stop, arc.end), arc.end, arc.preload, arc.towards)
            if arc.length > _ROUND:
                left.append(arc)
        parts = left
    return _joined(parts)


def _joined(parts: Sequence[Arc]) -> Bore:
    """The arcs; two of one circle that meet where a turn ends are one."""
    if len(parts) > 1:
        first, last = parts[0], parts[-1]
        if abs(first.start + TURN - last.end) < _ROUND and first.shift == last.shift:
            joined = Arc(last.start - TURN, first.end, first.preload, first.towards)
            return (joined, *parts[1:-1])
    return tuple(parts)


def room(bore: Sequence[Arc], angle: float) -> float:
    """Displacement from the middle in a direction at which a journal touches the bore, over the clearance."""
    return min((arc.room(angle) for arc in bore), default=1.0)


def to_text(bore: Sequence[Arc]) -> str:
    """Text of a bore for a unit's parameter, see `from_text`."""
    return json.dumps([astuple(arc) for arc in bore], allow_nan=False) if bore else PLAIN


def from_text(text: str) -> Bore:
    """The bore of a text: "plain", or ``[[start, end, preload, towards], ...]`` in rad.

    Raises
    ------
    ValueError
        What is wrong with it.
    """
    if text.strip() in ("", PLAIN):
        return ()
    try:
        rows = json.loads(text)
        arcs = [Arc(*(float(value) for value in row)) for row in rows]
    except (ValueError, TypeError) as error:
        allowed = f'"{PLAIN}" or [[start, end, preload, towards], ...] in rad'
        raise ValueError(f"{text[:60]!r} is no bore; allowed is {allowed}") from error
    return check(arcs)
