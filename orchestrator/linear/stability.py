"""Stability and critical speeds of a train: data of the command of that name."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from orchestrator.linear.campbell import STRONGEST_DAMPING
from orchestrator.linear.case import HERTZ, LinearCase
from orchestrator.linear.operating_point import OverSpeed, bearing_data
from orchestrator.linear.response import Response, followed, resonant_speeds
from rotor_fmu.linear.analysis import (
    NOISE,
    REACH,
    CriticalSpeed,
    LeastDamped,
    Tracks,
    critical_speeds,
    least_damped_of,
    log_decrement,
    thresholds,
    undamped_critical_speeds,
)
from rotor_fmu.train.train import Train

Array = NDArray[np.float64]

LEAST_DAMPED = 8
"""Modes whose damping is shown: the least damped somewhere, of those that count there."""

MAP_POINTS, MAP_DECADES, MAP_MODES = 41, 3.0, 6
"""Stiffnesses of the map, decades each way from that of the bearings, and critical speeds of each."""


@dataclass(frozen=True)
class Stability:
    """What is found: modes over speed, thresholds [Hz], the map, the critical speeds, the bearings.

    Attributes
    ----------
    worst : list of LeastDamped
        The least damped mode at each speed.
    modes, chart, bearings : xarray.Dataset
        Damping over speed; undamped critical speeds over bearing stiffness; stiffness and damping over speed.
    thresholds : list of (float, bool)
        Speed of rotation [Hz], and whether the train is unstable above it.
    critical : list of CriticalSpeed
        Peaks of the unbalance response, in rad/s; none without unbalance.
    response : xarray.Dataset or None
        Amplitude at the bearings over speed.
    missing : str
        Why some speeds are left out.
    """

    worst: list[LeastDamped]
    modes: xr.Dataset
    chart: xr.Dataset
    bearings: xr.Dataset
    thresholds: list[tuple[float, bool]]
    critical: list[CriticalSpeed]
    response: xr.Dataset | None
    missing: str

    @property
    def peaks(self) -> xr.Dataset:
        """The critical speeds as data."""
        rows = [(c.speed / HERTZ, c.amplitude, c.amplification) for c in self.critical]
        values = np.array(rows).reshape(-1, 3).T
        words = (("speed", "Hz"), ("amplitude", "m"), ("amplification_factor", "1"))
        return xr.Dataset(
            {
                name: ("critical", column, {"units": unit})
                for (name, unit), column in zip(words, values, strict=True)
            },
            {"critical": np.arange(1, len(rows) + 1)},
            {"title": "Critical speeds: peaks of the unbalance response", "name": "critical-speeds"},
        )


def stability(case: LinearCase, films: OverSpeed, highest: float) -> Stability:
    """Investigate a train up to a frequency of rotation [Hz]."""
    along = followed(case, films, highest)
    speeds, tracks = along.speeds, along.tracks
    response, critical = None, list[CriticalSpeed]()
    if case.unbalance.any():
        at_bearings = [seat.node for seat in case.train.bearings]
        found = Response(case, case.shaft, films)
        grid = resonant_speeds(case, found, along)
        critical = critical_speeds(lambda speed: found.amplitudes(speed)[at_bearings], grid)
        response = xr.Dataset(
            {
                "amplitude": (
                    ("rotation", "bearing"),
                    np.array([found.amplitudes(speed)[at_bearings] for speed in grid]),
                    {"units": "m", "long_name": "amplitude from unbalance, largest half axis"},
                )
            },
            {
                "rotation": ("rotation", grid / HERTZ, {"units": "Hz"}),
                "bearing": [seat.name for seat in case.train.bearings],
            },
            {"title": f"Unbalance response: {case.train.name}", "name": "response"},
        )
    points = {speed: films.at(speed) for speed in speeds}
    return Stability(
        [least_damped_of(modes, speed) for modes, speed in zip(tracks.modes, speeds, strict=True)],
        _mode_data(case, tracks, speeds),
        _chart(case, films),
        standing(bearing_data(points, case.train, case.films_over_speed), case.train),
        [(root / HERTZ, above) for root, above in thresholds(along.modes_at, speeds)],
        critical,
        response,
        along.missing,
    )


def standing(bearings: xr.Dataset, train: Train) -> xr.Dataset:
    """With the stiffness of films and pedestals in series, where bearings stand on such.

    Of the motion at the speed of rotation: Z = K + i W C of the film, k - m W^2 + i W d of the pedestal; the
    real part of what both together have, in x and y.
    """
    if not any(seat.pedestal for seat in train.bearings):
        return bearings
    speed = HERTZ * bearings["rotation"].values[:, None, None, None]
    planar = np.s_[:, :, :2, :2]
    film = bearings["stiffness"].values[planar] + 1j * speed * bearings["damping"].values[planar]
    both = np.full(bearings["stiffness"].shape, np.nan)
    both[planar] = film.real
    for k, seat in enumerate(train.bearings):
        if seat.pedestal is None:
            continue
        mass, spring, damper = (np.array(x) for x in (seat.pedestal.mass, seat.pedestal.stiffness,
                                                      seat.pedestal.damping))  # fmt: skip
        for row, rotation in enumerate(speed.ravel()):
            below = np.diag(spring - mass * rotation**2 + 1j * rotation * damper)
            series = film[row, k] @ np.linalg.solve(film[row, k] + below, below)
            both[row, k, :2, :2] = series.real
    words = {"units": "N/m", "long_name": "film and pedestal in series at the speed of rotation, real part"}
    return bearings.assign(stiffness_on_pedestal=(bearings["stiffness"].dims, both, words))


def _mode_data(case: LinearCase, tracks: Tracks, speeds: list[float]) -> xr.Dataset:
    """Frequency and damping of the modes that are least damped somewhere (rotation, mode)."""
    ratio = tracks.of(lambda modes: modes.damping_ratio)
    ratio = np.where(ratio < STRONGEST_DAMPING, ratio, np.nan)
    known = np.isfinite(ratio)
    reach = REACH * np.array(speeds)[:, None]
    counts = known & ((tracks.of(lambda modes: modes.frequency) <= reach) | (ratio < -NOISE))
    counts = counts if counts.any() else known  # as `least_damped_of`, of which the verdict and the table are
    least = np.min(np.where(counts, ratio, np.inf), axis=0)
    chosen = np.sort(np.argsort(least)[: min(LEAST_DAMPED, int(counts.any(axis=0).sum()))])
    dims = ("rotation", "mode")

    def shown(values: Array) -> Array:
        return np.where(np.isfinite(ratio), values, np.nan)[:, chosen]

    return xr.Dataset(
        {
            "frequency": (
                dims,
                shown(tracks.of(lambda modes: modes.frequency)) / HERTZ,
                {"units": "Hz", "long_name": "damped frequency"},
            ),
            "damping_ratio": (dims, ratio[:, chosen], {"units": "1", "long_name": "damping ratio"}),
            "log_decrement": (
                dims,
                shown(tracks.of(log_decrement)),
                {"units": "1", "long_name": "logarithmic decrement"},
            ),
            "whirl_direction": (
                dims,
                shown(tracks.of(lambda modes: modes.direction)),
                {"units": "1", "long_name": "whirl direction, -1 backward to 1 forward"},
            ),
        },
        {
            "rotation": (
                "rotation",
                np.array(speeds) / HERTZ,
                {"units": "Hz", "long_name": "speed of rotation"},
            ),
            "mode": np.arange(1, len(chosen) + 1),
        },
        {"title": f"Stability: {case.train.name}", "films": case.films_over_speed},
    )


def _chart(case: LinearCase, films: OverSpeed) -> xr.Dataset:
    """Undamped critical speeds over the stiffness of the bearings (stiffness, mode)."""
    here = films.at(case.train.speed).bearings.stiffness
    direct = np.abs(np.concatenate([here[:, 0, 0], here[:, 1, 1]]))
    centre = np.log10(np.median(direct[direct > 0.0])) if direct.any() else 8.0
    stiffness = np.logspace(centre - MAP_DECADES, centre + MAP_DECADES, MAP_POINTS)
    found = undamped_critical_speeds(case.shaft, stiffness, MAP_MODES)
    return xr.Dataset(
        {
            "critical_speed": (
                ("stiffness", "mode"),
                found / HERTZ,
                {"units": "Hz", "long_name": "undamped critical speed, forward whirl"},
            )
        },
        {
            "stiffness": ("stiffness", stiffness, {"units": "N/m", "long_name": "stiffness of each bearing"}),
            "mode": np.arange(1, MAP_MODES + 1),
        },
        {"title": f"Undamped critical speeds: {case.train.name}", "name": "critical-speed-map"},
    )
