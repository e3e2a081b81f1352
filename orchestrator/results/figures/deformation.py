"""What the drawing of the deformed train shows: the instant, the deflection, the scales."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results.windows import phases

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from rotor_fmu.train.train import Train

SHOWN_DEFLECTION = 0.05
"""Length of the largest deflection as drawn, at most, as a share of the train's length."""
SHOWN_FORCE = 0.06
"""The same of the largest force."""
TALLEST = 0.45
"""Height of a panel over its width, at most; a short train with wide wheels leaves room on either side."""
_SMALLEST = 1e-9  # m and N, so that a train at rest can be drawn


def worst_instant(record: xr.Dataset) -> int:
    """Index of the sample with the largest force at any bearing, in the last phase of the run."""
    force = record["force"].transpose("time", "bearing", "axis").values
    size = np.hypot(force[..., 0], force[..., 1]).max(axis=1)
    inside = phases(record)[-1].peak.mask(record["time"].values)
    return int(np.argmax(np.where(inside, size, -np.inf)))


def static_line(record: xr.Dataset) -> NDArray[np.float64]:
    """Static deflection, shape (nodes, 2) [m]; without one, the mean over the first phase."""
    if "static_line" in record:
        return np.asarray(record["static_line"].transpose("node", "axis").values, dtype=float)
    inside = phases(record)[0].mean.mask(record["time"].values)
    return np.asarray(record["deflection"].transpose("time", "node", "axis").values[inside].mean(axis=0))


def dynamic_deflection(record: xr.Dataset, index: int) -> NDArray[np.float64]:
    """Deflection from the static line at one sample, shape (nodes, 2) [m]."""
    deflection = record["deflection"].isel(time=index).transpose("node", "axis").values
    return np.asarray(deflection - static_line(record), dtype=float)


def nice(value: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above a value."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(step * power for step in (1.0, 2.0, 5.0) if step * power <= value))


@dataclass(frozen=True)
class Scales:
    """Scales that all panels of a figure share; the ordinate counts mm of deflection.

    Attributes
    ----------
    length : float
        Length of the train [m].
    width : float
        Length of the axis that a panel shows [m]: the train's, or more where it is short and wide.
    deflection : float
        How many times larger than the geometry the deflection is drawn.
    force : float
        Ordinate mm for one N.
    largest_force : float
        Largest component of a bearing force [N].
    limit : float
        Half the height of a panel [mm of the ordinate].
    stress : float
        Largest normal stress [Pa].
    """

    length: float
    width: float
    deflection: float
    force: float
    largest_force: float
    limit: float
    stress: float

    @property
    def millimetre(self) -> float:
        """Ordinate mm for one metre of geometry."""
        return 1e3 / self.deflection

    @property
    def aspect(self) -> float:
        """Shown length of one unit of the ordinate over one of the abscissa."""
        return self.deflection * 1e-3

    @property
    def height(self) -> float:
        """Height of a panel over its width."""
        return 2.0 * self.limit * self.aspect / self.width


def scales_of(records: Sequence[xr.Dataset], instants: Sequence[int], train: Train | None) -> Scales:
    """Scales at which deflection, forces and wheels of all runs can be seen."""
    pairs = list(zip(records, instants, strict=True))
    length = float(records[0]["z"].values[-1])
    largest = max(float(np.abs(dynamic_deflection(record, index)).max()) for record, index in pairs)
    force = max(float(np.abs(record["force"].isel(time=index).values).max()) for record, index in pairs)
    deflection = nice(SHOWN_DEFLECTION * length / max(largest, _SMALLEST))
    drawn = largest * deflection
    radius = 0.0
    if train is not None:
        diameters = [s.widest for s in train.shoulders] + [w.mean_diameter for w in train.wheels]
        radius = max(diameters) / 2
    reach = 1.05 * (drawn + max(1.1 * radius, SHOWN_FORCE * length))
    return Scales(
        length=length,
        width=max(length, 2.0 * reach / TALLEST),
        deflection=deflection,
        force=SHOWN_FORCE * length * 1e3 / deflection / max(force, _SMALLEST),
        largest_force=force,
        limit=reach * 1e3 / deflection,
        stress=max(float(record["stress"].isel(time=index).max()) for record, index in pairs),
    )
