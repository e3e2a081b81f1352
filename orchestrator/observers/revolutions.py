"""What each revolution of the rotor was like: orders, overall vibration, extremes; kept for the whole run.

Of a journal's motion in its bearing the complex amplitude of an order k is, with the angle a of the rotor,

    A = 1 / (2 pi) * integral of x exp(-i k a) da over this revolution and the one before

by the trapezoidal rule over the steps; over two, for half and whole orders to leave one another alone.  The
speed may change in them.  A run of an hour at 25 Hz has 90000 rows of some hundred numbers a bearing, so the
record of a long run may have few instants and all of its revolutions.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from orchestrator.master.coupling import Advance
from orchestrator.master.observer import Observer
from orchestrator.master.stepping import Stepper
from orchestrator.master.system import RESPONSE, System
from orchestrator.observers.rows import Rows

Array = NDArray[np.float64]

ORDERS = (0.5, 1.0, 2.0)
EXTREMES = ("least_gap", "contact_force", "force")
"""Of a revolution, at the ends of its steps: the least, and the largest two."""
_GAP, _CONTACT = RESPONSE["h_min"], RESPONSE["contact_force"]
_TURN = 2.0 * math.pi
_CHUNK = 64
"""Instants that are added up in one go."""
_GOING_ON = ("sum", "last", "range", "most", "angles", "motions", "values")
"""Those of the revolution that is going on."""


class Revolutions(Observer):
    """Keeps a row a revolution.

    Parameters
    ----------
    system : System
        Watched after each of its steps.

    Attributes
    ----------
    rows : Rows
        Those that are not written elsewhere.
    """

    def __init__(self, system: System) -> None:
        n = len(system.bearings)
        self._system = system
        self._orders = np.array(ORDERS)
        self.rows = Rows(
            {
                "times": ((), float),
                "speeds": ((), float),
                "amplitudes": ((len(ORDERS), n, 2), complex),
                "overall": ((n, 2), float),
                "extremes": ((n, len(EXTREMES)), float),
            }
        )
        # of the revolution that is going on
        self._angle = self._began = 0.0
        self._sum = np.zeros((len(ORDERS), n, 2), dtype=complex)
        self._last = np.full_like(self._sum, np.nan)
        self._signs = np.exp(1j * _TURN * self._orders).real[:, None, None]
        self._range = np.zeros((2, n, 2))
        self._most = np.zeros((n, len(EXTREMES)))
        # its instants that are not added up yet; the first is the last of those that are
        self._held = 0
        self._angles, self._motions = np.zeros(_CHUNK), np.zeros((_CHUNK, n, 2))
        self._values = np.zeros((_CHUNK, n, len(EXTREMES)))

    def begin(self, stepper: Stepper) -> None:
        """Take the start of the run."""
        self._renew(0.0, self._system.motion[:, :2])

    def watch(self, start: float, end: float, advance: Advance) -> None:
        """Add a step."""
        motion = self._system.motion[:, :2]
        first = self._angle
        last = first + abs(self._system.speed) * (end - start)
        while last >= _TURN:
            share = (_TURN - first) / (last - first)
            before = self._motions[self._held - 1]
            between = before + share * (motion - before)
            self._hold(_TURN, between)
            self._close(start + share * (end - start))
            first, last, start = 0.0, last - _TURN, start + share * (end - start)
            self._renew(0.0, between)
        self._hold(last, motion)
        self._angle = last

    def _hold(self, angle: float, motion: Array) -> None:
        if self._held == _CHUNK:
            self._add()
        k = self._held
        self._angles[k], self._motions[k] = angle, motion
        responses, forces, values = self._system.responses, self._system.forces, self._values[k]
        np.negative(responses[:, _GAP], out=values[:, 0])
        values[:, 1] = responses[:, _CONTACT]
        np.hypot(forces[:, 0], forces[:, 1], out=values[:, 2])
        self._held = k + 1

    def _add(self) -> None:
        angles, motions = self._angles[: self._held], self._motions[: self._held]
        halves = 0.5 * np.diff(angles)
        weights = np.zeros_like(angles)
        weights[:-1] += halves
        weights[1:] += halves
        factors = weights * np.exp(-1j * self._orders[:, None] * angles)
        self._sum += np.tensordot(factors, motions, 1)
        np.minimum(self._range[0], motions.min(axis=0), out=self._range[0])
        np.maximum(self._range[1], motions.max(axis=0), out=self._range[1])
        np.maximum(self._most, self._values[: self._held].max(axis=0), out=self._most)
        for kept in (self._angles, self._motions, self._values):
            kept[0] = kept[self._held - 1]
        self._held = 1

    def _close(self, time: float) -> None:
        self._add()
        self.rows.add(
            times=time,
            speeds=_TURN / (time - self._began),
            # Angles begin at 0 in each revolution: the factor of half an order turns by -1 to the next.
            amplitudes=(self._sum + self._signs * self._last) / _TURN,
            overall=self._range[1] - self._range[0],
            extremes=self._most * (-1.0, 1.0, 1.0),
        )
        self._last[:] = self._sum
        self._began = time

    def _renew(self, angle: float, motion: Array) -> None:
        self._sum[:], self._most[:] = 0.0, -np.inf
        self._range[0], self._range[1] = np.inf, -np.inf
        self._held = 0
        self._hold(angle, motion)

    def arrays(self) -> dict[str, NDArray[Any]]:
        """All that it holds, by name."""
        now = {name: getattr(self, f"_{name}") for name in _GOING_ON}
        return {**self.rows.arrays(), **now, "turn": np.array([self._angle, self._began, self._held])}

    def restore(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what `arrays` returned."""
        self.rows.restore(arrays)
        for name in _GOING_ON:
            getattr(self, f"_{name}")[:] = arrays[name]
        self._angle, self._began, held = arrays["turn"].tolist()
        self._held = int(held)

    @property
    def times(self) -> Array:
        """Ends of the revolutions in s."""
        return self.rows["times"]

    @property
    def speeds(self) -> Array:
        """Mean speeds in them in rad/s."""
        return self.rows["speeds"]

    @property
    def amplitudes(self) -> NDArray[np.complex128]:
        """Of each order, (revolutions, orders, bearings, 2) in m; not-a-number in the first revolution."""
        return self.rows["amplitudes"]

    @property
    def overall(self) -> Array:
        """Peak to peak, (revolutions, bearings, 2) in m."""
        return self.rows["overall"]

    def extreme(self, name: str) -> Array:
        """One of `EXTREMES`, (revolutions, bearings)."""
        return self.rows["extremes"][:, :, EXTREMES.index(name)]
