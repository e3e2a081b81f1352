"""The quantities at bearings whose extremes are kept."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

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

_FORCE, _MOMENT, DEFECT, STEP_ERROR = (
    EXTREMES.index(name) for name in ("force_magnitude", "moment_magnitude", "defect", "step_error")
)
SCALARS = slice(EXTREMES.index("least_gap"), EXTREMES.index("wiped") + 1)
_OUTPUTS = [
    RESPONSE[name] for name in ("h_min", "h_min_centre", "contact_force", "contact_pressure", "wiped")
]
"""Bearing outputs of which the extremes in `SCALARS` are taken."""
SIGN = np.array([-1.0 if name.endswith("gap") else 1.0 for name in EXTREMES])


def extremes_of(responses: Array, out: Array | None = None) -> Array:
    """What the extremes are taken of, the larger the more extreme, (..., 9); errors are left out."""
    now = np.full((len(responses), len(EXTREMES)), -np.inf) if out is None else out
    np.hypot(responses[:, 0], responses[:, 1], out=now[:, _FORCE])
    np.hypot(responses[:, 2], responses[:, 3], out=now[:, _MOMENT])
    np.multiply(responses[:, _OUTPUTS], SIGN[SCALARS], out=now[:, SCALARS])
    return now
