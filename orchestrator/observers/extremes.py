"""The quantities at bearings whose extremes are kept."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fmus.kernels.loops import compiled
from orchestrator.master.system import RESPONSE

Array = NDArray[np.float64]

EXTREMES = (
    "force_magnitude",
    "moment_magnitude",
    "least_gap",
    "centre_line_gap",
    "contact_force",
    "contact_pressure",
    "wiped",
    "defect",
    "step_error",
)
"""Quantities whose extremes are kept; the gaps' least, the others' largest."""

DEFECT = EXTREMES.index("defect")
_OUTPUTS = np.array(
    [RESPONSE[name] for name in ("h_min", "h_min_centre", "contact_force", "contact_pressure", "wiped")]
)
"""Bearing outputs of which the extremes between those of wrenches and of errors are taken."""
SIGN = np.array([-1.0 if name.endswith("gap") else 1.0 for name in EXTREMES])


def extremes_of(responses: Array) -> Array:
    """What the extremes are taken of, the larger the more extreme, (n, 9); errors are left out."""
    now = np.full((len(responses), len(EXTREMES)), -np.inf)
    _take(responses, _OUTPUTS, SIGN, now)
    return now


class Noted:
    """The extremes of bearings since a record, and of the whole run.

    Attributes
    ----------
    now, since, peaks : ndarray (bearings, 9)
        Of the last step, since it was last set to minus infinity, and of all; the larger the more extreme.
    times : ndarray (bearings, 9)
        Instants of `peaks` in s.
    """

    def __init__(self, bearings: int) -> None:
        self.now = np.empty((bearings, len(EXTREMES)))
        self.since, self.peaks = np.full_like(self.now, -np.inf), np.full_like(self.now, -np.inf)
        self.times = np.zeros_like(self.now)
        self._nothing, self._all = np.zeros((bearings, 4)), np.ones(bearings, dtype=bool)

    def note(
        self,
        time: float,
        responses: Array,
        defect: Array | None = None,
        of_length: Array | None = None,
        evaluated: NDArray[np.bool_] | None = None,
    ) -> None:
        """Take a step: outputs of bearings, errors (bearings, 4), and who was evaluated, by default all."""
        defect, of_length = (self._nothing if error is None else error for error in (defect, of_length))
        whose = self._all if evaluated is None else evaluated
        about = defect, of_length, whose, self.now, self.since, self.peaks, self.times
        _take_and_note(time, responses, _OUTPUTS, SIGN, *about)

    def note_later(self, times: Array, bearings: NDArray[np.intp], found: Array) -> None:
        """Take extremes (m, 9) that became known later: at instants (m,) of bearings (m,)."""
        _note_later(times, bearings, found, self.peaks, self.times)


@compiled
def _take(responses: Array, outputs: NDArray[np.intp], sign: Array, now: Array) -> None:
    for b in range(len(now)):
        now[b, 0] = math.hypot(responses[b, 0], responses[b, 1])
        now[b, 1] = math.hypot(responses[b, 2], responses[b, 3])
        for k in range(len(outputs)):
            now[b, 2 + k] = responses[b, outputs[k]] * sign[2 + k]


@compiled
def _note(
    time: float,
    defect: Array,
    of_length: Array,
    evaluated: NDArray[np.bool_],
    now: Array,
    since: Array,
    peaks: Array,
    times: Array,
) -> None:
    last = now.shape[1] - 1
    for b in range(len(now)):
        now[b, last - 1] = math.hypot(defect[b, 0], defect[b, 1])
        now[b, last] = math.hypot(of_length[b, 0], of_length[b, 1])
        if not evaluated[b]:
            now[b, :last] = -math.inf
        for k in range(last + 1):
            if now[b, k] > since[b, k] or math.isnan(now[b, k]):
                since[b, k] = now[b, k]
            if now[b, k] > peaks[b, k]:
                peaks[b, k], times[b, k] = now[b, k], time


@compiled
def _take_and_note(
    time: float,
    responses: Array,
    outputs: NDArray[np.intp],
    sign: Array,
    defect: Array,
    of_length: Array,
    evaluated: NDArray[np.bool_],
    now: Array,
    since: Array,
    peaks: Array,
    times: Array,
) -> None:
    _take(responses, outputs, sign, now)
    _note(time, defect, of_length, evaluated, now, since, peaks, times)


@compiled
def _note_later(at: Array, bearings: NDArray[np.intp], found: Array, peaks: Array, times: Array) -> None:
    for m in range(len(found)):
        b = bearings[m]
        for k in range(found.shape[1]):
            if found[m, k] > peaks[b, k]:
                peaks[b, k], times[b, k] = found[m, k], at[m]
