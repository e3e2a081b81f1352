"""Speeds at which a response must be computed so that no resonance is missed, however sharp."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import scipy  # scipy.optimize is loaded where it is used: few runs need it
from numpy.typing import ArrayLike, NDArray

from rotor_fmu.linear.tracking import ModesAt, Tracks, modal_assurance
from rotor_fmu.linear.whirl import WhirlModes

Array = NDArray[np.float64]

AROUND = np.array([0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0])
"""Points on each side of a resonance in its half widths."""

NEAR = 1e-4
"""Of the interval in which a peak lies; its height then is off by less than the square of this."""

ALIKE = 1e-10
"""Relative difference up to which speeds are the same."""

SHARPEST = 1e-6
"""Least half width over speed; an undamped resonance has none."""


def resonances(tracks: Tracks, modes_at: ModesAt, speeds: ArrayLike) -> list[tuple[float, float]]:
    """Where damped frequencies cross the speed of rotation.

    Parameters
    ----------
    tracks : Tracks
        Modes followed over the speeds.
    modes_at : callable
        Modes of a speed between them.
    speeds : array_like, (S,)
        [rad/s], ascending.

    Returns
    -------
    list of (float, float)
        Speed [rad/s] and damping ratio of each.
    """
    at = np.asarray(speeds, dtype=np.float64)
    lead = tracks.of(lambda modes: modes.frequency) - at[:, None]
    found = []
    for k, track in zip(*np.nonzero(lead[:-1] * lead[1:] < 0.0), strict=True):
        ahead = partial(_ahead, modes_at, tracks.modes[k], int(tracks.index[k, track]))
        try:
            root = float(
                scipy.optimize.brentq(
                    lambda speed, ahead=ahead: ahead(speed)[0], at[k], at[k + 1], rtol=1e-10
                )
            )
        except ValueError:  # its shape changes so fast that another one is taken for it at an end
            root = 0.5 * float(at[k] + at[k + 1])
        found.append((root, ahead(root)[1]))
    return found


def _ahead(modes_at: ModesAt, known: WhirlModes, which: int, speed: float) -> tuple[float, float]:
    """Frequency of a mode over the speed [rad/s], and its damping ratio, known by its shape nearby."""
    modes = modes_at(speed)
    nearness = np.abs(modes.eigenvalues - known.eigenvalues[which]) / speed
    best = int(np.argmax(modal_assurance(known, modes)[which] - nearness))
    return float(modes.frequency[best] - speed), float(modes.damping_ratio[best])


def refined(
    amplitude: Callable[[float], float | Array], grid: ArrayLike, poles: list[tuple[float, float]]
) -> Array:
    """A grid with points closely around resonances, and the peaks of the response themselves.

    Parameters
    ----------
    amplitude : callable
        The response at a speed [rad/s], positive; of several probes an array, whose peaks all are found.
    grid : array_like, (S,)
        Ascending speeds.
    poles : list of (float, float)
        Speed and damping ratio of resonances, see `resonances`.
    """
    speeds = np.asarray(grid, dtype=np.float64)
    low, high = speeds[0], speeds[-1]
    more = [speeds]
    for pole, ratio in poles:
        half = pole * max(abs(ratio), SHARPEST)
        more.append(np.concatenate([pole - half * AROUND, [pole], pole + half * AROUND]))
    speeds = distinct(np.concatenate(more))
    speeds = speeds[(speeds >= low) & (speeds <= high)]
    for probe in range(np.size(amplitude(high))):
        peaks = _peaks(lambda speed: float(np.ravel(amplitude(speed))[probe]), speeds)  # noqa: B023 (called here)
        speeds = distinct(np.concatenate([speeds, peaks]))
    return speeds


def distinct(speeds: ArrayLike) -> Array:
    """Speeds in ascending order, without those that differ by rounding, between which it would make peaks."""
    found = np.unique(np.asarray(speeds, dtype=np.float64))
    return found[np.diff(found, prepend=-np.inf) > ALIKE * found]


def _peaks(amplitude: Callable[[float], float], speeds: Array) -> list[float]:
    """Speeds between those of a grid at which a response is largest."""
    values = np.array([amplitude(speed) for speed in speeds])
    peaks = []
    for k in np.flatnonzero((values[1:-1] > values[:-2]) & (values[1:-1] >= values[2:])) + 1:
        around = float(speeds[k - 1]), float(speeds[k + 1])
        best = scipy.optimize.minimize_scalar(
            lambda speed: -np.log(amplitude(speed)),
            bounds=around,
            method="bounded",
            options={"xatol": max(NEAR * (around[1] - around[0]), 1e-9 * speeds[k])},
        )
        if amplitude(best.x) > values[k]:
            peaks.append(float(best.x))
    return peaks
