"""One run of a comparison in figures: the analysed bearing and the shaft, before the event and after it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results.statistics import (
    BearingStatistics,
    ShaftStatistics,
    bearing_statistics,
    contact_threshold,
    half_peak_to_peak,
    interval_extreme,
    series,
    shaft_statistics,
    time_mean,
)
from orchestrator.results.windows import Phase, Window, phases
from orchestrator.scenario.schedule import from_attributes

if TYPE_CHECKING:
    import xarray as xr


class NotEvaluatedError(Exception):
    """A figure that a run does not give; the text says why."""


@dataclass(frozen=True)
class PhaseFigures:
    """One phase of a run.

    Attributes
    ----------
    phase : Phase
        With the windows of the statistics.
    bearing : BearingStatistics
        Of the analysed bearing.
    shaft : ShaftStatistics
        Of the shaft.
    contact_largest : float
        Largest solid contact force in the whole phase [N].
    ends : tuple of float
        Shares of the phase's time with the least gap at the bearing's front and rear end.
    """

    phase: Phase
    bearing: BearingStatistics
    shaft: ShaftStatistics
    contact_largest: float
    ends: tuple[float, float]


@dataclass(frozen=True)
class StartTransient:
    """Whether the run begins in its steady state: the least gap at the two ends of the first phase [m].

    Over whole revolutions, as many as fit into the window before the event.

    Attributes
    ----------
    first, last : Window
        Windows of equal length.
    mean_first, mean_last, harmonic_first, harmonic_last : float
        Mean and half peak-to-peak of the least gap.
    """

    first: Window
    last: Window
    mean_first: float
    mean_last: float
    harmonic_first: float
    harmonic_last: float

    @property
    def drift(self) -> float:
        """Change of the mean gap as a share of it."""
        return self.mean_last / self.mean_first - 1.0


@dataclass(frozen=True)
class DepthRun:
    """A run at one depth.

    Attributes
    ----------
    depth : str
        Modelling depth.
    unfinished : str
        How and when the run ended before its end; empty for a complete one.
    contact_from : float
        Contact force from which contact counts [N]; not a number for a run that left no record.
    before, after : PhaseFigures or None
        None where the record does not reach; a run without event has only `before`.
    start : StartTransient or None
        None when the first phase is too short.
    """

    depth: str
    unfinished: str = ""
    contact_from: float = float("nan")
    before: PhaseFigures | None = None
    after: PhaseFigures | None = None
    start: StartTransient | None = None

    def require(self, name: str) -> PhaseFigures:
        """Return the phase ``before`` or ``after``.

        Raises
        ------
        NotEvaluatedError
            When the run does not give it, or not all of it.
        """
        figures = self.before if name == "before" else self.after
        if self.unfinished and (name == "after" or self.after is None):
            raise NotEvaluatedError(f"{self.depth.upper()} {self.unfinished}")
        if figures is None:
            raise NotEvaluatedError(
                "no blade fracture in the run" if name == "after" else "nothing recorded before the fracture"
            )
        return figures


def read_run(record: xr.Dataset, depth: str, bearing: str, *, unfinished: str = "") -> DepthRun:
    """Figures of a run from its record, which has two samples at least; see `DepthRun`."""
    found = phases(record)
    threshold = contact_threshold(record, bearing, found)
    figures = {phase.name: _figures(record, bearing, phase, threshold) for phase in found}
    before = figures.get("before", figures.get("steady"))
    start = _start(record, bearing, found[0]) if before is not None else None
    return DepthRun(depth, unfinished, threshold, before, figures.get("after"), start)


def _figures(record: xr.Dataset, bearing: str, phase: Phase, threshold: float) -> PhaseFigures:
    time = np.asarray(record["time"].values, dtype=float)
    span = phase.span.mask(time)
    contact = series(record, "contact_force", bearing)
    peaks = interval_extreme(record, "contact_force_max", bearing, contact)
    largest = max(contact[span].max(), peaks[phase.span.interval_mask(time)].max())
    ends = (0.0, 0.0)
    if "least_gap_position" in record:
        position = series(record, "least_gap_position", bearing)[span]
        front, rear = (time_mean(time[span], (sign * position > 0).astype(float)) for sign in (-1.0, 1.0))
        ends = (front, rear)
    return PhaseFigures(
        phase,
        bearing_statistics(record, bearing, phase, contact_from=threshold),
        shaft_statistics(record, phase),
        float(largest),
        ends,
    )


def _start(record: xr.Dataset, bearing: str, phase: Phase) -> StartTransient | None:
    time, gap = np.asarray(record["time"].values, dtype=float), series(record, "least_gap", bearing)
    span = phase.span
    schedule = from_attributes(record.attrs)
    length = schedule.later(0.0, schedule.whole(0.0, min(phase.mean.length, span.length / 2)))
    windows = Window(span.start, span.start + length), Window(span.end - length, span.end)
    masks = [window.mask(time) for window in windows]
    if length == 0.0 or min(int(mask.sum()) for mask in masks) < 2:
        return None
    means = [time_mean(time[mask], gap[mask]) for mask in masks]
    harmonics = [half_peak_to_peak(gap[mask]) for mask in masks]
    return StartTransient(*windows, *means, *harmonics)
