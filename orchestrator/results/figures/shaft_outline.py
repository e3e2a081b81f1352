"""Outline of shaft and wheels along a deformed line."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.collections import PolyCollection

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from rotor_fmu.train.train import Train

BAND = 0.012
"""Thickness of a shaft of unknown diameters, as a share of its length."""
WHEEL_THICKNESS = 0.0075
"""Width of a wheel in the drawing as a share of the train's length; the train's data know none."""


def draw_shaft(
    axes: Axes,
    z: NDArray[np.float64],
    line: NDArray[np.float64],
    stress: NDArray[np.float64],
    shown: float,
    stress_limit: float,
    train: Train | None,
) -> PolyCollection:
    """Draw one quadrilateral a shoulder, coloured by stress.

    Parameters
    ----------
    axes : Axes
        Its ordinate counts deflection.
    z, line, stress : ndarray, shape (nodes,)
        Axial position [m], deflection in the ordinate's unit, normal stress as shown.
    shown : float
        Ordinate units for one metre of geometry.
    stress_limit : float
        Upper end of the colour scale.
    train : Train or None
        Gives the diameters.
    """
    if train is not None:
        radius = np.array([shoulder.widest / 2 for shoulder in train.shoulders]) * shown
    else:
        radius = np.full(z.size - 1, BAND * z[-1] / 2 * shown)
    corners = np.stack(
        [
            np.column_stack([z[:-1], line[:-1] - radius]),
            np.column_stack([z[1:], line[1:] - radius]),
            np.column_stack([z[1:], line[1:] + radius]),
            np.column_stack([z[:-1], line[:-1] + radius]),
        ],
        axis=1,
    )
    shaft = PolyCollection(list(corners), cmap="viridis", linewidths=0.3, edgecolors="face", zorder=3)
    shaft.set_array(np.maximum(stress[:-1], stress[1:]))
    shaft.set_clim(0.0, stress_limit)
    axes.add_collection(shaft)
    return shaft


def draw_wheels(axes: Axes, train: Train, line: NDArray[np.float64], shown: float) -> None:
    """Draw the wheels of known diameter as discs across the deformed line."""
    z = np.asarray(train.z)
    bodies = []
    for wheel in train.wheels:
        if wheel.mean_diameter > 0:
            half, radius = WHEEL_THICKNESS * z[-1] / 2, wheel.mean_diameter / 2 * shown
            left, right, middle = z[wheel.node] - half, z[wheel.node] + half, line[wheel.node]
            bodies.append(
                [
                    (left, middle - radius),
                    (right, middle - radius),
                    (right, middle + radius),
                    (left, middle + radius),
                ]
            )
    axes.add_collection(
        PolyCollection(bodies, facecolors="#E3E6EA", edgecolors="#8A9099", linewidths=0.6, zorder=2)
    )
