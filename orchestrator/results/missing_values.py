"""Values that a unit did not give at some instants: they are left out of statistics, and told."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr


@dataclass(frozen=True)
class MissingValues:
    """A quantity of a bearing that is no number in some samples.

    Attributes
    ----------
    bearing, quantity : str
        Of the record.
    count, samples : int
        How many are missing, of how many.
    first : float
        Instant of the first [s].
    """

    bearing: str
    quantity: str
    count: int
    samples: int
    first: float


def missing_values(record: xr.Dataset) -> tuple[MissingValues, ...]:
    """Quantities of bearings with numbers in some samples and none in others.

    What has no number at all is what a depth does not have: stiffness and damping have no gap.
    """
    found = []
    for name, series in record.data_vars.items():
        if series.dims[:2] != ("time", "bearing") or series.dtype.kind != "f":
            continue
        empty = np.isnan(series.values)
        empty = empty.any(axis=tuple(range(2, empty.ndim)))
        count = empty.sum(axis=0)
        for i in np.flatnonzero((count > 0) & (count < len(empty))):
            first = float(record["time"].values[int(np.argmax(empty[:, i]))])
            bearing = str(record["bearing"].values[i])
            found.append(MissingValues(bearing, str(name), int(count[i]), len(empty), first))
    return tuple(found)


def missing_text(missing: tuple[MissingValues, ...]) -> str:
    """What is missing, in one sentence with a warning."""
    return "WARNING: no number, and left out of the statistics: " + "; ".join(
        f"{one.quantity} of {one.bearing} in {one.count} of {one.samples} samples, first at {one.first:.4g} s"
        for one in missing
    )
