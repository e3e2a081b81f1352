"""Windows of a recorded run: where a mean is a mean and a maximum a maximum.

A run has *phases*, parted by its events.  Means are taken over the part of a phase that is steady (the last
revolutions before the first event; from some revolutions behind each event, when the first transient has
gone) and over whole revolutions, largest values behind an event over the whole phase.  Windows count in
revolutions of the run's schedule; they belong to every number, so they travel with it.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results.quantities import HERTZ
from orchestrator.scenario.events import BladeLoss
from orchestrator.scenario.schedule import Schedule, from_attributes

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

BEFORE = 2.0
"""Revolutions of the window before the first event."""
SETTLE = 10.0
"""Revolutions behind an event after which means are taken."""
LEAST_CHANGE = 0.02
"""Share of the largest speed by which it changes at least where things are drawn over it."""
_TOLERANCE = 1e-9  # s, far below any macro step: sample times are sums of steps


@dataclass(frozen=True)
class Window:
    """A span of simulated time [s], both ends included."""

    start: float
    end: float

    @property
    def length(self) -> float:
        """Length [s]."""
        return self.end - self.start

    def mask(self, time: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which of the sample times lie in the window."""
        return (time >= self.start - _TOLERANCE) & (time <= self.end + _TOLERANCE)

    def interval_mask(self, time: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which samples have the *interval that they close* in the window.

        Interval extremes at a sample cover the time since the sample before it, so the
        sample at the window's start tells about the time before the window.
        """
        inside = self.mask(time)
        if np.count_nonzero(inside) > 1 and time[0] < self.start - _TOLERANCE:
            inside[np.argmax(inside)] = False
        return inside


@dataclass(frozen=True)
class Phase:
    """A part of the run with one condition of the machine.

    Attributes
    ----------
    name : str
        ``before``, ``after``, or ``steady`` in a run without event; ``after 1``, ``after 2`` behind several.
    mean : Window
        Where means and harmonic parts are taken.
    peak : Window
        Where largest and smallest values are taken.
    span : Window
        The whole phase; contact is looked for in all of it.
    note : str
        Why a window differs from the rule, empty when it does not.
    """

    name: str
    mean: Window
    peak: Window
    span: Window
    note: str = ""


def speed_in(record: xr.Dataset, window: Window) -> float:
    """Mean speed in a window in rad/s, not negative; the start's where it stays, or the window has none."""
    first = abs(float(record.attrs["speed"]))
    if "rotation_speed" not in record:
        return first
    inside = window.mask(np.asarray(record["time"].values, dtype=float))
    found = np.abs(record["rotation_speed"].values[inside])
    return float(found.mean()) if found.any() else first


def changing_speed(record: xr.Dataset) -> NDArray[np.float64] | None:
    """Speed at each instant in rad/s, not negative; None where it stays."""
    if "rotation_speed" not in record:
        return None
    speed = np.abs(np.asarray(record["rotation_speed"].values, dtype=float))
    return speed if speed.size and float(np.ptp(speed)) > LEAST_CHANGE * float(speed.max()) else None


def instants(record: xr.Dataset) -> tuple[float, ...]:
    """Instants of the events that the record reaches [s], ascending."""
    time = record["time"].values
    if time.size == 0:
        return ()
    return tuple(at for at in from_attributes(record.attrs).instants if at < time[-1] - _TOLERANCE)


def events_in_words(record: xr.Dataset) -> tuple[str, ...]:
    """What happens in a recorded run, when, and at what speed where it changes; in the order of time."""
    schedule, end = from_attributes(record.attrs), float(record["time"].values[-1])
    words = []
    for event in schedule.events:
        if event.time <= end:
            much = f", {event.unbalance:.4g} kg m" if isinstance(event, BladeLoss) else ""
            turning = abs(schedule.speed_at(event.time)) / HERTZ * 60.0
            at = f", at {turning:.0f} rev/min" if schedule.course else ""
            words.append(f"{event.text} at {event.time:.4g} s{much}{at}")
    return tuple(words)


def phases(record: xr.Dataset) -> tuple[Phase, ...]:
    """Phases of a run with their windows.

    Parameters
    ----------
    record : xarray.Dataset
        A recorded run; its attributes tell its schedule.

    Returns
    -------
    tuple of Phase
        ``(before, after)``; ``(steady,)`` without event; ``(after,)`` when the event
        comes at or before the first sample; ``(before, after 1, after 2)`` and so on, without those in
        which nothing was recorded.  A phase shorter
        than its window is used as it is, and when it ends before the transient has had its time, its last
        half serves for means; `Phase.note` says so.

    Raises
    ------
    ValueError
        When the record has no sample.
    """
    time = record["time"].values
    if time.size == 0:
        raise ValueError("the record holds no sample")
    schedule = from_attributes(record.attrs)
    first, last = float(time[0]), float(time[-1])
    events = instants(record)
    ends = (*events, last)
    found = []
    if ends[0] > first + _TOLERANCE:
        found.append(_undisturbed(schedule, first, ends[0], recorded_on=bool(events)))
    unseen = ""
    for number, (event, end) in enumerate(itertools.pairwise(ends), 1):
        name = "after" if len(events) == 1 else f"after {number}"
        whole = Window(max(first, event), end)
        if not whole.mask(time).any():  # a shorter time than that between two records
            unseen += f"{'; ' if unseen else ''}no instant was recorded in {name}"
            continue
        phase = _disturbed(schedule, name, event, whole, end == last)
        notes = "; ".join(filter(None, (phase.note, unseen)))
        found.append(replace(phase, note=notes))
        unseen = ""
    return tuple(_seen(phase, time) for phase in found)


def _seen(phase: Phase, time: NDArray[np.float64]) -> Phase:
    """The phase, its windows begun earlier where records are so rare that none would lie in them."""

    def reaching(window: Window) -> Window:
        if window.mask(time).any():
            return window
        return Window(float(time[time <= window.end + _TOLERANCE][-1]), window.end)

    return replace(phase, mean=reaching(phase.mean), peak=reaching(phase.peak))


def _undisturbed(schedule: Schedule, first: float, end: float, *, recorded_on: bool) -> Phase:
    """The phase before the first event, or the only one."""
    asked = schedule.later(end, -BEFORE)
    start = max(first, asked)
    whole, mean = Window(first, end), Window(_whole(schedule, start, end), end)
    if not recorded_on:
        return Phase("steady", mean, whole, whole)
    note = "" if asked >= first - _TOLERANCE else f"only {end - first:.3g} s recorded"
    return Phase("before", mean, Window(start, end), whole, note)


def _disturbed(schedule: Schedule, name: str, event: float, whole: Window, is_last: bool) -> Phase:
    """A phase behind an event."""
    start, note = schedule.later(event, SETTLE), ""
    if schedule.revolutions(start, whole.end) < SETTLE / 2:
        start = event + (whole.end - event) / 2
        what = "the run ends" if is_last else "the next event comes"
        note = f"{what} {whole.end - event:.3g} s after the event: the transient may not have decayed"
    return Phase(name, Window(_whole(schedule, start, whole.end), whole.end), whole, whole, note)


def _whole(schedule: Schedule, start: float, end: float) -> float:
    """The start moved towards the end until whole revolutions lie between; left where not one fits."""
    count = schedule.whole(start, end)
    moved = schedule.later(end, -count)
    return moved if count and moved > start + _TOLERANCE else start
