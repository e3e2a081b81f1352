"""Data of the Campbell diagrams: free-free and on linearised films, unreduced and reduced."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from orchestrator.linear.case import FULL, HERTZ, REDUCTIONS, LinearCase
from rotor_fmu.linear.analysis import (
    ReducedShaft,
    WhirlModes,
    campbell,
    free_branches,
    irs_iterates,
    matched,
    modal_truncation,
)

Array = NDArray[np.float64]

FREE_STEPS = 20
SUPPORTED_STEPS = 25
"""Intervals of the axis of speed."""

STRONGEST_DAMPING = 0.95
"""Damping ratio beyond which a mode counts as overdamped and is left out."""

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


def supported_data(case: LinearCase, count: int, highest: float) -> xr.Dataset:
    """Eigenvalues on the films (shaft, rotation, mode), matched with those of the unreduced shaft."""
    rated = round(case.train.speed / HERTZ, 9)
    rotation = np.linspace(0.0, highest, SUPPORTED_STEPS + 1)
    rotation = np.union1d(rotation, [rated]) if rated < highest else rotation
    bearings, number = case.operating_point.bearings, 2 * count
    found = campbell(case.shaft, HERTZ * rotation, number + OVERDAMPED, bearings=bearings)
    kept = [_whirling(modes, number) for modes in found]
    offers = {
        method: campbell(case.reduced(method), HERTZ * rotation, number + 2 * OVERDAMPED, bearings=bearings)
        for method in REDUCTIONS
    }
    fewest = min(len(modes.eigenvalues) for offered in offers.values() for modes in offered)
    number = min(fewest, *(len(k) for k in kept))
    exact = np.array([modes.eigenvalues[k[:number]] for modes, k in zip(found, kept, strict=True)])
    direction = np.array([modes.direction[k[:number]] for modes, k in zip(found, kept, strict=True)])
    values = {FULL: exact}
    for method, offered in offers.items():
        values[method] = np.array([matched(a, b.eigenvalues) for a, b in zip(exact, offered, strict=True)])
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
        _coordinates(list(values), rotation) | {"mode": np.arange(1, number + 1)},
        {
            "title": f"Campbell diagram on linearised films: {case.train.name}",
            "films": case.films,
            "degrees_of_freedom": case.size,
        },
    )


def _whirling(modes: WhirlModes, count: int) -> NDArray[np.intp]:
    """The lowest modes that oscillate; pairs on their way to two real eigenvalues do not."""
    return np.flatnonzero(modes.damping_ratio < STRONGEST_DAMPING)[:count]


def _coordinates(methods: list[str], rotation: Array) -> dict[str, object]:
    return {
        "shaft": methods,
        "rotation": ("rotation", rotation, {"units": "Hz", "long_name": "speed of rotation"}),
    }
