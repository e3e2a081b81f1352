"""Modes followed over speed, through crossings: each is assigned to the one whose shape is most like it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy  # scipy.optimize is loaded where it is used: few runs need it
from numpy.typing import NDArray

from rotor_fmu.linear.whirl import WhirlModes

Array = NDArray[np.float64]
Index = NDArray[np.intp]

ALIKE = 0.8
"""MAC of two shapes from which they are the same mode without a look in between."""

UNLIKE = 0.2
"""MAC below which two shapes are no mode that has changed."""

HALVINGS = 2
"""Of the interval between two speeds over which a shape changes much."""

ModesAt = Callable[[float], WhirlModes]


@dataclass(frozen=True, eq=False)
class Tracks:
    """Modes over S speeds.

    Attributes
    ----------
    modes : tuple of WhirlModes
        Of each speed.
    index : ndarray of int, (S, tracks)
        Which of them a track is; -1 where it is none.  The first tracks are the modes of the reference.
    """

    modes: tuple[WhirlModes, ...]
    index: Index

    def of(self, values: Callable[[WhirlModes], NDArray]) -> NDArray:
        """A quantity of the modes (S, tracks); NaN where a track has no mode."""
        rows = []
        for modes, index in zip(self.modes, self.index, strict=True):
            row = values(modes)[index]
            rows.append(np.where(index < 0, np.nan, row))
        return np.array(rows)


def modal_assurance(a: WhirlModes, b: WhirlModes) -> Array:
    """MAC of the deflections of all modes of both, (a, b), from 0 to 1 for the same shape.

    Allemang and Brown 1982: |a^H b|^2 / (a^H a) (b^H b).  The shapes are complex, so that forward and
    backward whirl of the same deflection are orthogonal.
    """
    first, second = (_deflections(modes) for modes in (a, b))
    return np.asarray(np.abs(first.conj().T @ second) ** 2)


def follow(modes_at: ModesAt, speeds: Sequence[float], reference: int, count: int) -> Tracks:
    """Follow modes from one speed to all others.

    Parameters
    ----------
    modes_at : callable
        Modes of a speed [rad/s]; some more than `count`, so that none is lost at the end of the list.
    speeds : sequence of float
        Ascending [rad/s].
    reference : int
        Index of the speed at which the modes are numbered.
    count : int
        Modes of each speed, from the lowest frequency, that are followed.

    Returns
    -------
    Tracks
        Modes that first appear away from the reference have tracks behind the others.
    """
    modes = [modes_at(speed) for speed in speeds]
    wanted = min(count, len(modes[reference].eigenvalues))
    index = np.full((len(speeds), wanted), -1)
    index[reference] = np.arange(wanted)
    for way in (range(reference, 0, -1), range(reference, len(speeds) - 1)):
        for k in way:
            to = k - 1 if way.step < 0 else k + 1
            link = _link(modes_at, (speeds[k], modes[k]), (speeds[to], modes[to]), count, HALVINGS)
            index[to] = np.where(index[k] < 0, -1, link[index[k]])
            fresh = np.setdiff1d(np.arange(min(count, len(modes[to].eigenvalues))), index[to])
            more = np.full((len(speeds), len(fresh)), -1)
            more[to] = fresh
            index = np.hstack([index, more])
    return Tracks(tuple(modes), index)


def most_alike(a: WhirlModes, b: WhirlModes) -> tuple[Index, Array]:
    """For each mode of `a` the one of `b`, each used once, or -1; and how alike they are."""
    alike = modal_assurance(a, b)
    left, right = a.eigenvalues[:, None], b.eigenvalues
    apart = np.abs(left - right) / (np.abs(left) + np.abs(right))
    rows, columns = scipy.optimize.linear_sum_assignment(1.0 - alike + apart)
    found, quality = np.full(len(alike), -1), np.zeros(len(alike))
    quality[rows] = alike[rows, columns]
    found[rows] = np.where(quality[rows] > UNLIKE, columns, -1)
    return found, quality


def _link(
    modes_at: ModesAt, here: tuple[float, WhirlModes], there: tuple[float, WhirlModes], count: int, left: int
) -> Index:
    """As `most_alike`, by way of speeds in between where a shape changes much."""
    found, quality = most_alike(here[1], there[1])
    if left == 0 or np.all(quality[:count] > ALIKE):
        return found
    middle = 0.5 * (here[0] + there[0])
    between = middle, modes_at(middle)
    first = _link(modes_at, here, between, count, left - 1)
    second = _link(modes_at, between, there, count, left - 1)
    return np.where(first < 0, -1, second[first])


def _deflections(modes: WhirlModes) -> NDArray[np.complex128]:
    """Deflections of a mode, x and y of all nodes, of length 1."""
    both = np.concatenate([modes.shapes[0::4], modes.shapes[1::4]])
    return np.asarray(both / np.linalg.norm(both, axis=0))
