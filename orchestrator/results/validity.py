"""Whether a run that reached its end time can be believed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

UNRESOLVED = 0.3
"""Share of the bearing forces, both RMS over the run, that the coupling may miss.

A stable coupling misses some per cent at steps that are much too long, an unstable one everything.
"""


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


def _state(at: xr.Dataset) -> str:
    """Say when, and where the journal was then, as far as the record knows."""
    if "time" not in at or "eccentricity" not in at:
        return ""
    tilt = 1e6 * (at["tilt"].values - at["offset_tilt"].values)
    return (
        f", worst at t = {float(at['time']):.6g} s (eccentricity ratio {float(at['eccentricity']):.4g}, "
        f"tilts {tilt[0]:.4g} and {tilt[1]:.4g} urad, least gap {1e6 * float(at['least_gap']):.4g} um)"
    )
