"""Where a journal stood when a run ended early, in words for the message."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from orchestrator.master.system import RESPONSE, System
from orchestrator.master.time_loop import RunEnd
from orchestrator.outcome import Outcome

_STATELESS = (Outcome.FINISHED, Outcome.INTERRUPTED, Outcome.TERMINATED)
"""Ends that have nothing to do with where the journals are."""


def with_state(end: RunEnd, system: System, offsets: NDArray[np.float64]) -> str:
    """Return the message of a run's end with the last state of the bearing that it is about.

    Parameters
    ----------
    end : RunEnd
        Its unit tells the bearing; where that is the rotor or unknown, the one with the largest
        eccentricity ratio is taken.
    system : System
        As it was left; no unit is asked for anything, for the failed one may not answer.
    offsets : ndarray (bearings, 4)
        Bearing centres and axes in m and rad.

    Returns
    -------
    str
        Unchanged for a run that finished or was stopped.
    """
    if end.outcome in _STATELESS:
        return end.message
    names = [bearing.name for bearing in system.bearings]
    eccentricity = system.responses[:, RESPONSE["eccentricity"]]
    finite = np.isfinite(eccentricity)
    if end.unit in names:
        index = names.index(end.unit)
    else:
        index = int(np.argmax(np.where(finite, eccentricity, -1.0)))
    tilt = 1e6 * (system.motion[index, 2:4] - offsets[index, 2:])
    gap = 1e6 * system.responses[index, RESPONSE["h_min"]]
    return (
        f"{end.message}; last state of {names[index]}: eccentricity ratio {eccentricity[index]:.4g}, "
        f"tilts {tilt[0]:.4g} and {tilt[1]:.4g} urad, least gap {gap:.4g} um"
    )
