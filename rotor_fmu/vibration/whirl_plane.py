"""Both bending planes of a circular shaft as one complex plane.

With r = x + i y the gyroscopic coupling of the planes is a factor -i, and the shaft is complex
linear in the modal coordinates r and the loads: full matrices have half the numbers.  Loads and
journals keep the port's order, read as pairs: Fx + i Fy and Mx + i My, x + i y and tilt_x + i tilt_y.
A slope is tilt_y - i tilt_x = -i (tilt_x + i tilt_y), and a moment about it My - i Mx likewise.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.vibration.modal_shaft import ModalShaft

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

ALIKE = 1e-12
"""Relative difference up to which what the two planes hold counts as the same: rounding."""


@dataclass(frozen=True, eq=False)
class WhirlPlane:
    """``r'' + (D - i speed P) r' + diag(omega^2) r = load w + harmonic`` with k = m / 2 coordinates.

    Attributes
    ----------
    omega : ndarray, (k,)
        Undamped frequencies at rest [rad/s].
    D, P : ndarray, (k, k)
        Damping [1/s] and polar inertia [1].
    journal : ndarray of complex, (2 n_b, k)
        Journal positions, pairs x + i y and tilt_x + i tilt_y of each bearing, from r.
    """

    omega: Array
    D: Array
    P: Array
    journal: Complex

    @property
    def load(self) -> Complex:
        """Modal forces from pairs Fx + i Fy and Mx + i My, (k, 2 n_b)."""
        return self.journal.conj().T

    def harmonic(self, forces: Array) -> Complex:
        """Forces on r, (k, j), from modal forces in both planes, (m, j)."""
        of_x, of_y = np.split(forces, 2)
        return of_x + 1j * of_y


def whirl_plane(shaft: ModalShaft) -> WhirlPlane | None:
    """The shaft in the complex plane, or None if its planes are mixed or not alike.

    Parameters
    ----------
    shaft : ModalShaft
        Coordinates of the x-z plane first, if it is circular.
    """
    k, odd = divmod(shaft.size, 2)
    if odd:
        return None
    rows = shaft.bearing.reshape(-1, 4, shaft.size)
    omega, D, P = shaft.omega[:k], shaft.D[:k, :k], shaft.G[:k, k:]
    deflection, slope = rows[:, 0, :k], rows[:, 3, :k]
    # Both planes as they would be if that of x told all.
    nothing = np.zeros_like(D)
    both = np.zeros_like(rows)
    both[:, 0, :k] = both[:, 1, k:] = deflection
    both[:, 3, :k], both[:, 2, k:] = slope, -slope
    pairs = (
        (shaft.omega, np.concatenate([omega, omega])),
        (shaft.D, np.block([[D, nothing], [nothing, D]])),
        (shaft.G, np.block([[nothing, P], [-P, nothing]])),
        (rows, both),
    )
    if not all(_same(found, circular) for found, circular in pairs):
        return None
    journal = np.stack([deflection, 1j * slope], axis=1).reshape(-1, k)
    return WhirlPlane(omega, D, P, journal)


def _same(one: Array, other: Array) -> bool:
    return bool(np.abs(one - other).max(initial=0.0) <= ALIKE * np.abs(one).max(initial=0.0))
