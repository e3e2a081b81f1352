"""Windows of a recorded run: where a mean is a mean and a maximum a maximum.

A run has a *phase* before the event and one after it.  Means are taken over the part
of a phase that is steady (the last revolutions before the fracture; from some time
behind it, when the first transient has gone), largest values after the event over the
whole phase.  The windows belong to every number, so they travel with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

BEFORE = 0.08
"""Length of the window before the event [s]: two revolutions at 25 Hz."""
SETTLE = 0.4
"""Time behind the event after which means are taken [s]."""
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
        ``before``, ``after``, or ``steady`` in a run without event.
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


def fracture_time(record: xr.Dataset) -> float | None:
    """Instant of the event [s], None when the record holds none or ends before it."""
    value = record.attrs.get("fracture_time")
    time = record["time"].values
    if value is None or not np.isfinite(float(value)):
        return None
    inside = time.size > 0 and float(value) < time[-1] - _TOLERANCE
    return float(value) if inside else None


def phases(record: xr.Dataset, *, before: float = BEFORE, settle: float = SETTLE) -> tuple[Phase, ...]:
    """Phases of a run with their windows.

    Parameters
    ----------
    record : xarray.Dataset
        A recorded run; its attribute ``fracture_time`` is the event's instant.
    before : float
        Length of the window before the event [s].
    settle : float
        Time left to the transient behind the event [s].

    Returns
    -------
    tuple of Phase
        ``(before, after)``; ``(steady,)`` without event; ``(after,)`` when the event
        comes at or before the first sample.  A phase shorter than its window is used as
        it is, and when the run ends before the transient has had its time, the last
        half behind the event serves for means; `Phase.note` says so.

    Raises
    ------
    ValueError
        When the record has no sample.
    """
    time = record["time"].values
    if time.size == 0:
        raise ValueError("the record holds no sample")
    first, last = float(time[0]), float(time[-1])
    event = fracture_time(record)
    if event is None:
        start = max(first, last - before)
        return (Phase("steady", Window(start, last), Window(first, last), Window(first, last)),)
    found = []
    if event > first + _TOLERANCE:
        start = max(first, event - before)
        note = "" if event - before >= first - _TOLERANCE else f"only {event - first:.3g} s recorded"
        found.append(Phase("before", Window(start, event), Window(start, event), Window(first, event), note))
    start, note = event + settle, ""
    if last - start < settle / 2:
        start = event + (last - event) / 2
        note = f"the run ends {last - event:.3g} s after the event: the transient may not have decayed"
    whole = Window(max(first, event), last)
    found.append(Phase("after", Window(start, last), whole, whole, note))
    return tuple(found)
