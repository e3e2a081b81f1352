"""Records that wait for the next evaluation of a bearing, and what bearings told at both ends of a wait.

A step notes them in one compiled loop; what follows of them `orchestrator.observers.between` works out for
many at once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import compiled, copy

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Numbers = NDArray[np.intp]

ROOM = 1024
"""Waits that are held at most; a step ends no more of them than there are bearings."""

FIRST_RECORD, LAST_RECORD, BEARING = range(3)


class Passed(NamedTuple):
    """Bearings, (k,), that were evaluated where records had waited for them.

    Attributes
    ----------
    numbers : ndarray of int (k, 3)
        The first record that waited, that behind the last, and the bearing.
    instants : ndarray (k, 2)
        When the bearing was evaluated before and now, in s.
    told : ndarray (k, 2, outputs)
        What it told.
    motion : ndarray (k, 2, 8)
        Where it stood.
    offsets : ndarray (k, 4)
        The centre of its bore.
    """

    numbers: Numbers
    instants: Array
    told: Array
    motion: Array
    offsets: Array

    @classmethod
    def room(cls, size: int, outputs: int) -> Passed:
        """Memory for so many."""
        numbers = np.zeros((size, 3), dtype=np.intp)
        return cls(
            numbers,
            np.zeros((size, 2)),
            np.zeros((size, 2, outputs)),
            np.zeros((size, 2, 8)),
            np.zeros((size, 4)),
        )

    def rows(self, chosen: slice | Numbers) -> Passed:
        """Some of them."""
        numbers, instants, told, motion, offsets = self
        parts = instants[chosen], told[chosen], motion[chosen], offsets[chosen]
        return Passed(numbers[chosen], *parts)


@compiled
def note_record(
    row: int,
    waits: Mask,
    first: Numbers,
    values: Array,
    where: Array,
    responses: Array,
    details: Array,
    motion: Array,
) -> None:
    """Note a record, for which some bearings wait.

    Parameters
    ----------
    row : int
        Its number.
    waits : ndarray of bool (n,)
        Who waits.
    first : ndarray of int (n,)
        First record that waits for each bearing, else the number of records; overwritten.
    values, where : ndarray (n, outputs), (n, 8)
        Overwritten with what those told whose first it is, and their motion.
    responses, details, motion : ndarray (n, i), (n, outputs - i), (n, 8)
        What bearings tell where they stand, and where that is.
    """
    count = responses.shape[1]
    for b in range(len(first)):
        if not waits[b]:
            first[b] = row + 1
        elif first[b] == row:
            copy(responses[b], values[b])
            copy(details[b], values[b, count:])
            copy(motion[b], where[b])


@compiled
def note_evaluations(
    done: Mask,
    end: float,
    rows: int,
    stands: Array,
    first: Numbers,
    values: Array,
    where: Array,
    responses: Array,
    details: Array,
    motion: Array,
    centres: Array,
    numbers: Numbers,
    instants: Array,
    told: Array,
    motions: Array,
    offsets: Array,
    held: int,
) -> int:
    """Note that bearings that are `done` stand at `end`, where there are so many records.

    Those for which records waited are written behind the `held` ones, in the arrays of a `Passed`; the number
    of those is returned. `stands` is overwritten with when each stands, others are as above.
    """
    count = responses.shape[1]
    for b in range(len(done)):
        if not done[b]:
            continue
        if first[b] < rows:
            numbers[held, FIRST_RECORD], numbers[held, LAST_RECORD] = first[b], rows
            numbers[held, BEARING] = b
            instants[held, 0], instants[held, 1] = stands[b], end
            copy(values[b], told[held, 0])
            copy(responses[b], told[held, 1])
            copy(details[b], told[held, 1, count:])
            copy(where[b], motions[held, 0])
            copy(motion[b], motions[held, 1])
            copy(centres[b], offsets[held])
            first[b] = rows
            held += 1
        stands[b] = end
    return held
