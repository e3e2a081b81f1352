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
from dataclasses import astuple, replace

from fmus.port.arc import ROUND, TURN, Arc, Bore, check

PLAIN = "plain"
"""The word for a bore without arcs."""

__all__ = [
    "PLAIN",
    "TURN",
    "Arc",
    "Bore",
    "check",
    "from_text",
    "grooved",
    "lobes",
    "pads_in",
    "pocketed",
    "room",
    "room_in",
    "tilting",
    "to_text",
]


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


def tilting(
    count: int, arc: float, preload: float, offset: float = 0.5, first: float = 0.0, compliance: float = 0.0
) -> Bore:
    """A bore of equal tilting pads, each in the middle of its share of the turn.

    Parameters
    ----------
    count : int
        How many.
    arc : float
        Angle that a pad covers.
    preload : float
        1 - least gap at the pivots of the centred journal over the clearance between pad and journal.
    offset : float
        Where the pivot is, as the share of the pad's length from its start; in the sense from x to y.
    first : float
        Angle at which the share of the first pad begins.
    compliance : float
        Of each pivot, m/N.
    """
    share = TURN / count
    starts = [first + (k + 0.5) * share - 0.5 * arc for k in range(count)]
    return tuple(Arc(start, start + arc, preload, start + offset * arc, compliance) for start in starts)


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
                if start - arc.start > ROUND:
                    left.append(Arc(arc.start, start, arc.preload, arc.towards))
                arc = Arc(min(stop, arc.end), arc.end, arc.preload, arc.towards)
            if arc.length > ROUND:
                left.append(arc)
        parts = left
    return _joined(parts)


def pocketed(bore: Sequence[Arc], pockets: Sequence[tuple[float, float, float, float, bool]]) -> Bore:
    """Cut pockets into a bore; ValueError where one does not lie on one arc.

    Parameters
    ----------
    bore : sequence of Arc
        Its arcs; those of a plain bore are one of a full turn.
    pockets : sequence of (float, float, float, float, bool)
        Angle of the middle and width of each in rad, share of the bearing's width, depth over the clearance,
        and whether it holds the feed pressure.
    """
    parts = list(bore)
    for middle, width, share, depth, fed in pockets:
        left: list[Arc] = []
        start = middle - 0.5 * width
        for arc in parts:
            low = arc.start + (start - arc.start + ROUND) % TURN - ROUND
            if arc.share > 0.0 or low + width > arc.end + ROUND:
                left.append(arc)
                continue
            pieces = ((arc.start, low), (low, low + width), (low + width, arc.end))
            for number, (here, there) in enumerate(pieces):
                if there - here > ROUND:
                    one = Arc(here, there, arc.preload, arc.towards)
                    left.append(replace(one, depth=depth, share=share, fed=fed) if number == 1 else one)
        if len(left) == len(parts) and left == parts:
            raise ValueError(
                f"pocket of {math.degrees(width):.6g} deg at {math.degrees(middle):.6g} deg; allowed is a "
                "place on one arc, between its grooves and other pockets"
            )
        parts = left
    return tuple(parts)


def _joined(parts: Sequence[Arc]) -> Bore:
    """The arcs; two of one circle that meet where a turn ends are one."""
    if len(parts) > 1:
        first, last = parts[0], parts[-1]
        if (
            abs(first.start + TURN - last.end) < ROUND
            and first.shift == last.shift
            and not (first.share or last.share)
        ):
            joined = Arc(last.start - TURN, first.end, first.preload, first.towards)
            return (joined, *parts[1:-1])
    return tuple(parts)


def room(bore: Sequence[Arc], angle: float) -> float:
    """Displacement from the middle in a direction at which a journal touches the bore, over the clearance."""
    return min((arc.room(angle) for arc in bore), default=1.0)


def to_text(bore: Sequence[Arc]) -> str:
    """Text of a bore for a unit's parameter, see `from_text`."""
    rows = [_row(arc) for arc in bore]
    return json.dumps(rows, allow_nan=False) if bore else PLAIN


def from_text(text: str) -> Bore:
    """The bore of a text: "plain", or ``[[start, end, preload, towards], ...]`` in rad.

    A tilting pad has a fifth number, the compliance of its pivot; a pocket has null there, and behind it
    depth, share and fed, see `Arc`.

    Raises
    ------
    ValueError
        What is wrong with it.
    """
    if text.strip() in ("", PLAIN):
        return ()
    try:
        rows = json.loads(text)
        arcs = [_arc(*row) for row in rows]
    except (ValueError, TypeError) as error:
        allowed = f'"{PLAIN}" or [[start, end, preload, towards], ...] in rad'
        raise ValueError(f"{text[:60]!r} is no bore; allowed is {allowed}") from error
    return check(arcs)


def pads_in(text: str) -> int:
    """Number of tilting pads of a bore's text."""
    return sum(arc.tilts for arc in from_text(text))


def room_in(text: str, angle: float) -> float:
    """`room` in a bore of a text."""
    return room(from_text(text), angle)


def _row(arc: Arc) -> list[float | bool | None]:
    """Numbers of an arc, up to the last that is not as usual."""
    row: list[float | bool | None] = list(astuple(arc))
    return row if arc.share > 0.0 else row[: 4 if arc.compliance is None else 5]


def _arc(
    start: float,
    end: float,
    preload: float = 0.0,
    towards: float = 0.0,
    compliance: float | None = None,
    depth: float = 0.0,
    share: float = 0.0,
    fed: bool = False,
) -> Arc:
    """An arc of the numbers of a text."""
    place = float(start), float(end), float(preload), float(towards)
    pivot = None if compliance is None else float(compliance)
    return Arc(*place, pivot, float(depth), float(share), bool(fed))
