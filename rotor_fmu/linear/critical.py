"""Stability and critical speeds: decrements, undamped critical speeds, amplification factors, margins.

Definitions as in API RP 684, 2nd edition (2005), SP6.8.2, and API Std 617: a user who must meet a standard
confirms them there.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy  # scipy.optimize is loaded where it is used: few runs need it
import scipy.sparse as sp
import scipy.sparse.linalg as sla
from numpy.typing import ArrayLike, NDArray

from rotor_fmu.linear.whirl import Bearings, WhirlModes, whirl_modes
from rotor_fmu.reduction.reduce import ReducedShaft
from rotor_fmu.shaft.matrices import ShaftModel

Array = NDArray[np.float64]

HALF_POWER = math.sqrt(0.5)
"""Share of the peak at which the amplification factor reads the width of a resonance, API 684 SP6.8.2.1."""

SHARP = 2.5
"""Amplification factor below which a resonance is critically damped and needs no margin."""

LEAST_DECREMENT = 0.1
"""Logarithmic decrement that API 617 asks of every mode."""

SEEN = 24
"""Modes among which the least damped one is looked for."""

REACH = 2.0
"""Frequencies up to this multiple of the speed count; of higher modes only those that grow."""

NOISE = 1e-7
"""Damping ratio within which rounding cannot tell an undamped mode from one that grows."""


@dataclass(frozen=True)
class LeastDamped:
    """The least damped mode of a train: frequency [rad/s] and growth rate [1/s], below zero if it decays."""

    frequency: float
    growth: float

    @property
    def damping_ratio(self) -> float:
        """-Re(lambda) / |lambda|; negative if unstable."""
        return -self.growth / math.hypot(self.frequency, self.growth)

    @property
    def log_decrement(self) -> float:
        """Natural logarithm of the ratio of two amplitudes a period apart; negative if unstable."""
        return -2.0 * math.pi * self.growth / self.frequency

    @property
    def stable(self) -> bool:
        """Whether it decays."""
        return self.damping_ratio > -NOISE

    def __str__(self) -> str:
        """In words."""
        return (
            f"{self.frequency / (2.0 * math.pi):.4g} Hz, damping ratio {self.damping_ratio:.4f}, "
            f"logarithmic decrement {self.log_decrement:.3f}"
        )


def log_decrement(modes: WhirlModes) -> Array:
    """Logarithmic decrement of each mode, (k,); negative if unstable."""
    return -2.0 * np.pi * modes.eigenvalues.real / modes.eigenvalues.imag


def least_damped_of(modes: WhirlModes, speed: float) -> LeastDamped:
    """The mode of least damping ratio, at a speed [rad/s]: of those in `REACH`, and of those that grow."""
    ratio = modes.damping_ratio
    counts = (modes.frequency <= REACH * speed) | (ratio < -NOISE)
    counts[:2] |= not counts.any()
    worst = complex(modes.eigenvalues[int(np.argmin(np.where(counts, ratio, np.inf)))])
    return LeastDamped(worst.imag, worst.real)


def least_damped(
    shaft: ShaftModel | ReducedShaft, speed: float, bearings: Bearings, count: int = SEEN
) -> LeastDamped:
    """The least damped of the lowest modes at a speed [rad/s]."""
    return least_damped_of(whirl_modes(shaft, speed, count, bearings=bearings), speed)


def thresholds(modes_at: Callable[[float], WhirlModes], speeds: list[float]) -> list[tuple[float, bool]]:
    """Speeds [rad/s] at which the least damping ratio of all modes passes zero.

    Parameters
    ----------
    modes_at : callable
        Modes of a speed.
    speeds : list of float
        Ascending; between two of them one threshold is found at most.

    Returns
    -------
    list of (float, bool)
        Threshold, and whether the train is unstable above it.
    """

    def damping(speed: float) -> float:
        return float(modes_at(speed).damping_ratio.min()) + NOISE

    values = [damping(speed) for speed in speeds]
    found = []
    for k in range(len(speeds) - 1):
        if (values[k] > 0.0) != (values[k + 1] > 0.0):
            root = scipy.optimize.brentq(
                damping, speeds[k], speeds[k + 1], xtol=1e-9 * speeds[k + 1], rtol=1e-9
            )
            found.append((float(root), values[k + 1] <= 0.0))
    return found


def undamped_critical_speeds(shaft: ShaftModel, stiffness: ArrayLike, count: int) -> Array:
    """Undamped forward critical speeds with the same stiffness in x and y at all bearings.

    In x + i y a shaft that whirls as fast as it turns obeys (K + k B' B) u = Omega^2 (M - P) u with the polar
    inertia P: gyroscopic moments stiffen it.

    Parameters
    ----------
    shaft : ShaftModel
        The unreduced shaft.
    stiffness : array_like, (S,)
        Of each bearing [N/m], positive.
    count : int
        Lowest critical speeds wanted.

    Returns
    -------
    ndarray, (S, count)
        [rad/s], ascending; NaN where there are not as many.
    """
    size = 2 * shaft.nodes
    journals = shaft.bearing_dofs[:, 0] // 2  # deflection of the plane: 2 k of 4 k
    inertia = sp.csc_array(shaft.plane_mass - shaft.plane_polar)
    found = np.full((len(np.atleast_1d(stiffness)), count), np.nan)
    start = np.random.default_rng(0).normal(size=size)
    for row, k in enumerate(np.atleast_1d(stiffness)):
        springs = np.zeros(size)
        np.add.at(springs, journals, float(k))
        held = sp.csc_array(shaft.plane_stiffness + sp.diags_array(springs))
        wanted = min(count, size - 2)
        # the stiffness is positive definite, the inertia need not be: 1/Omega^2 of the largest first
        inverse = sla.LinearOperator((size, size), sla.splu(held).solve)
        values = sla.eigsh(
            inertia, wanted, held, which="LA", Minv=inverse, v0=start, return_eigenvectors=False
        )
        speeds = np.sort(1.0 / np.sqrt(values[values > 0.0]))
        found[row, : len(speeds)] = speeds
    return found


@dataclass(frozen=True)
class CriticalSpeed:
    """A peak of the unbalance response.

    Attributes
    ----------
    speed : float
        Where it is [rad/s].
    amplitude : float
        Of the probe [m].
    probe : int
        The probe that responds most.
    lower, upper : float or None
        Speeds at which the amplitude is `HALF_POWER` of the peak; None where it does not come down so far.
    """

    speed: float
    amplitude: float
    probe: int
    lower: float | None
    upper: float | None

    @property
    def amplification(self) -> float:
        """N_c / (N_2 - N_1), API 684 SP6.8.2.1; of one side twice where the other does not come down."""
        if self.lower is None and self.upper is None:
            return 0.0
        below = None if self.lower is None else self.speed - self.lower
        above = None if self.upper is None else self.upper - self.speed
        width = (below if below is not None else above or 0.0) + (
            above if above is not None else below or 0.0
        )
        return self.speed / width

    def required_margin(self, running: float) -> float:
        """Separation margin in % of the running speed that API 684 SP6.8.2.10 asks for."""
        factor = self.amplification
        if factor < SHARP:
            return 0.0
        share = 17.0 * (1.0 - 1.0 / (factor - 1.5))
        return min(16.0, share) if self.speed < running else min(26.0, 10.0 + share)

    def margin(self, running: float) -> float:
        """Distance from the running speed [rad/s] in % of it."""
        return 100.0 * abs(self.speed - running) / running


def critical_speeds(amplitude: Callable[[float], Array], grid: ArrayLike) -> list[CriticalSpeed]:
    """Peaks of a response over speed.

    Parameters
    ----------
    amplitude : callable
        Amplitudes of the probes at a speed [rad/s].
    grid : array_like, (S,)
        Ascending speeds; peaks are among them, see `rotor_fmu.linear.resonance.refined`.
    """
    speeds = np.asarray(grid, dtype=np.float64)
    values = np.array([amplitude(speed) for speed in speeds])
    peaks: dict[int, CriticalSpeed] = {}
    for probe in range(values.shape[1]):
        line = values[:, probe]
        for k in np.flatnonzero((line[1:-1] > line[:-2]) & (line[1:-1] >= line[2:])) + 1:
            lower, upper = (_crossing(amplitude, speeds, line, int(k), probe, way) for way in (-1, 1))
            peak = CriticalSpeed(float(speeds[k]), float(line[k]), probe, lower, upper)
            if peak.amplification:
                peaks[int(k) * values.shape[1] + probe] = peak
    return _most_lively(list(peaks.values()))


def _crossing(
    amplitude: Callable[[float], Array], speeds: Array, line: Array, peak: int, probe: int, way: int
) -> float | None:
    """Where a line comes down to its half-power level, one way from a peak; None if it rises first."""
    level = HALF_POWER * line[peak]
    k = peak
    while 0 <= k + way < len(line):
        k += way
        if line[k] < level:
            ends = sorted((float(speeds[k - way]), float(speeds[k])))
            return float(
                scipy.optimize.brentq(lambda speed: float(amplitude(speed)[probe]) - level, *ends, rtol=1e-9)
            )
        if line[k] > line[peak]:
            return None
    return None


def _most_lively(peaks: list[CriticalSpeed]) -> list[CriticalSpeed]:
    """Of peaks that are the same resonance, seen by several probes, the one with the largest amplitude."""
    kept: list[CriticalSpeed] = []
    for peak in sorted(peaks, key=lambda p: -p.amplitude):
        if all(abs(peak.speed - other.speed) > 0.5 * max(_width(peak), _width(other)) for other in kept):
            kept.append(peak)
    return sorted(kept, key=lambda p: p.speed)


def _width(peak: CriticalSpeed) -> float:
    return peak.speed / peak.amplification
