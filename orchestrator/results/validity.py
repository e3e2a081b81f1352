"""Whether a run that reached its end time can be believed: was the motion resolved, does the model hold.

The coupling's error is estimated at every step by the larger of two forces: the defect, which sees the
interface of rotor and bearing, and what comes of the length of the step (`orchestrator.master.step_error`).
A run counts as resolved while both measures of `ErrorEstimate` stay within `ALLOWED`.  That is set so
that no force of a finished run, at any bearing and instant, is off by more than a tenth of the largest
there; measured against converged runs of both trains, contact included, the estimate was between 0.5 and
2.5 times the error found.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from orchestrator.outcome import Outcome
from orchestrator.results.least_damped import least_damped_of
from orchestrator.results.model_limits import beyond_model
from orchestrator.results.windows import instants
from orchestrator.scenario.schedule import from_attributes
from rotor_fmu.train.train import Train

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

ALLOWED = 0.05
"""Estimated error of the forces up to which a run counts as resolved; PROMISED / ALLOWED is the reserve."""

PROMISED = 0.1
"""Share of a bearing's largest force by which no force of a finished run is off."""

RUINED = 0.3
"""RMS error from which a coupling is unstable: it misses everything, and throws shafts out of their bearings;
a stable one misses some per cent at steps that are much too long."""


@dataclass(frozen=True)
class ErrorEstimate:
    """What the coupling missed of the bearing forces, estimated.

    Attributes
    ----------
    rms : float
        RMS over run and bearings, against that of the forces.
    largest : float
        Largest over run and bearings, against the largest force of the bearing; of a bearing with less load
        than the train has on average, against that load.
    bearing : str
        Where the largest arose.
    time : float
        When in s.
    """

    rms: float
    largest: float
    bearing: str
    time: float

    @property
    def resolved(self) -> bool:
        """Whether both measures are within what is allowed."""
        return self.rms <= ALLOWED and self.largest <= ALLOWED


def judge(record: xr.Dataset, train: Train) -> tuple[Outcome, str]:
    """Return the outcome of a run that reached its end, and why it is no success.

    Parameters
    ----------
    record : xarray.Dataset
        The whole run.
    train : Train
        Its train, with what the model of it bears.
    """
    beyond = beyond_model(record, train)
    if beyond is None:
        if missed := unresolved(record):
            return Outcome.UNRESOLVED, missed
        growth = grown(record)
        return (Outcome.UNSTABLE, growth) if growth else (Outcome.FINISHED, "")
    until = record.isel(time=slice(0, int(np.searchsorted(record["time"].values, beyond.time)) + 1))
    found, missed = error_estimate(until), unresolved(until)
    if found is not None and found.rms > RUINED:
        return Outcome.UNRESOLVED, f"{missed}; then {beyond.text}"
    if growth := grown(record):
        return Outcome.UNSTABLE, f"{growth}; then {beyond.text}"
    return Outcome.BEYOND_MODEL, f"{beyond.text}; before that, {missed}" if missed else beyond.text


def error_estimate(record: xr.Dataset) -> ErrorEstimate | None:
    """Estimate the error of a record; None where it holds no forces or no defect of them."""
    if "defect_max" not in record or record.sizes.get("time", 0) < 2:
        return None
    error, force = _missed(record), _values(record, "force_magnitude_max")
    scale = np.nanmax(force, axis=0)
    if "static_force" in record:
        static = record["static_force"].transpose("bearing", "axis").values
        scale = np.maximum(scale, np.hypot(*static.T).mean())
    share = np.nan_to_num(error / np.where(scale > 0.0, scale, np.inf))
    sample, bearing = np.unravel_index(int(np.argmax(share)), share.shape)
    size = float(np.sqrt(np.nanmean(force**2)))
    return ErrorEstimate(
        rms=float(np.sqrt(np.nanmean(error**2))) / size if size > 0.0 else 0.0,
        largest=float(share[sample, bearing]),
        bearing=str(record["bearing"].values[bearing]),
        time=float(record["time"].values[sample]) if "time" in record else 0.0,
    )


GROWN = 1.5
"""Whirl of the last revolutions over that of the first, from which that of an unstable train has grown."""

OBSERVED, HARMONICS = 3, 3
"""Revolutions at either end over which the whirl is measured, and harmonics of rotation left out of it."""


def unresolved(record: xr.Dataset) -> str:
    """Tell whether the coupling failed although the run went on to its end.

    Parameters
    ----------
    record : xarray.Dataset
        With the interval extremes ``defect_max``, ``step_error_max`` and ``force_magnitude_max``.

    Returns
    -------
    str
        Empty, or what was missed, at which bearing the most, and when and in which state there.
    """
    found = error_estimate(record)
    if found is None or found.resolved:
        return ""
    bearing = list(record["bearing"].values).index(found.bearing)
    sample = int(np.argmax(np.nan_to_num(_missed(record)[:, bearing])))
    return (
        f"the coupling missed {100.0 * found.rms:.3g} % of the bearing forces (RMS), and "
        f"{100.0 * found.largest:.3g} % of the largest force of {found.bearing}"
        f"{_state(record.isel(bearing=bearing, time=sample))}; allowed are {100.0 * ALLOWED:.3g} % of both"
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
    if schedule.course:
        return ""  # what turns with the shaft has no frequency of its own
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


def _missed(record: xr.Dataset) -> Array:
    """Estimated error of each force, (time, bearing)."""
    defect = _values(record, "defect_max")
    return np.fmax(defect, _values(record, "step_error_max")) if "step_error_max" in record else defect


def _values(record: xr.Dataset, name: str) -> Array:
    return record[name].transpose("time", "bearing").values


def _state(at: xr.Dataset) -> str:
    """Say when, and where the journal was then, as far as the record knows."""
    if "time" not in at or "eccentricity" not in at:
        return ""
    tilt = 1e6 * (at["tilt"].values - at["offset_tilt"].values)
    if "housing_tilt" in at:
        tilt = tilt - 1e6 * at["housing_tilt"].values
    return (
        f", worst at t = {float(at['time']):.6g} s (eccentricity ratio {float(at['eccentricity']):.4g}, "
        f"tilts {tilt[0]:.4g} and {tilt[1]:.4g} urad, least gap {1e6 * float(at['least_gap']):.4g} um)"
    )
