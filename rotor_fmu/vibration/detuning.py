"""What a speed off that of the coordinates does to a step: the gyroscopic part, to first order.

At the speed W + d, with the acceleration a, the shaft is z' = (A + d E1 + a E2) z + ... with the gyroscopic
matrix in E1, of the rates, and in E2, of the displacements: the spin's angular momentum grows along the axis
of each section, and with the drive's torque along the axis of the bearings a moment a G x is left (Genta
2005, Dynamics of Rotating Systems, section 6).  A step of exp(A H) then becomes, to first order in d and a,

    exp(A H) + d X(E1) + a X(E2),      X(E) = integral of exp(A (H - s)) E exp(A s) over 0..H

(Frechet derivative of the exponential; Higham 2008, Functions of Matrices, section 10.2).  With modes on a
grid of speeds d is at most half of `SPACING`; what is left out makes a mode grow by d^2 H / 2 at most, per
second.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.linalg as sl
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

SPACING = 2.0
"""Of the grid of speeds at which modes are found [rad/s]."""


def grid_speed(speed: float) -> float:
    """The speed of the grid nearest to a speed [rad/s]."""
    return SPACING * round(speed / SPACING)


@dataclass(frozen=True, eq=False)
class Detuning:
    """X(E1) and X(E2) of a step, (2, s, s), real, or complex for motions of pairs."""

    derivatives: NDArray[Any]

    def moved(self, motion: Array, difference: float, acceleration: float) -> Array:
        """What is added to the motion at the end of the step.

        Parameters
        ----------
        motion : ndarray, (2 m,)
            At its start.
        difference, acceleration : float
            d [rad/s] and a [rad/s2].
        """
        of_speed, of_acceleration = self.derivatives
        before = motion.view(self.derivatives.dtype)
        after = difference * (of_speed @ before) + acceleration * (of_acceleration @ before)
        return np.asarray(after.view(np.float64))


def dense_detuning(A: Array, directions: tuple[Array, Array], step: float) -> Detuning:
    """Of any matrix A, (s, s)."""
    return Detuning(np.array([sl.expm_frechet(A * step, E * step, compute_expm=False) for E in directions]))


def block_detuning(
    block: Complex, rates: Complex, directions: tuple[Complex, Complex], step: float
) -> Detuning:
    """Of A with a small block, (b, b), and on its diagonal rates far from the eigenvalues of the block."""
    return Detuning(np.array([_of_blocks(block, rates, E, step) for E in directions]))


def _of_blocks(block: Complex, rates: Complex, E: Complex, step: float) -> Complex:
    b = len(block)
    grown, growth = sl.expm(block * step), np.exp(rates * step)
    X = np.empty_like(E)
    if b:
        X[:b, :b] = sl.expm_frechet(block * step, E[:b, :b] * step, compute_expm=False)
        # B X - X L = exp(B H) C - C exp(L H), column by column, and likewise for the rows
        right = grown @ E[:b, b:] - E[:b, b:] * growth
        X[:b, b:] = _solved(block, rates, right)
        below = E[b:, :b] @ grown - growth[:, None] * E[b:, :b]
        X[b:, :b] = _solved(block.T, rates, below.T).T
    X[b:, b:] = E[b:, b:] * _divided(rates, growth, step)
    return X


def _solved(block: Complex, rates: Complex, right: Complex) -> Complex:
    """X of B X - X diag(rates) = right, (b, k)."""
    shifted = block[None] - rates[:, None, None] * np.eye(len(block))
    return np.asarray(np.linalg.solve(shifted, right.T[:, :, None])[:, :, 0].T)


def _divided(rates: Complex, growth: Complex, step: float) -> Complex:
    """Divided differences of exp(rate H), (k, k), without cancellation where rates are near."""
    difference = (rates[:, None] - rates[None, :]) * step
    slower = difference.real > 0.0  # from the one that decays less, so that nothing overflows
    exponent = np.where(slower, -difference, difference)
    from_which = np.where(slower, growth[:, None], growth[None, :])
    safe = np.where(exponent == 0.0, 1.0, exponent)
    return np.asarray(step * from_which * np.where(exponent == 0.0, 1.0, np.expm1(safe) / safe))
