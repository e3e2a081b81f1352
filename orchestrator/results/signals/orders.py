"""What turns with the shaft: complex amplitudes of orders of the speed, whirl, probes, peak to peak."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

NAMED = {0.5: "½X", 1.0: "1X", 2.0: "2X", 3.0: "3X"}
"""Orders that figures name: whirl of a film, or a rub every second turn; unbalance; bow and misfit."""


def turned_angle(time: ArrayLike, speed: ArrayLike) -> Floats:
    """Angle of the rotation since the first sample in rad, of speeds in rad/s, shape (n,)."""
    t, w = np.asarray(time, dtype=float), np.asarray(speed, dtype=float)
    return np.concatenate([[0.0], np.cumsum(0.5 * (w[1:] + w[:-1]) * np.diff(t))])


def order_amplitudes(
    time: ArrayLike, values: ArrayLike, speed: ArrayLike, orders: Sequence[float]
) -> Complex:
    """Complex amplitudes ``A`` of ``x = mean + Re sum A_k exp(i k theta)``, by least squares.

    Parameters
    ----------
    time : array_like, shape (n,)
        In s; samples may be uneven.
    values : array_like, shape (n, ...)
        Signals.
    speed : array_like, shape () or (n,)
        In rad/s: theta = speed t; where it changes theta is its integral from the first sample.
    orders : sequence of float
        Above 0.

    Returns
    -------
    ndarray, shape (len(orders), ...)
        Phases count from theta = 0: a lag is negative.
    """
    t, x = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    theta = turned_angle(t, speed) if np.ndim(speed) else float(np.asarray(speed)) * t
    turn = np.exp(1j * np.outer(theta, orders))
    columns = np.hstack([np.ones((t.size, 1)), turn.real, -turn.imag])
    found = np.linalg.lstsq(columns, x.reshape(t.size, -1), rcond=None)[0]
    real, imaginary = found[1 : len(orders) + 1], found[len(orders) + 1 :]
    return np.asarray((real + 1j * imaginary).reshape(len(orders), *x.shape[1:]))


def tracked_order(
    time: ArrayLike,
    values: ArrayLike,
    speed: ArrayLike,
    *,
    order: float = 1.0,
    turns: float = 4.0,
    points: int = 400,
) -> tuple[Floats, Complex]:
    """Amplitude of an order while the speed changes: least squares over the turns around each instant.

    In each window mean and amplitude change evenly, ``x = a + b t + Re (A + B t) exp(i order theta)``, theta
    the integral of the speed, t from the middle of the window.

    Parameters
    ----------
    time, values, speed : array_like, shape (n,)
        In s, of the signal, in rad/s.
    order : float
        Of the speed.
    turns : float
        Revolutions of a window.
    points : int
        Most instants; evenly spread over the angle.

    Returns
    -------
    ndarray, shape (points,)
        Instants in s.
    ndarray, shape (points,), complex
        ``A``; its phase counts from theta = 0 at the first sample. Not-a-number at standstill.
    """
    t, x, w = (np.asarray(a, dtype=float) for a in (time, values, speed))
    theta = turned_angle(t, w)
    half = np.pi * turns
    if theta[-1] <= 2.0 * half:
        return np.empty(0), np.empty(0, dtype=complex)
    middles = np.linspace(half, theta[-1] - half, min(points, max(2, int(theta[-1] / half))))
    at = np.interp(middles, theta, t)
    found = np.full(middles.size, np.nan + 0j)
    for k, middle in enumerate(middles):
        i, j = np.searchsorted(theta, (middle - half, middle + half))
        if j - i < 8:
            continue
        turn = np.exp(1j * order * theta[i:j])
        own = t[i:j] - at[k]
        shapes = np.column_stack([np.ones(j - i), turn.real, -turn.imag])
        scaled = own / np.abs(own).max()
        columns = np.hstack([shapes, scaled[:, None] * shapes])
        a = np.linalg.lstsq(columns, x[i:j], rcond=None)[0]
        found[k] = a[1] + 1j * a[2]
    return at, found


@dataclass(frozen=True)
class Whirl:
    """An elliptic orbit ``x + i y = forward exp(i w t) + backward exp(-i w t)``.

    Attributes
    ----------
    forward, backward : complex
        Circles with and against the rotation.
    """

    forward: complex
    backward: complex

    @property
    def major(self) -> float:
        """Larger half axis."""
        return abs(self.forward) + abs(self.backward)

    @property
    def minor(self) -> float:
        """Smaller half axis, negative where the orbit runs against the rotation."""
        return abs(self.forward) - abs(self.backward)

    @property
    def inclination(self) -> float:
        """Angle of the larger half axis from x towards y in rad, -pi/2 to pi/2."""
        angle = 0.5 * float(np.angle(self.forward) + np.angle(self.backward))
        return float((angle + np.pi / 2) % np.pi - np.pi / 2)


def whirl_of(x: complex, y: complex) -> Whirl:
    """The orbit of complex amplitudes in x and y."""
    return Whirl((x + 1j * y) / 2.0, (np.conj(x) + 1j * np.conj(y)) / 2.0)


def probe_signals(motion: ArrayLike, angles: Sequence[float]) -> Floats:
    """What probes at angles from x towards y [rad] make of x and y, shape (2, n): ``x cos a + y sin a``."""
    a = np.asarray(angles, dtype=float)[:, None]
    x, y = np.asarray(motion, dtype=float)
    return np.asarray(np.cos(a) * x + np.sin(a) * y)


def from_probes(signals: ArrayLike, angles: Sequence[float]) -> Floats:
    """Motion in x and y, shape (2, n), from probes at two or more angles, by least squares."""
    a = np.asarray(angles, dtype=float)
    directions = np.column_stack([np.cos(a), np.sin(a)])
    return np.asarray(np.linalg.lstsq(directions, np.asarray(signals, dtype=float), rcond=None)[0])


def peak_to_peak_of_turns(values: ArrayLike, angle: ArrayLike) -> Floats:
    """Peak to peak over the revolution around each instant, whatever the speed, shape as `values`.

    Parameters
    ----------
    values : array_like, shape (..., n)
        Signals.
    angle : array_like, shape (n,)
        Of the rotation in rad, not falling. At the ends the revolution is the first or the last.
    """
    x, theta = np.asarray(values, dtype=float), np.asarray(angle, dtype=float)
    middle = np.clip(theta, theta[0] + np.pi, max(theta[0] + np.pi, theta[-1] - np.pi))
    slack = 1e-6
    first = np.searchsorted(theta, middle - np.pi - slack)
    last = np.searchsorted(theta, middle + np.pi + slack, side="right")
    pairs = np.column_stack([first, last]).ravel()
    padded = np.concatenate([x, x[..., -1:]], axis=-1)  # an end may be that of all
    most, least = (f.reduceat(padded, pairs, axis=-1)[..., ::2] for f in (np.maximum, np.minimum))
    return np.asarray(most - least)


def running_peak_to_peak(values: ArrayLike, samples: int) -> Floats:
    """Peak to peak over the `samples` around each instant, shape as `values`, along the last axis."""
    x = np.asarray(values, dtype=float)
    size = max(1, min(samples, x.shape[-1]))
    options = {"size": size, "axis": -1, "mode": "nearest"}
    from scipy.ndimage import maximum_filter1d, minimum_filter1d  # a quarter of a second at every start

    return np.asarray(maximum_filter1d(x, **options) - minimum_filter1d(x, **options))
