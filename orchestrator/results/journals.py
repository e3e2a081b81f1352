"""How a journal moves, as figures and reports show it: parts of its orbit, spectra, waterfall."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from orchestrator.results.signals.orders import probe_signals, turned_angle
from orchestrator.results.signals.spectrum import Spectrum, order_spectrum, spectrum, waterfall
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
STEADY, FEWEST = 20.0, 4.0
"""Revolutions before an event of which the spectrum is made, and of which one is made at least."""
LENGTH, SLICES, HIGHEST_OVER_TIME = 8.0, 80, 4.0
"""Of a waterfall: revolutions of a slice, how many slices, up to which order."""
FLOOR = 1e-9
"""Smallest amplitude drawn [m]."""
DEFAULT_PROBES = (math.pi / 4.0, 3.0 * math.pi / 4.0)


@dataclass(frozen=True)
class Part:
    """A part of a run whose orbit is drawn: what it is called, and when it is."""

    name: str
    window: Window


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
    """Where the motion is steady: before an event the last revolutions, or else where means are taken.

    A shorter one than a spectrum can be made of is drawn out to the fewest revolutions that the phase has.
    """
    if phase.name != "before" and phase.mean.length >= (FEWEST - 1e-6) * turn:
        return phase.mean
    count = STEADY if phase.name == "before" else FEWEST
    return Window(max(phase.span.start, phase.span.end - (count + 1e-6) * turn), phase.span.end)


def probe_spectrum(
    time: Floats, motion: Floats, angle: float, window: Window, turn: float, speed: Floats | None = None
) -> Spectrum | None:
    """Amplitudes [m] at a probe over whole pairs of revolutions, so that half orders lie on a line.

    Where the speed changes, over orders: of samples at even angles of the rotation.

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
    speed : ndarray, shape (n,), optional
        In rad/s where it changes, not negative.

    Returns
    -------
    Spectrum or None
        Up to the order `HIGHEST`; None of fewer than `FEWEST` revolutions, or of records too far apart.
    """
    if _coarse(time, turn):
        return None
    signal = probe_signals(motion, [angle])[0]
    if speed is not None:
        inside = window.mask(time)
        return _over_orders(time[inside], signal[inside], speed[inside])
    pairs = math.floor(window.length / (2.0 * turn) + 1e-6)
    if 2.0 * pairs < FEWEST:
        return None
    start = window.end - 2.0 * turn * pairs
    step = (time[-1] - time[0]) / (time.size - 1)
    chosen = (time > max(start, time[0]) - 0.5 * step) & (time < window.end - 0.5 * step)
    found = spectrum(time[chosen], signal[chosen])
    inside = (found.frequency > 0.0) & (found.frequency <= HIGHEST / turn)
    return Spectrum(found.frequency[inside], found.amplitude[inside])


def _over_orders(time: Floats, signal: Floats, speed: Floats) -> Spectrum | None:
    turns = turned_angle(time, speed) / (2.0 * math.pi) if time.size else time
    pairs = math.floor(turns[-1] / 2.0 + 1e-6) if time.size else 0
    if 2.0 * pairs < FEWEST or speed.min() <= 0.0:
        return None
    found = order_spectrum(time, signal, speed, 2 * pairs)
    inside = (found.frequency > 0.0) & (found.frequency <= HIGHEST)
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
