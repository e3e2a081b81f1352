"""The unbalance response of a train on the films of each speed, at speeds that miss no resonance."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from orchestrator.linear.campbell import OVERDAMPED, modes_on
from orchestrator.linear.case import HERTZ, LinearCase
from orchestrator.linear.operating_point import OverSpeed
from rotor_fmu.linear.analysis import (
    HarmonicResponse,
    ModesAt,
    ReducedShaft,
    ShaftModel,
    Tracks,
    distinct,
    follow,
    half_axes,
    refined,
    resonances,
    unbalance_response,
)

Array = NDArray[np.float64]

INTERVALS = 120
"""Of the axis of speed, before points are added at resonances."""

TRACKED_INTERVALS = 30
"""Of the axis over which modes are followed to find the resonances."""

MODES = 24
"""Followed."""


class Response:
    """Unbalance response of a shaft at any speed; each is computed once."""

    def __init__(self, case: LinearCase, shaft: ShaftModel | ReducedShaft, films: OverSpeed) -> None:
        unbalance, train = case.unbalance, case.train
        self._nodes = [*(seat.node for seat in train.bearings), *(wheel.node for wheel in train.wheels)]
        self._at = cache(lambda speed: unbalance_response(shaft, speed, films.at(speed).bearings, unbalance))

    def at(self, speed: float) -> HarmonicResponse:
        """At a speed [rad/s]."""
        return self._at(float(speed))

    def amplitudes(self, speed: float) -> Array:
        """Largest half axis of every node's orbit [m], (nodes,)."""
        shape = self.at(speed).shape
        return half_axes(shape[0::4], shape[1::4])[0]

    def watched(self, speed: float) -> Array:
        """Amplitudes whose peaks are looked for [m]: the largest of the shaft, bearings, wheels."""
        every = self.amplitudes(speed)
        return np.concatenate([[every.max()], every[self._nodes]])


@dataclass(frozen=True)
class Followed:
    """Modes followed over speed.

    Attributes
    ----------
    speeds : list of float
        [rad/s], ascending.
    tracks : Tracks
        The modes there.
    modes_at : callable
        Modes of these and of any other speed; each is computed once.
    missing : str
        Why speeds are left out, or nothing.
    """

    speeds: list[float]
    tracks: Tracks
    modes_at: ModesAt
    missing: str


def followed(case: LinearCase, films: OverSpeed, highest: float) -> Followed:
    """Follow the modes up to a frequency of rotation [Hz]."""
    grid = np.linspace(0.0, highest, TRACKED_INTERVALS + 1)
    rated = case.train.speed if case.train.speed <= HERTZ * highest else HERTZ * highest
    speeds, missing = films.reachable(list(distinct([*HERTZ * grid, rated])))
    modes_at = modes_on(case.shaft, films, MODES + OVERDAMPED)
    reference = int(np.argmin(np.abs(np.array(speeds) - rated)))
    return Followed(speeds, follow(modes_at, speeds, reference, MODES), modes_at, missing)


def resonant_speeds(case: LinearCase, response: Response, along: Followed) -> Array:
    """Speeds [rad/s] over the range over which modes were followed, with all resonances among them."""
    first, last = along.speeds[0], along.speeds[-1]
    grid = np.linspace(0.0, last, INTERVALS + 1)[1:]
    rated = [case.train.speed] if case.train.speed <= last else []
    grid = np.union1d(grid[grid >= first], rated)
    return refined(response.watched, grid, resonances(along.tracks, along.modes_at, along.speeds))
