"""Amplitudes over frequency, and over frequency and time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from orchestrator.results.signals.orders import turned_angle

Floats = NDArray[np.float64]

UNEVEN = 1e-6
"""Share of a step by which samples may be unevenly spaced and still be taken as they are."""


@dataclass(frozen=True)
class Spectrum:
    """One-sided amplitude spectrum.

    Attributes
    ----------
    frequency : ndarray, shape (f,)
        In Hz, from 0.
    amplitude : ndarray, shape (f,) or (slices, f)
        A tone ``a cos(2 pi f t)`` on a line of the spectrum reads ``a``, in the unit of the signal.
    time : ndarray, shape (slices,), optional
        Middle of each slice of a waterfall in s.
    """

    frequency: Floats
    amplitude: Floats
    time: Floats | None = None


def evenly(time: ArrayLike, values: ArrayLike) -> tuple[float, Floats]:
    """Return the step in s and the values at even instants; between uneven samples it goes straight.

    Parameters
    ----------
    time : array_like, shape (n,)
        Ascending, in s; at least two.
    values : array_like, shape (n,)
        Samples.
    """
    t, x = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    step = (t[-1] - t[0]) / (t.size - 1)
    even = t[0] + step * np.arange(t.size)
    return step, x if np.abs(t - even).max() <= UNEVEN * step else np.interp(even, t, x)


def spectrum(time: ArrayLike, values: ArrayLike, *, window: str = "hann") -> Spectrum:
    """Amplitude spectrum of a record without its mean.

    The window's own gain is taken out (Heinzel, Ruediger and Schilling 2002, Eq. 24), so that a tone on a
    line reads its amplitude; between two lines ``hann`` reads up to 15 % low and ``flattop`` 0.1 %.

    Parameters
    ----------
    time, values : array_like, shape (n,)
        Of a record that covers ``[time[0], time[-1] + step)``; tones with whole periods in it lie on a line.
    window : str
        Name as in `scipy.signal.get_window`; ``boxcar`` for none.
    """
    step, even = evenly(time, values)
    return Spectrum(_lines(even.size, step), _amplitudes(even, window))


def order_spectrum(
    time: ArrayLike, values: ArrayLike, speed: ArrayLike, turns: int, *, window: str = "hann"
) -> Spectrum:
    """Amplitudes over orders of a changing speed: the spectrum of samples at even angles of the rotation.

    Parameters
    ----------
    time, values, speed : array_like, shape (n,)
        The record, in s and rad/s; the speed above 0.
    turns : int
        Whole revolutions; the last ones are taken.
    window : str
        As in `spectrum`.

    Returns
    -------
    Spectrum
        Its ``frequency`` is the order, 1 for once a revolution.
    """
    t = np.asarray(time, dtype=float)
    theta = turned_angle(t, speed) / (2.0 * np.pi)
    size = max(int(np.count_nonzero(theta > theta[-1] - turns)), 8)
    even = theta[-1] - turns + turns / size * np.arange(size)
    return spectrum(even, CubicSpline(theta, values)(even), window=window)


def waterfall(
    time: ArrayLike, values: ArrayLike, length: float, *, slices: int = 60, window: str = "hann"
) -> Spectrum:
    """Spectra of overlapping slices of a record.

    Parameters
    ----------
    time, values : array_like, shape (n,)
        The record.
    length : float
        Of a slice in s, which sets the distance of the lines, 1/length.
    slices : int
        How many, at most; evenly spread from the first sample to the last.

    Raises
    ------
    ValueError
        When the record is shorter than a slice.
    """
    step, even = evenly(time, values)
    size = round(length / step)
    if not 2 <= size <= even.size:
        raise ValueError(f"waterfall: a slice of {length:g} s does not fit in {even.size * step:g} s")
    starts = np.unique(np.linspace(0, even.size - size, slices).round().astype(int))
    rows = np.stack([even[start : start + size] for start in starts])
    middle = np.asarray(time, dtype=float)[0] + step * (starts + size / 2)
    return Spectrum(_lines(size, step), _amplitudes(rows, window), middle)


def _lines(size: int, step: float) -> Floats:
    return np.asarray(np.fft.rfftfreq(size, step), dtype=np.float64)


def _amplitudes(rows: Floats, window: str) -> Floats:
    """One-sided amplitudes along the last axis."""
    size = rows.shape[-1]
    weights = _weights(window, size)
    lines = np.abs(np.fft.rfft(weights * (rows - rows.mean(axis=-1, keepdims=True)))) / weights.sum()
    lines[..., 1 : (size + 1) // 2] *= 2.0
    return np.asarray(lines, dtype=float)


def _weights(window: str, size: int) -> Floats:
    """The window; scipy.signal, a second of loading, only for one that is not the usual one."""
    if window == "hann":
        return np.asarray(0.5 - 0.5 * np.cos(2.0 * np.pi / size * np.arange(size)), dtype=float)
    from scipy.signal import get_window

    return np.asarray(get_window(window, size), dtype=float)
