"""Balance of oil over cells that are full or ruptured: the complementarity problem and its solution.

The cells stand in m columns on a ring, n rows in each.  With the pressure p over that of the cavity and the
content theta, the share of the gap that oil fills, each cell balances (Jakobsson and Floberg 1957, Olsson
1965, as one problem for both zones Elrod 1981) ::

    stored theta - gained + sum of flows out = 0,   p >= 0,  theta <= 1,  p (1 - theta) = 0

    around:  carried theta_upstream - around (p_next - p)      axial:  - axial (p_next - p)

The flow that the wall carries takes the content of the cell upstream, so that no oil is lost or made.  One
unknown a cell is left, p where it is full and theta where it is not.  Given which are full the equations are
linear; the set is found as a primal-dual active set (Hintermueller, Ito and Kunisch 2002), which is
Newton's method for min(p, 1 - theta) = 0.  The matrix is an M-matrix by columns: its pivots are positive.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import kernel, stage
from bearing_fmu.kernels.unsymmetric_solver import factorise_ring, ring_work, solve_ring
from bearing_fmu.kernels.vector import padded
from bearing_fmu.status import NO_SOLUTION, NOT_CONVERGED, OK

Floats = NDArray[np.float64]

ROUNDS = 100
_SLACK = 1e-13  # of the largest pressure, and of the content
_GROWTH = 1.3  # of the slack with each round, so that rounding does not turn in circles for ever
_MOST_SLACK = 1e-5
SIDES = 8

FREE, PRESSURE, CONTENT = 0.0, 1.0, 2.0
"""What is given in a cell: nothing, the pressure of a full cell, the content of a ruptured one."""


class Network(NamedTuple):
    """Cells and what flows between them.

    Face i lies between the columns i and i + 1, the last one and the first likewise; axial face j below
    row j, the last one above the last row.  n' is n padded to whole vectors.
    """

    around: Floats  #: (n, m) conductance of the faces
    carried: Floats  #: (n, m) flow that the wall carries across a face in a full film, signed
    axial: Floats  #: (n + 1, m) conductance of the axial faces, those of the ends included
    ends: Floats  #: (1,) pressure beyond the ends
    stored: Floats  #: (n, m) what a full cell stores
    gained: Floats  #: (n, m) what a cell had, and what is added
    held: Floats  #: (n, m) FREE, PRESSURE or CONTENT
    given: Floats  #: (n, m) value of it
    full: Floats  #: (n, m) 1 where the cell is full; on entry a guess
    pressure: Floats  #: (n, m) result
    content: Floats  #: (n, m) result
    blocks: Floats  #: (3, m n n') factor
    lower: Floats  #: (m n',) couplings of the matrix
    upper: Floats  #: (m n',)
    sides: Floats  #: (SIDES m n',) right-hand sides, then solutions
    work: Floats  #: of `ring_work`


def network(columns: int, rows: int) -> Network:
    """Arrays of a new network."""
    n, m, width = rows, columns, padded(rows)
    cells = {
        name: np.zeros((n, m))
        for name in ("around", "carried", "stored", "gained", "held", "given", "full", "pressure", "content")
    }
    return Network(
        axial=np.zeros((n + 1, m)),
        ends=np.zeros(1),
        blocks=np.zeros((3, m * n * width)),
        lower=np.zeros(m * width),
        upper=np.zeros(m * width),
        sides=np.zeros(SIDES * m * width),
        work=ring_work(n),
        **cells,
    )


@stage
def _assemble(net: Network) -> None:
    """Matrix, its blocks transposed as the solver wants them, and right-hand side for the present set."""
    n, m = net.full.shape
    width = net.lower.shape[0] // m
    block = n * width
    b, ends = net.blocks[0], net.ends[0]
    b[:] = 0.0
    for j in range(n):
        around, carried, stored, gained = net.around[j], net.carried[j], net.stored[j], net.gained[j]
        full, held, given = net.full[j], net.held[j], net.given[j]
        below, above = net.axial[j], net.axial[j + 1]
        for i in range(m):
            back = i - 1 if i > 0 else m - 1
            fore = i + 1 if i + 1 < m else 0
            at, place = i * width + j, i * block + j * width + j
            if held[i] != FREE:
                b[place] = 1.0
                net.upper[at] = 0.0
                net.lower[back * width + j] = 0.0
                net.sides[at] = given[i]
                continue
            leaves = stored[i] + max(carried[i], 0.0) + max(-carried[back], 0.0)
            from_back, from_fore = max(carried[back], 0.0), max(-carried[i], 0.0)
            side = gained[i]
            if full[i] != 0.0:
                b[place] = around[i] + around[back] + below[i] + above[i]
                side -= leaves
            else:
                b[place] = leaves
            if full[back] != 0.0:
                net.lower[back * width + j] = around[back]
                side += from_back
            else:
                net.lower[back * width + j] = from_back
            if full[fore] != 0.0:
                net.upper[at] = around[i]
                side += from_fore
            else:
                net.upper[at] = from_fore
            if j == 0:
                side += below[i] * ends
            elif net.full[j - 1, i] != 0.0:
                b[place - width] = -below[i]
            if j == n - 1:
                side += above[i] * ends
            elif net.full[j + 1, i] != 0.0:
                b[place + width] = -above[i]
            net.sides[at] = side


@stage
def _unfold(net: Network) -> float:
    """Pressure and content of the solution; returns the largest pressure."""
    n, m = net.full.shape
    width = net.lower.shape[0] // m
    largest = 0.0
    for j in range(n):
        pressure, content, full = net.pressure[j], net.content[j], net.full[j]
        for i in range(m):
            value = net.sides[i * width + j]
            pressure[i] = value if full[i] != 0.0 else 0.0
            content[i] = 1.0 if full[i] != 0.0 else value
            largest = max(largest, pressure[i])
    return largest


@stage
def _move_fronts(net: Network, largest: float, attempt: int) -> bool:
    """Rupture cells that pull, fill cells that hold more than their gap; True if any changed."""
    n, m = net.full.shape
    slack = min(_SLACK * _GROWTH**attempt, _MOST_SLACK)
    pull, brim = -slack * largest, 1.0 + slack
    changed = False
    for j in range(n):
        pressure, content, full, held = net.pressure[j], net.content[j], net.full[j], net.held[j]
        for i in range(m):
            if held[i] == FREE:
                if full[i] != 0.0:
                    if pressure[i] < pull:
                        full[i] = 0.0
                        changed = True
                elif content[i] > brim:
                    full[i] = 1.0
                    changed = True
    return changed


@kernel
def balance(net: Network) -> tuple[int, int]:
    """Find pressure and content; leaves the factor of the matrix.

    Returns
    -------
    status, rounds : int
        A code of `FilmStatus`, and how many factorisations it took.
    """
    n, m = net.full.shape
    width = net.lower.shape[0] // m
    b, w, y = net.blocks[0], net.blocks[1], net.blocks[2]
    for j in range(n):
        for i in range(m):
            if net.held[j, i] != FREE:
                net.full[j, i] = 1.0 if net.held[j, i] == PRESSURE else 0.0
    for attempt in range(ROUNDS):
        _assemble(net)
        if not factorise_ring(b, net.lower, net.upper, w, y, net.work, m, n, width):
            return NO_SOLUTION, attempt
        solve_ring(b, net.lower, net.upper, w, y, net.sides, net.work, m, n, width, 1)
        largest = _unfold(net)
        if not _move_fronts(net, largest, attempt):
            return OK, attempt + 1
    return NOT_CONVERGED, ROUNDS
