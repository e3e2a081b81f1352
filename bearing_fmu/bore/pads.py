"""A bore of arcs between grooves: what the kernels know of it, and the grid that goes with the journal.

Each arc has its own graded grid, which begins and ends at its ends: the Moebius map of `kernels.grid` with
the position as the arc sees it, the uniform angle between the images of the ends.  Columns in grooves and at
the ends of arcs hold the feed pressure; there the grid rests.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.kernels.copied import copy
from bearing_fmu.kernels.grid import COS, LAND, METRIC, MOTION, RING_ROWS, SIN, STRETCHING, grade
from fmus.port.bore import TURN, Arc

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]

#: Cells that an arc has at least.
FEWEST = 4
#: Widest piece of a groove between two columns.
_PIECE = np.pi / 4.0
_TOUCH = 1e-12
#: How near the map of an arc comes to that of a journal which touches, see `grade`.
_MOST = 0.998


class Pads(NamedTuple):
    """The arcs of a bore over m columns; face i lies between the columns i and i + 1."""

    shift: Floats  #: (arcs, 2) what is added to the position to have it seen from the arc's centre
    ends: Floats  #: (arcs, 2) angles at which it starts and ends
    edges: Floats  #: (arcs, 2, 2) their cos and sin
    first: Whole  #: (arcs,) its first column
    cells: Whole  #: (arcs,) cells between its first and its last column
    centre: Floats  #: (2, 2, m) `shift` at columns and faces
    inside: Floats  #: (2, m) 1 on arcs, their ends included; 0 in grooves
    deep: Floats  #: (2, m) how much deeper pockets are
    reach: Floats  #: (2, m) to which |z| over half the width, -1 without a pocket
    fed: Floats  #: (m,) 1 in columns whose pocket holds the feed pressure
    held: Whole  #: columns that hold the feed pressure
    rest: Floats  #: (2, RING_ROWS, m) what of the grid does not move


def cells_of(bore: Sequence[Arc], columns: int) -> tuple[list[int], list[int]]:
    """Cells of each arc and of the groove behind it.

    Raises
    ------
    ValueError
        Too few columns for the arcs.
    """
    grooves = [after.start - before.end for before, after in pairwise(bore)]
    grooves.append(bore[0].start + TURN - bore[-1].end)
    behind = [int(np.ceil(width / _PIECE)) if width > _TOUCH else 0 for width in grooves]
    left = columns - sum(behind)
    whole = sum(arc.length for arc in bore)
    if left < FEWEST * len(bore):
        needed = FEWEST * len(bore) + sum(behind)
        raise ValueError(
            f"bearing parameter columns = {columns!r}: must be at least {needed} for the {len(bore)} arcs "
            "of the bore"
        )
    wanted = [max(FEWEST, left * arc.length / whole) for arc in bore]
    cells = [int(share) for share in wanted]
    while sum(cells) != left:
        step = 1 if sum(cells) < left else -1
        lack = [step * (share - have) - (1e9 if have + step < FEWEST else 0.0)
                for share, have in zip(wanted, cells, strict=True)]  # fmt: skip
        cells[int(np.argmax(lack))] += step
    return cells, behind


def pads(bore: Sequence[Arc], columns: int, split: tuple[list[int], list[int]] | None = None) -> Pads:
    """Prepare a bore for films of `columns`, by default `split` as `cells_of` does."""
    cells, behind = split or cells_of(bore, columns)
    first = np.concatenate(([0], np.cumsum(np.add(cells, behind))[:-1])).astype(np.int64)
    centre, inside = np.zeros((2, 2, columns)), np.zeros((2, columns))
    rest, held = np.zeros((2, RING_ROWS, columns)), set()
    deep, reach, fed = np.zeros((2, columns)), np.full((2, columns), -1.0), np.zeros(columns)
    cell = TURN / columns
    for k, arc in enumerate(bore):
        at, count, pieces = int(first[k]), cells[k], behind[k]
        for side, here in ((0, np.arange(at, at + count + 1)), (1, np.arange(at, at + count))):
            here = here % columns
            centre[side][:, here] = np.array(arc.shift)[:, None]
            inside[side, here] = 1.0
        if arc.share > 0.0:
            inner, edges = np.arange(at + 1, at + count) % columns, np.arange(at, at + count + 1) % columns
            between = np.arange(at, at + count) % columns
            deep[0, inner] = deep[1, between] = arc.depth
            reach[0, edges] = reach[1, between] = arc.share
            fed[edges] = float(arc.fed)
        last = at + count
        width = (bore[(k + 1) % len(bore)].start - arc.end) % TURN / max(pieces, 1)
        for i in range(pieces):
            start, end = arc.end + i * width, arc.end + (i + 1) * width
            face, ahead = (last + i) % columns, (last + i + 1) % columns
            held |= {face, ahead}
            middle = 0.5 * (start + end)
            rest[1, COS, face], rest[1, SIN, face] = np.cos(middle), np.sin(middle)
            rest[1, METRIC, face] = width / cell
            # a constant pressure times cos and sin is integrated exactly
            for column, angle in ((face, start), (ahead, end)):
                rest[0, METRIC, column] += np.tan(0.5 * width) / cell
                rest[0, COS, column], rest[0, SIN, column] = np.cos(angle), np.sin(angle)
    ends = np.array([(arc.start, arc.end) for arc in bore])
    return Pads(
        shift=np.array([arc.shift for arc in bore]),
        ends=ends,
        edges=np.stack((np.cos(ends), np.sin(ends)), axis=2),
        first=first,
        cells=np.array(cells, dtype=np.int64),
        centre=centre,
        inside=inside,
        deep=deep,
        reach=reach,
        fed=fed,
        held=np.array(sorted(held), dtype=np.int64),
        rest=rest,
    )


@inner_kernel
def seen_from(pads: Pads, pad: int, q: Floats, seen: Floats) -> None:
    """Position of the journal as an arc sees it."""
    seen[0], seen[1] = q[0] + pads.shift[pad, 0], q[1] + pads.shift[pad, 1]
    seen[2], seen[3] = q[2], q[3]


@inner_kernel
def place_pads(pads: Pads, q: Floats, coordinates: int, grading: Floats, rings: Floats) -> None:
    """Place columns and faces on all arcs; see `kernels.grid.place`.

    Parameters
    ----------
    q : ndarray, shape (4,)
        Position over the clearance, tilts times half the width over the clearance.
    coordinates : int
        For how many of the coordinates the motion is wanted: 4, or 2 for an aligned journal.
    grading : ndarray, shape (7, 4)
        Work space.
    rings : ndarray, shape (2, RING_ROWS, m)
        Result.
    """
    copy(pads.rest.reshape(-1), rings.reshape(-1))
    m = rings.shape[2]
    a, da, seen = grading[0, :2], grading[1:3], grading[6]
    for pad in range(pads.first.shape[0]):
        seen_from(pads, pad, q, seen)
        grade(seen, _MOST, a, da, grading[3:, :2])
        _place_pad(pads, pad, coordinates, a, da, rings)
    for side in range(2):
        for i in range(m):
            if pads.inside[side, i] != 0.0:
                for k in range(coordinates):
                    rings[side, STRETCHING + k, i] /= rings[side, METRIC, i]


@inner_kernel
def _place_pad(pads: Pads, pad: int, coordinates: int, a: Floats, da: Floats, rings: Floats) -> None:
    """Place the points of one arc; the rows STRETCHING take the change of the metric itself."""
    m = rings.shape[2]
    count = pads.cells[pad]
    ax, ay = a[0], a[1]
    rest = 1.0 - ax * ax - ay * ay
    edges = pads.edges[pad]
    # w = (u - a) / (1 - conj(a) u) at both ends, u = exp(i phi)
    wx, wy, bx0, by0 = _image(edges[0, 0], edges[0, 1], ax, ay)
    endx, endy, bx1, by1 = _image(edges[1, 0], edges[1, 1], ax, ay)
    span = np.arctan2(endy * wx - endx * wy, endx * wx + endy * wy)
    if span <= _TOUCH:
        span += TURN
    turnx, turny = np.cos(0.5 * span / count), np.sin(0.5 * span / count)
    scale = span * m / (TURN * count)
    for h in range(2 * count + 1):
        side, i = h % 2, (pads.first[pad] + h // 2) % m
        ring = rings[side]
        bx, by = wx + ax, wy + ay
        inverse = 1.0 / (bx * bx + by * by)
        real, imaginary = bx * bx - by * by, 2.0 * bx * by
        end = h == 0 or h == 2 * count
        if end:
            ring[COS, i] = edges[0 if h == 0 else 1, 0]
            ring[SIN, i] = edges[0 if h == 0 else 1, 1]
        else:
            ring[COS, i] = (real * wx + imaginary * wy) * inverse
            ring[SIN, i] = (imaginary * wx - real * wy) * inverse
        part = 0.5 if end else 1.0
        metric = part * scale * rest * inverse
        ring[METRIC, i] += metric
        ring[LAND, i] += metric
        share = h / (2.0 * count)
        bend = -2.0 * (by * wx - bx * wy) * inverse
        for k in range(coordinates):
            ux, uy = 2.0 * da[0, k], 2.0 * da[1, k]
            # how the images of the ends move, then that of this point
            t0, t1 = -(bx0 * uy - by0 * ux) / rest, -(bx1 * uy - by1 * ux) / rest
            t = (1.0 - share) * t0 + share * t1
            stretch = (
                -(ax * ux + ay * uy) / rest - (bx * ux + by * uy) * inverse + bend * t + (t1 - t0) / span
            )
            ring[STRETCHING + k, i] += metric * stretch
            if not end:
                ring[MOTION + k, i] = (bx * uy - by * ux + rest * t) * inverse
        wx, wy = wx * turnx - wy * turny, wx * turny + wy * turnx


@inner_kernel
def _image(ux: float, uy: float, ax: float, ay: float) -> tuple[float, float, float, float]:
    """Image w of a point u of the circle under the inverse map, and w + a."""
    top_x, top_y = ux - ax, uy - ay
    low_x, low_y = 1.0 - (ax * ux + ay * uy), ay * ux - ax * uy
    size = 1.0 / (low_x * low_x + low_y * low_y)
    wx, wy = (top_x * low_x + top_y * low_y) * size, (top_y * low_x - top_x * low_y) * size
    return wx, wy, wx + ax, wy + ay
