"""Whether a run that reached its end time can be believed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results.least_damped import least_damped_of
from orchestrator.results.windows import instants
from orchestrator.scenario.schedule import from_attributes

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

UNRESOLVED = 0.3
"""Share of the bearing forces, both RMS over the run, that the coupling may miss.

A stable coupling misses some per cent at steps that are much too long, an unstable one everything.
"""


GROWN = 1.5
"""Whirl of the last revolutions over that of the first, from which that of an unstable train has grown."""

OBSERVED, HARMONICS = 3, 3
"""Revolutions at either end over which the whirl is measured, and harmonics of rotation left out of it."""


def unresolved(record: xr.Dataset) -> str:
    """Tell whether the coupling failed although the run went on to its end.

    Parameters
    ----------
    record : xarray.Dataset
        With the interval extremes ``defect_max`` and ``force_magnitude_max``.

    Returns
    -------
    str
        Empty, or what was missed, at which bearing the most, and when and in which state there.
    """
    order = ("time", "bearing")
    defect = record["defect_max"].transpose(*order).values
    force = record["force_magnitude_max"].transpose(*order).values
    scale = np.sqrt(np.nanmean(force**2))
    missed = np.sqrt(np.nanmean(defect**2, axis=0)) / scale
    share = float(np.sqrt(np.mean(missed**2)))
    if share <= UNRESOLVED:
        return ""
    bearing = int(np.argmax(missed))
    sample = int(np.argmax(np.nan_to_num(defect[:, bearing])))
    return (
        f"the coupling missed {100.0 * share:.3g} % of the bearing forces (RMS), most at "
        f"{record['bearing'].values[bearing]}{_state(record.isel(bearing=bearing, time=sample))}; "
        f"allowed are {100.0 * UNRESOLVED:.3g} %"
    )


def grown(record: xr.Dataset) -> str:
    """Tell whether an unstable train's orbit grew before the first event, or in a run without one.

    Parameters
    ----------
    record : xarray.Dataset
        With the attributes that `orchestrator.results.least_damped` writes.

    Returns
    -------
    str
        Empty, or how far it grew, at which bearing the most, and the mode.
    """
    mode = least_damped_of(record)
    if mode is None or mode.stable:
        return ""
    time = record["time"].values
    end = next(iter(instants(record)), float(time[-1]))
    schedule = from_attributes(record.attrs)
    span = schedule.later(0.0, OBSERVED)
    windows = [(time >= start - 1e-9) & (time <= start + span + 1e-9) for start in (time[0], end - span)]
    if end - time[0] < 2.0 * span or min(np.count_nonzero(w) for w in windows) < 4 * (2 * HARMONICS + 1):
        return ""
    path = record["displacement"].transpose("time", "bearing", "axis").values
    phase = schedule.speed * time
    first, last = (_whirl(path[w], phase[w]) for w in windows)
    worst = int(np.argmax(last))
    if last[worst] < GROWN * first[worst]:
        return ""
    return (
        f"apart from what turns with the shaft, the whirl at {record['bearing'].values[worst]} grew from "
        f"{1e6 * first[worst]:.3g} to {1e6 * last[worst]:.3g} um (RMS) by t = {end:.4g} s; unstable is the "
        f"mode of {mode}"
    )


def _whirl(path: Array, phase: Array) -> Array:
    """RMS of what is no harmonic of the rotation in paths (time, bearing, axis) over phases (time,)."""
    orders = phase[:, None] * np.arange(1, HARMONICS + 1)
    basis = np.hstack([np.ones((len(phase), 1)), np.cos(orders), np.sin(orders)])
    flat = path.reshape(len(phase), -1)
    rest = (flat - basis @ np.linalg.lstsq(basis, flat, rcond=None)[0]).reshape(path.shape)
    return np.asarray(np.sqrt((rest**2).sum(axis=2).mean(axis=0)))


def _state(at: xr.Dataset) -> str:
    """Say when, and where the journal was then, as far as the record knows."""
    if "time" not in at or "eccentricity" not in at:
        return ""
    tilt = 1e6 * (at["tilt"].values - at["offset_tilt"].values)
    return (
        f", worst at t = {float(at['time']):.6g} s (eccentricity ratio {float(at['eccentricity']):.4g}, "
        f"tilts {tilt[0]:.4g} and {tilt[1]:.4g} urad, least gap {1e6 * float(at['least_gap']):.4g} um)"
    )
