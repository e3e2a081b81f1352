"""Laws that bend on: the tangent of a bearing as it will be within the interval that begins.

A tangent misses what the wrench bends by within the interval h.  While the motion is smooth, K and C go on
changing as they did over the interval before, by D a second.  Where the motion runs straight, a tangent
``K + D h / 3`` then has the mean wrench of the interval to third order, at no evaluation.  It stays a
stiffness and a damping, which the rotor takes implicitly; the last defect, added as a force, was tried and
does harm in contact.  There films stiffen faster than an interval before can tell, so `SHARE` of the third is
taken, and of the change of each component no more than `MOST` of itself.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SHARE = 0.8
"""Of the third of a change that a smooth motion asks for.

Big train through the fracture, evaluations for an RMS force error of 0.5 % with a share of 0, 0.6, 0.8 and
1 of it: 3300, 3105, 2950 and 3220.
"""

FINEST = 1e-3
"""Tolerance below which laws are not bent: as the end of the pressure goes over the grid of a film its
tangent jumps a little, and intervals short enough to follow that lose their order (1.8, not 2, on the small
train)."""

MOST = 0.5
"""Change of a component of K or C over an interval, against itself, that is followed at most."""


def bent_laws(wrench: Array, tangent: Array, before: Array, ratio: Array, where: Array) -> Array:
    """Laws for the intervals that begin.

    Parameters
    ----------
    wrench : ndarray (n, 4)
        Of the bearings, where they stand.
    tangent, before : ndarray (n, 32)
        K and C by rows there, and where the bearings stood before.
    ratio : ndarray (n,)
        Length of the interval that begins over that of the one that ends; 0 where there was none.
    where : ndarray (n, 8)
        q and v of the journals.

    Returns
    -------
    ndarray (n, 36)
        F0, K, C by rows.
    """
    change = (tangent - before) * ratio[:, None]
    most = MOST * np.abs(tangent)
    np.clip(change, -most, most, out=change)
    law = np.empty((len(wrench), 36))
    bent = law[:, 4:]
    np.add(tangent, SHARE / 3.0 * change, out=bent)
    parts = np.matmul(bent.reshape(-1, 2, 4, 4), where.reshape(-1, 2, 4, 1))
    np.add(wrench, parts[:, 0, :, 0], out=law[:, :4])
    law[:, :4] += parts[:, 1, :, 0]
    return law
