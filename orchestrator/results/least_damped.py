"""The least damped mode of a train at the start of its run, in the record and out of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results.quantities import HERTZ
from rotor_fmu.linear.analysis import LeastDamped, LinearBearings, least_damped, unreduced_shaft

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from rotor_fmu.train.train import Train

_FREQUENCY, _GROWTH = "least_damped_frequency", "least_damped_growth"


def least_damped_attributes(train: Train, speed: float, tangents: NDArray[np.float64]) -> dict[str, float]:
    """Attributes of a record: frequency [Hz] and growth rate [1/s] of the least damped mode.

    Parameters
    ----------
    train : Train
        Its unreduced shaft counts.
    speed : float
        [rad/s].
    tangents : ndarray (bearings, 4, 8)
        Stiffness and damping [K C] of the bearings in their static position; none: nothing is known.
    """
    if len(tangents) != len(train.bearings) or not np.all(np.isfinite(tangents)):
        return {}
    stiffness, damping = np.split(tangents, 2, axis=2)
    mode = least_damped(unreduced_shaft(train), speed, LinearBearings(stiffness, damping))
    return {_FREQUENCY: mode.frequency / HERTZ, _GROWTH: mode.growth}


def least_damped_of(record: xr.Dataset) -> LeastDamped | None:
    """The least damped mode that a record tells, or None."""
    if _FREQUENCY not in record.attrs:
        return None
    return LeastDamped(HERTZ * float(record.attrs[_FREQUENCY]), float(record.attrs[_GROWTH]))
