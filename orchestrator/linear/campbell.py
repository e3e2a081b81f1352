"""Data of the Campbell diagrams: free-free and on linearised films, unreduced and reduced."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from orchestrator.linear.case import FULL, HERTZ, REDUCTIONS, LinearCase
from orchestrator.linear.operating_point import OverSpeed
from rotor_fmu.linear.analysis import (
    ModesAt,
    ReducedShaft,
    ShaftModel,
    Tracks,
    distinct,
    follow,
    free_branches,
    irs_iterates,
    matched,
    modal_truncation,
    whirl_modes,
)

Array = NDArray[np.float64]

FREE_STEPS = 20
SUPPORTED_STEPS = 25
"""Intervals of the axis of speed."""

STRONGEST_DAMPING = 0.95
"""Damping ratio beyond which a mode counts as overdamped and is left out."""

LIGHT = 0.3
"""Damping ratio up to which a mode that is none at rated speed is shown all the same."""

NO_MODE = complex(np.nan, np.nan)

OVERDAMPED = 6
"""Modes asked for beyond those shown, in place of overdamped ones."""

IRS_ITERATIONS = 50
"""Shown of plain IRS; some frequencies at speed still fall when those at rest have long converged."""


def free_data(case: LinearCase, count: int, highest: float) -> tuple[xr.Dataset, xr.Dataset]:
    """Free-free frequencies (shaft, rotation, direction, mode), and errors over the iterations of IRS."""
    rotation = np.linspace(0.0, highest, FREE_STEPS + 1)
    z = case.shaft.z
    found = {name: free_branches(shaft, z, HERTZ * rotation, count) for name, shaft in case.shafts.items()}
    limit = free_branches(modal_truncation(case.shaft, case.size), z, HERTZ * rotation, count)
    iterates = list(irs_iterates(case.shaft, IRS_ITERATIONS, size=case.size))
    iterations = _iterations(case, iterates, count, rotation[[0, FREE_STEPS // 2, FREE_STEPS]])
    last = free_branches(iterates[-1], z, HERTZ * rotation, count)
    found |= {f"irs-plain, {IRS_ITERATIONS} iterations": last, "modal truncation": limit}
    frequency = np.array([branches.both for branches in found.values()]) / HERTZ
    error = np.array([branches.error(found[FULL]) for branches in found.values()])
    dims = ("shaft", "rotation", "direction", "mode")
    data = xr.Dataset(
        {
            "frequency": (dims, frequency, {"units": "Hz", "long_name": "free-free whirl frequency"}),
            "error": (dims, error, {"units": "1", "long_name": "relative error against the unreduced shaft"}),
        },
        _coordinates(list(found), rotation)
        | {"direction": ["backward", "forward"], "mode": ("mode", np.arange(1, count + 1), {"units": ""})},
        {"title": f"Campbell diagram, free-free: {case.train.name}", "degrees_of_freedom": case.size},
    )
    return data, iterations


def _iterations(
    case: LinearCase, iterates: Sequence[ReducedShaft], count: int, rotation: Array
) -> xr.Dataset:
    """Frequencies and errors of plain IRS after each iteration (iteration, rotation, direction, mode)."""
    exact = free_branches(case.shaft, case.shaft.z, HERTZ * rotation, count)
    steps = [free_branches(shaft, case.shaft.z, HERTZ * rotation, count) for shaft in iterates]
    dims = ("iteration", "rotation", "direction", "mode")
    return xr.Dataset(
        {
            "frequency": (dims, np.array([step.both for step in steps]) / HERTZ, {"units": "Hz"}),
            "error": (dims, np.array([step.error(exact) for step in steps]), {"units": "1"}),
        },
        {
            "iteration": np.arange(IRS_ITERATIONS + 1),
            "rotation": ("rotation", rotation, {"units": "Hz"}),
            "direction": ["backward", "forward"],
            "mode": np.arange(1, count + 1),
        },
        {
            "title": f"Iterated IRS, free-free whirl frequencies: {case.train.name}",
            "name": "irs-iterations",
            "comment": "iteration 0 is Guyan's static condensation",
        },
    )


def supported_data(case: LinearCase, films: OverSpeed, count: int, highest: float) -> xr.Dataset:
    """Eigenvalues on the films of each speed (shaft, rotation, mode), followed over speed from the rated one.

    Those of the reductions are matched with those of the unreduced shaft; NaN where a mode is overdamped, or
    none at all.
    """
    rotation = np.linspace(0.0, highest, SUPPORTED_STEPS + 1)
    speeds, missing = films.reachable(list(distinct([*HERTZ * rotation, case.train.speed])))
    rated, number = int(np.argmin(np.abs(np.array(speeds) - case.train.speed))), 2 * count
    last = max(int(np.searchsorted(speeds, HERTZ * highest * (1.0 + 1e-9))), rated + 1)
    tracks = follow(
        modes_on(case.shaft, films, number + OVERDAMPED), speeds[:last], rated, number + OVERDAMPED
    )
    exact, direction = _whirling(tracks, rated, number)
    shown = slice(0, None) if speeds[last - 1] <= HERTZ * highest * (1.0 + 1e-9) else slice(0, rated)
    exact, direction, speeds = exact[shown], direction[shown], speeds[:last][shown]
    values = {FULL: exact}
    for method in REDUCTIONS:
        modes_at = modes_on(case.reduced(method), films, number + 3 * OVERDAMPED)
        offered = [modes_at(speed).eigenvalues for speed in speeds]
        values[method] = np.array([_matched(a, b) for a, b in zip(exact, offered, strict=True)])
    eigenvalues = np.array(list(values.values()))
    error = np.abs(eigenvalues - eigenvalues[0]) / np.abs(eigenvalues[0])
    dims = ("shaft", "rotation", "mode")
    ratio = -eigenvalues.real / np.abs(eigenvalues)
    return xr.Dataset(
        {
            "frequency": (dims, eigenvalues.imag / HERTZ, {"units": "Hz", "long_name": "damped frequency"}),
            "damping_ratio": (dims, ratio, {"units": "1", "long_name": "damping ratio"}),
            "error": (dims, error, {"units": "1", "long_name": "error of the eigenvalue, to its modulus"}),
            "whirl_direction": (
                dims[1:],
                direction,
                {"units": "1", "long_name": "whirl direction, -1 backward to 1 forward"},
            ),
        },
        _coordinates(list(values), np.array(speeds) / HERTZ) | {"mode": np.arange(1, exact.shape[1] + 1)},
        {
            "title": f"Campbell diagram on linearised films: {case.train.name}",
            "films": case.films_over_speed,
            "degrees_of_freedom": case.size,
            **({"missing": missing} if missing else {}),
        },
    )


def modes_on(shaft: ShaftModel | ReducedShaft, films: OverSpeed, number: int) -> ModesAt:
    """Modes of a shaft at a speed, on the films of that speed; each speed is computed once."""
    return cache(lambda speed: whirl_modes(shaft, speed, number, bearings=films.at(speed).bearings))


def _whirling(tracks: Tracks, rated: int, number: int) -> tuple[NDArray, NDArray]:
    """Eigenvalues and whirl directions of modes that oscillate (speeds, modes), NaN where they do not.

    First those of rated speed, then others that are lightly damped somewhere.
    """
    eigenvalues = tracks.of(lambda modes: modes.eigenvalues)
    ratio = -eigenvalues.real / np.abs(eigenvalues)
    eigenvalues = np.where(ratio < STRONGEST_DAMPING, eigenvalues, NO_MODE)
    at_rated = np.flatnonzero(np.isfinite(eigenvalues[rated]))[:number]
    highest = np.nanmax(eigenvalues[:, at_rated].imag)
    known = np.isfinite(eigenvalues)
    least = np.min(np.where(known, ratio, np.inf), axis=0)
    low = np.min(np.where(known, eigenvalues.imag, np.inf), axis=0) < highest
    others = np.flatnonzero((tracks.index[rated] < 0) & (least < LIGHT) & low)
    chosen = [*at_rated, *others]
    direction = np.where(known, tracks.of(lambda modes: modes.direction), np.nan)
    return eigenvalues[:, chosen], direction[:, chosen]


def _matched(exact: NDArray, offered: NDArray) -> NDArray:
    """The offered eigenvalues that belong to the exact ones; NaN where there is none."""
    known = np.isfinite(exact)
    found = np.full(exact.shape, NO_MODE)
    found[known] = matched(exact[known], offered)
    return found


def _coordinates(methods: list[str], rotation: Array) -> dict[str, object]:
    return {
        "shaft": methods,
        "rotation": ("rotation", rotation, {"units": "Hz", "long_name": "speed of rotation"}),
    }
