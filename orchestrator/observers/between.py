"""What bearings tell between two of their evaluations, at instants that a coupling of many rates passes over.

With s the share of the time from one evaluation to the next, held the values of the first:

- wrench: the law of the first at the motion of the instant, which the rotor knows, and s^2 of what it has
  missed at the next: a law is a tangent, so what it misses begins with the square;
- least gaps and eccentricity: those of the motion in a round bore, and what differs from them at the two
  evaluations, straight in between; in bores of another shape straight altogether;
- position of the least gap: that of the nearer evaluation;
- all else: straight between both.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from orchestrator.master.system import RESPONSE, law_wrenches
from orchestrator.observers.waiting import (
    BEARING,
    FIRST_RECORD,
    LAST_RECORD,
    ROOM,
    Passed,
    note_evaluations,
    note_record,
)

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Numbers = NDArray[np.intp]
Told = tuple[Array, Array]
"""What all bearings tell: outputs, and details that only some films have, (n, i) and (n, j)."""

WORDS = (
    "wrenches: the law of the evaluation before and the square of the share of time of what it missed at "
    "the next; gaps from the motion; all else straight between evaluations"
)
"""For the record."""

_ROUND = 0.05
"""Share of the clearance by which a least gap may differ from that of a round bore and still follow it."""

_FORCE, _LAW = slice(0, 4), slice(4, 40)
_NEARER = RESPONSE["h_min_z"]


class Bores:
    """The round bores nearest to those of the bearings.

    Parameters
    ----------
    clearances, widths : iterable of float
        In m.
    offsets : ndarray (bearings, 4)
        Their centres.
    """

    def __init__(self, clearances: Iterable[float], widths: Iterable[float], offsets: Array) -> None:
        self.clearance = np.array(list(clearances))
        self._half, self.offsets = 0.5 * np.array(list(widths)), offsets.copy()

    def move(self, bearing: int, coordinate: int, by: float) -> None:
        """Move a bore, as an event does."""
        self.offsets[bearing, coordinate] += by

    def gaps(self, bearing: Numbers, motion: Array, offsets: Array) -> tuple[Array, Array]:
        """Least gaps over these bearings' films, and in their middle, (m,) in m.

        Of motions (m, 8), with the bores' centres at offsets (m, 4).
        """
        x, y, tilt_x, tilt_y = (motion[:, :4] - offsets).T
        half, clearance = self._half[bearing], self.clearance[bearing]
        ends = [np.hypot(x + side * half * tilt_y, y - side * half * tilt_x) for side in (-1.0, 1.0)]
        return clearance - np.maximum(*ends), clearance - np.hypot(x, y)


class Between:
    """Holds what bearings told last, and what follows between then and their next evaluation.

    Parameters
    ----------
    bores : Bores
        For the gaps.
    outputs : int
        How many values bearings tell.

    Attributes
    ----------
    stands : ndarray (bearings,)
        When each was evaluated last, in s.
    first : ndarray of int (bearings,)
        Its first record that waits, else the number of records.
    """

    def __init__(self, bores: Bores, outputs: int) -> None:
        count = len(bores.clearance)
        self._bores = bores
        self.stands, self.first = np.zeros(count), np.zeros(count, dtype=np.intp)
        self._values, self._motion = np.zeros((count, outputs)), np.zeros((count, 8))
        self._passed, self._held, self._filled = Passed.room(ROOM + count, outputs), 0, 0

    def kept(self, row: int, waits: Mask, told: Told, motion: Array) -> None:
        """Note a record, for which some bearings wait, with what all tell and where they stand."""
        note_record(row, waits, self.first, self._values, self._motion, *told, motion)

    def evaluated(self, done: Mask, end: float, rows: int, told: Told, motion: Array) -> bool:
        """Note that these bearings stand at `end`, where there are so many records.

        Returns whether enough waits have ended to look at them, see `fill`.
        """
        about = self.stands, self.first, self._values, self._motion, *told, motion, self._bores.offsets
        self._held = note_evaluations(done, end, rows, *about, *self._passed, self._held)
        return self._held >= ROOM

    def waits(self, rows: int) -> bool:
        """Whether any of so many records waits."""
        return self.complete < rows

    @property
    def filled(self) -> int:
        """Pairs of record and bearing that waited and are complete."""
        numbers = self._passed.numbers[: self._held]
        return self._filled + int((numbers[:, LAST_RECORD] - numbers[:, FIRST_RECORD]).sum())

    def fill(
        self, times: Array, motion: Callable[[Numbers, Numbers], Array]
    ) -> tuple[Numbers, Numbers, Array] | None:
        """What waited and does no longer: records, bearings, and what those told then, (m, outputs).

        Parameters
        ----------
        times : ndarray
            Of all records in s.
        motion : callable
            q and v of the journals in their housings, (m, 8), in records of bearings.
        """
        if not self._held:
            return None
        passed = self._passed.rows(slice(self._held))
        self._filled, self._held = self.filled, 0
        first, last, bearing = passed.numbers.T
        counts = last - first
        each = np.repeat(np.arange(len(counts)), counts)
        rows = first[each] + np.arange(len(each)) - np.repeat(np.cumsum(counts) - counts, counts)
        found = passed.rows(each)
        start, end = found.instants.T
        share = (times[rows] - start) / (end - start)
        return rows, bearing[each], self._told(found, share, motion(rows, bearing[each]))

    @property
    def complete(self) -> int:
        """The number of records that nothing waits for; some may be left to `fill`."""
        return int(self.first.min())

    def arrays(self) -> dict[str, NDArray[Any]]:
        """All that it holds, by name."""
        counts = {"first": self.first, "filled": np.array(self.filled), "stands": self.stands}
        return {
            **counts, "values": self._values, "motion": self._motion, "offsets": self._bores.offsets,
        }  # fmt: skip

    def restore(self, arrays: Mapping[str, NDArray[Any]]) -> int:
        """Go on from what `arrays` returned, its names behind `between.`; returns `complete`."""
        self.first[:], self.stands[:] = arrays["between.first"], arrays["between.stands"]
        self._values[:], self._motion[:] = arrays["between.values"], arrays["between.motion"]
        self._bores.offsets[:] = arrays["between.offsets"]
        self._filled, self._held = int(arrays["between.filled"]), 0
        return self.complete

    def _told(self, found: Passed, share: Array, motion: Array) -> Array:
        """What bearings told at shares, (m,), of the time between evaluations, in motion (m, 8)."""
        bearing, before, after = found.numbers[:, BEARING], found.told[:, 0], found.told[:, 1]
        motion_before, motion_after = found.motion[:, 0], found.motion[:, 1]
        result = before + share[:, None] * (after - before)
        law = before[:, _LAW]
        missed = after[:, _FORCE] - law_wrenches(law, motion_after)
        result[:, _FORCE] = law_wrenches(law, motion) + share[:, None] ** 2 * missed
        result[:, _NEARER] = np.where(share < 0.5, before[:, _NEARER], after[:, _NEARER])
        ways = [self._bores.gaps(bearing, x, found.offsets) for x in (motion_before, motion, motion_after)]
        over, centre = (np.array(kind) for kind in zip(*ways, strict=True))
        clearance = self._bores.clearance[bearing]
        least, middle = RESPONSE["h_min"], RESPONSE["h_min_centre"]
        _follow(result, before, after, share, least, _nearer(before[:, least], over, centre), clearance)
        _follow(result, before, after, share, middle, centre, clearance)
        eccentricity = RESPONSE["eccentricity"]
        _follow(result, before, after, share, eccentricity, 1.0 - centre / clearance, np.ones_like(share))
        return result


def _nearer(start: Array, over: Array, centre: Array) -> Array:
    """The least gaps of a film that sees tilts or of one that does not, as it begins."""
    return np.where(np.abs(start - over[0]) <= np.abs(start - centre[0]), over, centre)


def _follow(
    result: Array, before: Array, after: Array, share: Array, at: int, way: Array, size: Array
) -> None:
    """Let an output follow its way in a round bore, (3, m) before, in between and after, if it does there."""
    off = before[:, at] - way[0], after[:, at] - way[2]
    follows = np.maximum(np.abs(off[0]), np.abs(off[1])) <= _ROUND * size
    result[:, at] = np.where(follows, way[1] + off[0] + share * (off[1] - off[0]), result[:, at])
