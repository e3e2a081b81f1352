"""One macro step of the shaft on bearings with an affine law.

Wrenches w = F0 - K q - C v act on the journals.  At the start of the step they
follow from the state, at the end from the state to be found; in between they run
linearly.  With y1 = y_free + S w1 the journals' q and v at the end and
L = [K C] of all bearings, the law leaves one linear solve in 4 n_b wrench components:

    (1 + L S) w1 = F0 - L y_free

Wrenches are counted from those of the static equilibrium about which the shaft vibrates.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from rotor_fmu.condensation import Equilibrium
from rotor_fmu.coordinates import Coordinates, Maps

Array = NDArray[np.float64]

HARMONICS = 2
"""Harmonic inputs of a step: the nominal unbalance and the lost blade's."""


class StepFailure(ArithmeticError):
    """The step has no finite result; the state before it stands."""


class AffineStep:
    """Takes macro steps in any coordinates; owns the memory that the law needs.

    Parameters
    ----------
    bearings : int
        Number n_b of bearings.
    """

    def __init__(self, bearings: int) -> None:
        loads = 4 * bearings
        # Views share memory: what is written to one is read as the other.
        self._law = np.zeros((bearings, 4, 8))
        self._matrix = np.zeros((bearings, 4, loads))
        self._square = self._matrix.reshape(loads, loads)
        self._diagonal = self._square.reshape(-1)[:: loads + 1]
        self._reaction = np.zeros((bearings, 4, 1))

    def set_law(self, K: Array, C: Array) -> None:
        """Take stiffness and damping of the bearings, (n_b, 4, 4) each, for the steps to come."""
        self._law[:, :, :4] = K
        self._law[:, :, 4:] = C

    def wrench(self, F0: Array, journals: Array, static: Equilibrium[np.float64]) -> Array:
        """Wrenches of the law last set, counted from those of the static equilibrium, (4 n_b,)."""
        return F0.reshape(-1) - static.wrench - self._react(journals)

    def advance(
        self,
        coordinates: Coordinates,
        maps: Maps,
        motion: Array,
        journals: Array,
        F0: Array,
        rotation: Array,
        kick: Array | None,
        static: Equilibrium[np.float64],
    ) -> Array:
        """Take a step under the law last set.

        Parameters
        ----------
        coordinates, maps : Coordinates, Maps
            Of this speed and step; two harmonic inputs, the nominal unbalance and the lost blade's.
        motion : ndarray, (2 m,)
            At the start, in these coordinates.
        journals : ndarray, (n_b, 8)
            `journal_motion` at the start.
        F0 : ndarray, (n_b, 4)
            Constant part of the law.
        rotation : ndarray, (4,)
            cos and sin of the angle of rotation at the start, for each harmonic input; 0 to leave one out.
        kick : ndarray, (2 m,), optional
            What a force acting during a part of the step only adds to the motion at the end.
        static : Equilibrium
            The static equilibrium.

        Returns
        -------
        ndarray, (2 m,)
            The motion at the end.

        Raises
        ------
        StepFailure
            If the law has no solution at the end of the step, or numbers are not finite.
        """
        offset = F0.reshape(-1) - static.wrench
        end = maps.coast(motion, offset - self._react(journals), rotation)
        if kick is not None:
            end += kick
        wrench = offset - self._react(journal_motion(coordinates, end, static))
        np.matmul(self._law, maps.compliance, out=self._matrix)
        self._diagonal += 1.0
        # The matrix is stored by rows, LAPACK reads columns: factor the transpose, solve transposed.
        factor, pivots, info = lapack.dgetrf(self._square.T, overwrite_a=1)
        if info == 0:
            wrench, info = lapack.dgetrs(factor, pivots, wrench, trans=1)
        maps.add_end(wrench, end)
        if info != 0 or not np.isfinite(np.dot(end, end)):
            raise StepFailure(
                "rotor: the step has no finite result; check F0, K and C of the bearings, or halve the step"
            )
        return end

    def _react(self, journals: Array) -> Array:
        """L y: what stiffness and damping take off F0."""
        np.matmul(self._law, journals.reshape(-1, 8, 1), out=self._reaction)
        return self._reaction.reshape(-1)


def journal_motion(coordinates: Coordinates, motion: Array, static: Equilibrium[np.float64]) -> Array:
    """Journal displacements and velocities (q, v) of a motion about an equilibrium, (n_b, 8)."""
    y = coordinates.journals(motion).reshape(-1, 8)
    y[:, :4] += static.journals.reshape(-1, 4)
    return y
