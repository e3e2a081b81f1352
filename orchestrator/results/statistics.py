"""Statistics of a recorded run: bearings, shaft, coupling.

Everything here reads the record (see `orchestrator.results.record`) and nothing else; SI units.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from orchestrator.results.windows import Phase, Window, phases

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

CONTACT_SHARE = 1e-3
"""Solid contact counts from this share of the bearing's mean force before the event."""


def time_mean(time: NDArray[np.float64], values: NDArray[np.float64]) -> float:
    """Mean over time by the trapezoidal rule; exact for resolved harmonics over whole periods."""
    if time.size < 2 or time[-1] <= time[0]:
        return float(np.mean(values))
    return float(np.trapezoid(values, time) / (time[-1] - time[0]))


def window_mean(window: Window, time: NDArray[np.float64], values: NDArray[np.float64]) -> float:
    """Mean over all of a window, whose ends may lie between two samples."""
    inside = window.mask(time)
    times, shown = time[inside], values[inside]
    for end, place in ((window.start, 0), (window.end, times.size)):
        # Between samples: in the record, but further from the samples inside than rounding.
        between = time[0] < end < time[-1] and not np.isclose(time, end, rtol=0.0, atol=1e-9).any()
        if between and times.size:
            place = times.size if place else 0  # one more than before where the start was put in
            times = np.insert(times, place, end)
            shown = np.insert(shown, place, np.interp(end, time, values))
    return time_mean(times, shown)


def half_peak_to_peak(values: NDArray[np.float64]) -> float:
    """Half the distance between the largest and the smallest value: the harmonic part."""
    return float(np.ptp(values) / 2)


def magnitude(record: xr.Dataset, name: str, bearing: str) -> NDArray[np.float64]:
    """Length of a vector quantity (``force``, ``moment``, ...) at one bearing, over time."""
    vector = record[name].sel(bearing=bearing).transpose("time", "axis").values
    return np.hypot(vector[:, 0], vector[:, 1])


def series(record: xr.Dataset, name: str, bearing: str) -> NDArray[np.float64]:
    """A scalar quantity at one bearing, over time."""
    return np.asarray(record[name].sel(bearing=bearing).values, dtype=float)


def interval_extreme(
    record: xr.Dataset, name: str, bearing: str, samples: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The record's interval extreme `name`, or the samples where the record has none."""
    return series(record, name, bearing) if name in record else samples


def of(units: str, *, least: bool = False) -> dict[str, Any]:
    """What is known of a statistic besides its value: SI unit, and whether the least value is the worst."""
    return {"units": units, "least": least}


@dataclass(frozen=True)
class BearingStatistics:
    """One bearing in one phase; forces N, moments N m, gaps m, times s.

    Attributes
    ----------
    force_mean, force_max, moment_mean, moment_max : float
        Of the magnitude of the wrench's two parts.
    least_gap_mean, least_gap_harmonic, least_gap_min : float
        Of the least gap over the whole film; harmonic part: half peak-to-peak.
    centre_line_gap_mean, centre_line_gap_min : float
        Of the least gap on the bearing's centre line.
    contact_first : float or None
        First instant of solid contact in the phase, None when there is none.
    contact_share : float
        Share of the phase's time with solid contact, 0 to 1.
    contact_max, contact_pressure_max : float
        Largest solid contact force and pressure; the pressure 0 where the record has none.
    wiped_max : float
        Largest share of the bore in which the contact reaches the hardness of the softer metal.
    sommerfeld_mean : float
        Mean Sommerfeld number So = F ψ²/(b d η ω).
    """

    bearing: str
    phase: str
    force_mean: float = field(metadata=of("N"))
    force_max: float = field(metadata=of("N"))
    moment_mean: float = field(metadata=of("N m"))
    moment_max: float = field(metadata=of("N m"))
    least_gap_mean: float = field(metadata=of("m", least=True))
    least_gap_harmonic: float = field(metadata=of("m"))
    least_gap_min: float = field(metadata=of("m", least=True))
    centre_line_gap_mean: float = field(metadata=of("m", least=True))
    centre_line_gap_min: float = field(metadata=of("m", least=True))
    contact_first: float | None = field(metadata=of("s", least=True))
    contact_share: float = field(metadata=of("1"))
    contact_max: float = field(metadata=of("N"))
    sommerfeld_mean: float = field(metadata=of("1"))
    contact_pressure_max: float = field(default=0.0, metadata=of("Pa"))
    wiped_max: float = field(default=0.0, metadata=of("1"))


def contact_threshold(record: xr.Dataset, bearing: str, found: Sequence[Phase]) -> float:
    """Contact force from which contact counts [N], `CONTACT_SHARE` of the first phase's mean force.

    The asperity law has a tail: between surfaces far apart it gives not zero but newtons.
    """
    time = record["time"].values
    return CONTACT_SHARE * window_mean(found[0].mean, time, magnitude(record, "force", bearing))


def bearing_statistics(
    record: xr.Dataset, bearing: str, phase: Phase, *, contact_from: float
) -> BearingStatistics:
    """Statistics of one bearing in one phase.

    Parameters
    ----------
    record : xarray.Dataset
        A recorded run.
    bearing : str
        Name of the bearing.
    phase : Phase
        The phase with its windows.
    contact_from : float
        Contact force from which contact counts [N], see `contact_threshold`.
    """
    time = np.asarray(record["time"].values, dtype=float)
    mean, peak = phase.mean.mask(time), phase.peak.mask(time)
    span = phase.span.mask(time)
    peak_interval, span_interval = phase.peak.interval_mask(time), phase.span.interval_mask(time)
    force, moment = magnitude(record, "force", bearing), magnitude(record, "moment", bearing)
    gap, centre = series(record, "least_gap", bearing), series(record, "centre_line_gap", bearing)
    contact = series(record, "contact_force", bearing)
    contact_peak = interval_extreme(record, "contact_force_max", bearing, contact)

    def mean_of(values: NDArray[np.float64]) -> float:
        return window_mean(phase.mean, time, values)

    def largest(name: str, samples: NDArray[np.float64]) -> float:
        extremes = interval_extreme(record, name, bearing, samples)
        return float(max(samples[peak].max(), extremes[peak_interval].max()))

    def smallest(name: str, samples: NDArray[np.float64]) -> float:
        extremes = interval_extreme(record, name, bearing, samples)
        return float(min(samples[peak].min(), extremes[peak_interval].min()))

    def told(name: str) -> float:
        return largest(f"{name}_max", series(record, name, bearing)) if name in record else 0.0

    # the sample at the start of a span belongs to it, the interval that it closes does not
    touching = (span_interval & (contact_peak > contact_from)) | (span & (contact > contact_from))
    return BearingStatistics(
        bearing=bearing,
        phase=phase.name,
        force_mean=mean_of(force),
        force_max=largest("force_magnitude_max", force),
        moment_mean=mean_of(moment),
        moment_max=largest("moment_magnitude_max", moment),
        least_gap_mean=mean_of(gap),
        least_gap_harmonic=half_peak_to_peak(gap[mean]),
        least_gap_min=smallest("least_gap_min", gap),
        centre_line_gap_mean=mean_of(centre),
        centre_line_gap_min=smallest("centre_line_gap_min", centre),
        contact_first=float(time[np.argmax(touching)]) if touching.any() else None,
        contact_share=time_mean(time[span], (contact > contact_from)[span].astype(float)),
        contact_max=largest("contact_force_max", contact),
        sommerfeld_mean=mean_of(series(record, "sommerfeld", bearing)),
        contact_pressure_max=told("contact_pressure"),
        wiped_max=told("wiped"),
    )


def analysed_bearing(record: xr.Dataset, named: str | None = None) -> str:
    """The bearing that the figures show.

    Parameters
    ----------
    record : xarray.Dataset
        A recorded run.
    named : str, optional
        A name to use instead; the record's attribute ``analysed_bearing`` is next in rank.

    Returns
    -------
    str
        The named bearing, otherwise the one with the largest mean force in the last phase.

    Raises
    ------
    ValueError
        When the named bearing is not in the record.
    """
    names = [str(name) for name in record["bearing"].values]
    named = named or record.attrs.get("analysed_bearing") or None
    if named is not None:
        if named not in names:
            raise ValueError(f"analysed bearing {named!r}: not in the record, which has {', '.join(names)}")
        return named
    time = record["time"].values
    window = phases(record)[-1].mean
    loads = [window_mean(window, time, magnitude(record, "force", name)) for name in names]
    return names[int(np.argmax(loads))]


@dataclass(frozen=True)
class ShaftStatistics:
    """The shaft in one phase; amplitudes and positions m, stresses Pa.

    Attributes
    ----------
    amplitude_mean, amplitude_max : float
        Largest vibration amplitude along the shaft: its mean over time and its largest value.
    amplitude_position : float
        Axial position of the largest value.
    stress_mean, stress_max, stress_position : float
        The same of the normal stress from bending.
    """

    phase: str
    amplitude_mean: float = field(metadata=of("m"))
    amplitude_max: float = field(metadata=of("m"))
    amplitude_position: float = field(metadata=of("m"))
    stress_mean: float = field(metadata=of("Pa"))
    stress_max: float = field(metadata=of("Pa"))
    stress_position: float = field(metadata=of("m"))


def shaft_statistics(record: xr.Dataset, phase: Phase) -> ShaftStatistics:
    """Largest vibration amplitude and normal stress of the shaft in one phase."""
    time = np.asarray(record["time"].values, dtype=float)
    peak = phase.peak.mask(time)
    values: list[float] = []
    for name in ("vibration_amplitude", "normal_stress"):
        samples = np.asarray(record[f"{name}_max"].values, dtype=float)
        where = np.asarray(record[f"{name}_position"].values, dtype=float)[peak]
        worst = int(np.argmax(samples[peak]))
        values += [window_mean(phase.mean, time, samples), float(samples[peak][worst]), float(where[worst])]
    return ShaftStatistics(phase.name, *values)


@dataclass(frozen=True)
class DefectStatistics:
    """Error estimate of the coupling: what the affine law missed over a macro step.

    Attributes
    ----------
    median, largest : float
        Of the largest defect over the bearings, in the record's unit of ``defect_max``.
    bearing : str
        Where the largest defect arose.
    time : float
        When [s].
    """

    median: float
    largest: float
    bearing: str
    time: float


def defect_statistics(record: xr.Dataset) -> DefectStatistics | None:
    """Statistics of ``defect_max``, None when the record has none."""
    if "defect_max" not in record or record["defect_max"].size == 0:
        return None
    defect = record["defect_max"].transpose("time", "bearing").values
    if not np.isfinite(defect).any():
        return None
    step, index = np.unravel_index(int(np.nanargmax(defect)), defect.shape)
    return DefectStatistics(
        median=float(np.nanmedian(np.nanmax(defect, axis=1))),
        largest=float(defect[step, index]),
        bearing=str(record["bearing"].values[index]),
        time=float(record["time"].values[step]),
    )
