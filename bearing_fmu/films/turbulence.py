"""Turbulent films: flow and friction by the local Reynolds number.

The oil flows as in a laminar film whose resistance 12 eta / h^3 is larger, and the moving wall drags more ::

    k_around = 12 + 0.0136 Re^0.90,   k_along = 12 + 0.0043 Re^0.96,   tau = (1 + 0.0012 Re^0.94) eta U / h

with Re = rho U h / eta of the gap open to the oil: the fits that are quoted after Constantinescu (1962, J.
Basic Eng. 84, 139; Constantinescu and Galetuse 1974; Frene et al. 1990, Hydrodynamic Lubrication), here
from memory, not held against a printed table.  They go on smoothly to the laminar film, and need no
threshold; Taylor's vortices begin at Re = 41.1 sqrt(R / C) of the clearance (Taylor 1923).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.result import CONDUCTANCE, OPEN, POWER

Floats = NDArray[np.float64]

LAMINAR_POWER = 3.0
"""Of the gap in the laminar conductance."""

AROUND = (0.0136, 0.90)
ALONG = (0.0043, 0.96)
DRAG = (0.0012, 0.94)


@inner_kernel
def flow_share(reynolds: float, law: tuple[float, float]) -> tuple[float, float]:
    """Flow over that of the laminar film, 12 / k, and -d log / d log h of it."""
    more = law[0] * reynolds ** law[1]
    share = 12.0 / (12.0 + more)
    return share, law[1] * (1.0 - share)


@inner_kernel
def drag(reynolds: float) -> float:
    """Shear of the moving wall over that of the laminar film."""
    return 1.0 + DRAG[0] * reynolds ** DRAG[1]


@inner_kernel
def slow_down(reynolds: float, count: int, law: tuple[float, float], field: Floats) -> None:
    """Make the laminar conductances of a row of points turbulent.

    Parameters
    ----------
    reynolds : float
        rho U C / eta.
    count : int
        Points.
    law : tuple of float
        `AROUND` or `ALONG`.
    field : ndarray, shape (FIELDS, >= count)
        Conductance and power are changed.
    """
    t, conductance, power = field[OPEN], field[CONDUCTANCE], field[POWER]
    for i in range(count):
        share, less = flow_share(reynolds * t[i], law)
        conductance[i] *= share
        power[i] = LAMINAR_POWER - less
