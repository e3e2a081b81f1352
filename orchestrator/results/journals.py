"""How a journal moves, as figures and reports show it: parts of its orbit, spectra, waterfall."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from orchestrator.results.signals.orders import probe_signals
from orchestrator.results.signals.spectrum import Spectrum, spectrum, waterfall
from orchestrator.results.statistics import contact_threshold
from orchestrator.results.verdicts.judge import own_limits
from orchestrator.results.windows import Phase, Window

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]

BEFORE, FIRST, LAST = 2.0, 10.0, 5.0
"""Revolutions shown before the event, behind it, and at the end of the run."""
HIGHEST = 6.0
"""Order of the speed up to which spectra are drawn."""
STEADY = 20.0
"""Revolutions before an event of which the spectrum is made."""
LENGTH, SLICES, HIGHEST_OVER_TIME = 8.0, 80, 4.0
"""Of a waterfall: revolutions of a slice, how many slices, up to which order."""
LEAST_CHANGE = 0.02
"""Share of the largest speed by which it changes at least where things are drawn over it."""
FLOOR = 1e-9
"""Smallest amplitude drawn [m]."""
DEFAULT_PROBES = (math.pi / 4.0, 3.0 * math.pi / 4.0)


@dataclass(frozen=True)
class Part:
    """A part of a run whose orbit is drawn: what it is called, and when it is."""

    name: str
    window: Window


def journal_motion(record: xr.Dataset, bearing: str) -> Floats:
    """Journal from the centre of its bearing, shape (2, time), in m."""
    one = record[["displacement", "offset"]].sel(bearing=bearing)
    moved = one["displacement"] - one["offset"]
    return np.asarray(moved.transpose("axis", "time").values, dtype=float)


def touching(record: xr.Dataset, bearing: str, phases: Sequence[Phase]) -> NDArray[np.bool_]:
    """When surfaces touch, shape (time,)."""
    force = np.asarray(record["contact_force"].sel(bearing=bearing).values, dtype=float)
    return force > contact_threshold(record, bearing, tuple(phases))


def probes_of(record: xr.Dataset) -> tuple[float, ...]:
    """Angles of the probes in rad, from x towards y."""
    limit = own_limits(record).shaft_vibration
    return DEFAULT_PROBES if limit is None else limit.probes


def orbit_parts(phases: Sequence[Phase], turn: float) -> tuple[Part, ...]:
    """Parts of a run whose orbits are drawn, the last on top; `turn` is the length of a revolution in s."""
    first, *later = phases
    end = first.span.end
    if not later:
        name = "lasting" if first.name == "steady" else "after"
        return (Part(name, Window(max(first.span.start, end - FIRST * turn), end)),)
    start, last = later[0].span.start, later[-1].span.end
    return (
        Part("behind the event", Window(start, min(last, start + FIRST * turn))),
        Part("end of the run", Window(max(start, last - LAST * turn), last)),
        Part("before", Window(max(first.span.start, end - BEFORE * turn), end)),
    )


def steady_window(phase: Phase, turn: float) -> Window:
    """Where the motion is steady: before an event the last revolutions, or else where means are taken."""
    if phase.name != "before":
        return phase.mean
    return Window(max(phase.span.start, phase.span.end - STEADY * turn), phase.span.end)


def changing_speed(record: xr.Dataset) -> Floats | None:
    """Speed at each instant in rad/s, not negative; None where it stays."""
    if "rotation_speed" not in record:
        return None
    speed = np.abs(np.asarray(record["rotation_speed"].values, dtype=float))
    return speed if speed.size and float(np.ptp(speed)) > LEAST_CHANGE * float(speed.max()) else None


def probe_spectrum(
    time: Floats, motion: Floats, angle: float, window: Window, turn: float
) -> Spectrum | None:
    """Amplitudes [m] at a probe over whole pairs of revolutions, so that half orders lie on a line.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Instants in s.
    motion : ndarray, shape (2, n)
        Of the journal.
    angle : float
        Of the probe.
    window : Window
        Of as many whole pairs as it holds, the last are taken.
    turn : float
        Length of a revolution in s.

    Returns
    -------
    Spectrum or None
        Up to the order `HIGHEST`; None of fewer than 8 samples, or of records too far apart.
    """
    pairs = math.floor(window.length / (2.0 * turn) + 1e-6)
    start = window.end - 2.0 * turn * max(pairs, 1)
    if _coarse(time, turn):
        return None
    step = (time[-1] - time[0]) / (time.size - 1)
    chosen = (time > max(start, time[0]) - 0.5 * step) & (time < window.end - 0.5 * step)
    if np.count_nonzero(chosen) < 8:
        return None
    found = spectrum(time[chosen], probe_signals(motion[:, chosen], [angle])[0])
    inside = (found.frequency > 0.0) & (found.frequency <= HIGHEST / turn)
    return Spectrum(found.frequency[inside], found.amplitude[inside])


def _coarse(time: Floats, turn: float) -> bool:
    """Whether records lie further apart than a quarter of a revolution, where spectra would mislead."""
    return time.size < 2 or float(time[-1] - time[0]) > 0.25 * turn * (time.size - 1)


def probe_waterfall(time: Floats, motion: Floats, angle: float, turn: float) -> Spectrum | None:
    """Amplitudes [m] at a probe over frequency and time; None of under four revolutions, or coarse ones."""
    length = min(LENGTH, math.floor((time[-1] - time[0]) / turn / 2.0)) * turn
    if length < 2.0 * turn or _coarse(time, turn):
        return None
    found = waterfall(time, probe_signals(motion, [angle])[0], length, slices=SLICES)
    inside = (found.frequency > 0.0) & (found.frequency <= HIGHEST_OVER_TIME / turn)
    return Spectrum(found.frequency[inside], found.amplitude[:, inside], found.time)
