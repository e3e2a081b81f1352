"""What a user may write: checked by mypy, on each change, against the types of `bladeloss`."""

from __future__ import annotations

from pathlib import Path

import bladeloss
import numpy as np
import xarray as xr
from numpy.typing import NDArray


def worst_gap(scenario: str, unbalance: float) -> float:
    """Least gap of a run in m; of a run that fails, that of what was simulated."""
    try:
        record = bladeloss.run(scenario, depth="v3", event__unbalance=unbalance)
    except bladeloss.RunError as error:
        record = error.record
    return float(record["least_gap_min"].min())


def judged(folder: Path, page: Path) -> str:
    """What follows from a run; its page is made besides."""
    record: xr.Dataset = bladeloss.load(folder)
    written: Path = bladeloss.report(record, out=page, bearing=str(record["bearing"].values[0]))
    conclusion: str = bladeloss.conclusion(record)
    table: xr.Dataset = bladeloss.verdicts(folder)
    return f"{written}: {conclusion}, {table.sizes['verdict']} verdicts"


def stiffness(depth: str, place: NDArray[np.float64]) -> dict[str, float]:
    """Outputs of a bearing at a place of its journal."""
    evaluate = bladeloss.bearing(depth, diameter=0.2, width=0.12, clearance=2e-4, viscosity=0.03)
    return evaluate(q=place, speed=314.16)


def loads(train: str) -> dict[str, float]:
    """Where the bearings of a train sit in m."""
    machine = bladeloss.train(train)
    return {seat.name: machine.z[seat.node] for seat in machine.bearings}


def half_axes(record: xr.Dataset, bearing: str) -> tuple[float, float]:
    """Of the 1X orbit before the event in m."""
    first, *_ = bladeloss.phases(record)
    steady = record.sel(time=slice(first.mean.start, first.mean.end))
    motion = steady["displacement"].sel(bearing=bearing)
    x, y = bladeloss.order_amplitudes(steady["time"], motion, float(record.attrs["speed"]), [1.0])[0]
    orbit = bladeloss.whirl_of(complex(x), complex(y))
    return orbit.major, orbit.minor
