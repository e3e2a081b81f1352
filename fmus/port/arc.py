"""An arc of a bore, and what makes arcs a bore, see `fmus.port.bore`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import astuple, dataclass
from itertools import pairwise

from fmus.port.details import MOST_PADS

MOST_ARCS = 12
TURN = 2.0 * math.pi
ROUND = 1e-12
"""Of angles."""
_STEP = 1e-9  # of the gap where two arcs touch, over the clearance


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
    compliance : float or None
        Of a tilting pad with its pivot at `towards`: how far the pivot gives way, in m/N, 0 for a rigid one;
        None: the arc is fixed.
    depth, share, fed : float, float, bool
        Of a pocket over the whole arc: how much deeper, over the clearance, which share of the width, about
        the mid-plane, and whether it holds the feed pressure. Without a pocket the share is 0.
    """

    start: float
    end: float
    preload: float = 0.0
    towards: float = 0.0
    compliance: float | None = None
    depth: float = 0.0
    share: float = 0.0
    fed: bool = False

    @property
    def tilts(self) -> bool:
        """Whether it is a tilting pad."""
        return self.compliance is not None

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

        Infinity where it never does. A tilting pad turns away until the journal stands at its pivot.
        """
        if self.tilts:
            along = math.cos(self.towards - angle)
            return (1.0 - self.preload) / along if along > ROUND else math.inf
        # gap 0 at phi: r = (1 - preload cos(phi - towards)) / cos(phi - angle); inside the arc e(r) = 1
        ends = [(self.gap(phi), math.cos(phi - angle)) for phi in (self.start, self.end)]
        reach = min((gap / along for gap, along in ends if along > ROUND), default=math.inf)
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
        if not all(math.isfinite(value) for value in astuple(arc) if value is not None):
            raise ValueError(f"arc {number}: allowed are finite numbers only")
        if not 0.0 <= arc.preload < 1.0:
            raise ValueError(f"arc {number}: preload = {arc.preload:.6g}; allowed is 0 to less than 1")
        if not math.radians(5.0) <= arc.length <= TURN + ROUND:
            raise ValueError(
                f"arc {number}: from {math.degrees(arc.start):.6g} to {math.degrees(arc.end):.6g} deg; "
                "allowed is 5 to 360 deg from its start to its end"
            )
        if arc.compliance is not None:
            _check_pad(number, arc, arc.compliance)
        if not (0.0 <= arc.share <= 1.0 and 0.0 <= arc.depth <= 1e3):
            raise ValueError(
                f"arc {number}: pocket over {arc.share:.6g} of the width, {arc.depth:.6g} clearances deep; "
                "allowed are 0 to 1 and 0 to 1000"
            )
    if len(bore) > MOST_PADS and bore[0].tilts:
        raise ValueError(f"{len(bore)} pads that tilt; allowed are at most {MOST_PADS}")
    if any(arc.tilts for arc in bore) and not all(arc.tilts for arc in bore):
        raise ValueError("arcs that tilt beside fixed ones; allowed are all or none")
    ordered = tuple(sorted(bore, key=lambda arc: arc.start))
    for before, after in pairwise((*ordered, *ordered[:1])):
        turn = TURN if after is ordered[0] else 0.0
        groove = after.start + turn - before.end
        here, there = math.degrees(before.end), math.degrees(after.start)
        where = f"arcs that end at {here:.6g} and start at {there:.6g} deg"
        if groove < -ROUND:
            raise ValueError(f"{where}: they overlap by {math.degrees(-groove):.3g} deg")
        if groove <= ROUND and (before.tilts or after.tilts):
            raise ValueError(f"{where}: allowed is a groove between pads that tilt")
        if groove <= ROUND and abs(before.gap(before.end) - after.gap(after.start)) > _STEP:
            raise ValueError(f"{where}: the gap has a step; allowed is a step in a groove between them only")
    return ordered


def _check_pad(number: int, arc: Arc, compliance: float) -> None:
    ahead = (arc.towards - arc.start) % TURN
    if arc.length >= math.pi or not 0.0 < ahead < arc.length:
        raise ValueError(
            f"arc {number}: pad from {math.degrees(arc.start):.6g} to {math.degrees(arc.end):.6g} deg with "
            f"its pivot at {math.degrees(arc.towards):.6g} deg; allowed is less than 180 deg, pivot on it"
        )
    if arc.share > 0.0:
        raise ValueError(f"arc {number}: a pocket in a pad that tilts; allowed is none")
    if not 0.0 <= compliance < 1e-3:
        raise ValueError(f"arc {number}: compliance = {compliance:.6g} m/N; allowed is 0 to 1e-3")
