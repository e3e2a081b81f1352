"""The state of a journal in its film in words, for messages; nothing here is on the way of a step."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from bearing_fmu.bore.bore import bore_of, least_gap
from bearing_fmu.parameters import BearingParameters


def state_in_words(
    parameters: BearingParameters, q: ArrayLike, v: ArrayLike, speed: float, *, tilted: bool
) -> str:
    """Say where a journal stands in its bore.

    Parameters
    ----------
    parameters : BearingParameters
        The bearing.
    q, v : array_like, shape (4,)
        Relative position (m, rad) and velocity (m/s, rad/s).
    speed : float
        Rotor speed, rad/s.
    tilted : bool
        Whether the film sees the tilts; else the least gap is that of the aligned journal.

    Returns
    -------
    str
        Eccentricity ratio, tilts, least gap, velocity, speed, with their units.
    """
    q, v = np.asarray(q, dtype=float), np.asarray(v, dtype=float)
    clearance, lever = parameters.clearance, 0.5 * parameters.width
    scaled = q / clearance
    scaled[2:] *= lever if tilted else 0.0
    gap = clearance * least_gap(bore_of(parameters.arcs, parameters.columns), scaled)[0]
    return (
        f"eccentricity ratio {np.hypot(q[0], q[1]) / clearance:.4g}, "
        f"tilts {1e6 * q[2]:.4g} and {1e6 * q[3]:.4g} urad{'' if tilted else ' (not seen at this depth)'}, "
        f"least gap {1e6 * gap:.4g} um of a clearance of {1e6 * clearance:.4g} um, "
        f"velocity {v[0]:.3g} and {v[1]:.3g} m/s, speed {speed:.4g} rad/s"
    )
