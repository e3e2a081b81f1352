"""Affine laws through both ends of a step.

A rotor that lets the wrench run between the ends of the step takes its start value from the law, too:
``w0 = F0 - K q0 - C v0``.  A law re-linearised at the end of the step would miss the true
wrench at the start by the curvature of the film.  So the tangent at the end is changed as
little as possible that the law meets the wrench at the start: the update of rank one of
Broyden (1965, Math. Comp. 19, 577-593), in coordinates weighted by what each moves the wrench.
At convergence the law is exact at both ends.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_NOTHING = 1e-10
"""Change of the wrench over a step, against its scale, below which the tangent stays as it is."""


def secant_laws(
    start: tuple[Array, Array], end: tuple[Array, Array], tangent: Array, scale: Array, out: Array
) -> None:
    """Write the laws through the wrenches at both ends of a step.

    Parameters
    ----------
    start, end : tuple of ndarray (bearings, 8) and (bearings, 4)
        Journals in their housings (q, v) and the wrenches there.
    tangent : ndarray (bearings, 4, 8)
        [K C] at the end.
    scale : ndarray (bearings, 4)
        What forces and moments are measured by.
    out : ndarray (bearings, 36)
        F0, K, C by rows.
    """
    moved = end[0] - start[0]
    missed = start[1] - end[1] - np.matmul(tangent, moved[..., None])[..., 0]
    weight = np.sum((tangent / scale[..., None]) ** 2, axis=1)
    direction = weight * moved
    direction /= (np.sum(direction * moved, axis=1) + _NOTHING**2)[:, None]
    secant = tangent + missed[..., None] * direction[:, None, :]
    out[:, :4] = end[1] + np.matmul(secant, end[0][..., None])[..., 0]
    out[:, 4:20] = secant[:, :, :4].reshape(-1, 16)
    out[:, 20:] = secant[:, :, 4:].reshape(-1, 16)
