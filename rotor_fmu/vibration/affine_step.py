"""One macro step of the shaft on bearings with an affine law.

Wrenches w = F0 - K q - C v act on the journals.  At the start of the step they
follow from the state, at the end from the state to be found; in between they run
linearly.  With y1 = y_free + S w1 the journals' q and v at the end and
L = [K C] of all bearings, the law leaves one linear solve in 4 n_b wrench components:

    (1 + L S) w1 = F0 - L y_free

Wrenches are counted from those of the static equilibrium about which the shaft vibrates.

A linear hold is the most accurate one, and bears a stiffness k against a mass m that rides on it up
to k H^2 / m = 12 (Newmark's method with beta = 1/6, the linear acceleration).  The mean of both ends,
held through the step (beta = 1/4), bears any: the work of a spring, -k (x1^2 - x0^2) / 2, then is exact.
A mixture with a share c of the mean bears k H^2 / m < 12 / (1 - c) (Hughes 1987, The Finite Element
Method, section 9.1).  Films stay far below; a journal pressed into its shell does not.  So each bearing
gets the share that keeps it at half of what it would bear: c = 1 - 1/s where the stiffness number s,
k H^2 / (6 m) of a mass on a spring (`coordinates.Compliance.stiffness_numbers`), is above 1.
The mixture is linear in time again, each end moved towards the other by c / 2 of their distance.
On a shaft that vibrates elastically within the step, or with dampers as stiff, there is no such proof:
steps several times as long as 2 sqrt(3 m / k) may still be upset, and the defect tells.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.shaft.condensation import Equilibrium
from rotor_fmu.vibration.coordinates import Coordinates, Maps
from rotor_fmu.vibration.law_loops import begin, end_wrenches, react
from rotor_fmu.vibration.trail import Extrapolation, Trail

Array = NDArray[np.float64]


class NoFiniteResult(ArithmeticError):
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
        self._law = np.zeros((bearings, 4, 8))
        self._matrix = np.zeros((loads, loads))
        self._nothing = np.zeros(loads)

    def set_law(self, K: Array, C: Array) -> None:
        """Take stiffness and damping of the bearings, (n_b, 4, 4) each, for the steps to come."""
        self._law[:, :, :4] = K
        self._law[:, :, 4:] = C

    def held(
        self,
        nearer: Array | None,
        F0: Array,
        start: Array,
        end: Array,
        static: Equilibrium[np.float64],
    ) -> tuple[Array, Array]:
        """Wrenches between which a step under the law last set ran, (4 n_b,) each.

        Parameters
        ----------
        nearer : ndarray or None
            What `advance` said of it.
        F0, static
            As it took them.
        start, end : ndarray, (n_b, 8)
            The journals at both ends.

        Returns
        -------
        tuple of ndarray
            Counted from those of the static equilibrium.
        """
        offset = F0.reshape(-1) - static.wrench
        w0, w1 = (self._reacting(offset, journals) for journals in (start, end))
        if nearer is None:
            return w0, w1
        moved = nearer * (w1 - w0)
        return w0 + moved, w1 - moved

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
        beyond: Extrapolation | None = None,
    ) -> tuple[Array, Array | None, Trail | None]:
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
        beyond : Extrapolation, optional
            Of journals without mass.

        Returns
        -------
        motion : ndarray, (2 m,)
            At the end.
        nearer : ndarray, (4 n_b,), or None
            c / 2 of each wrench component, for `held`; None where all ran linearly.
        trail : Trail or None
            Of the extrapolation, if there is one.

        Raises
        ------
        NoFiniteResult
            If the law has no solution at the end of the step, or numbers are not finite.
        """
        offset = F0.reshape(-1) - static.wrench
        start, shares, compliance = np.empty_like(offset), np.empty_like(offset), maps.compliance
        own = compliance.own, compliance.mixed
        nearer = shares if begin(self._law, offset, journals, *own, start, shares) else None
        if nearer is None:
            end = maps.coast(motion, start, rotation)
        else:
            later = nearer * start
            end = maps.coast(motion, start - later, rotation)
            maps.add_end(later, end)
        if kick is not None:
            end += kick
        journals = journal_motion(coordinates, end, static)
        share = 1.0 if nearer is None else 1.0 - 2.0 * nearer
        of_start, of_end = compliance.start, compliance.end
        at_start = self._nothing if nearer is None else nearer
        if beyond is not None:
            journals[:, 4:] += beyond.trail(-share * start).lead.reshape(-1, 4)
            of_end = of_start = of_end + at_start * (of_start - of_end)
            of_end[:, 4:] += beyond.compliance(share).reshape(of_end[:, 4:].shape)
        wrench = np.empty_like(offset)
        solved = end_wrenches(self._law, offset, journals, of_start, of_end, at_start, self._matrix, wrench)
        if nearer is None:
            maps.add_end(wrench, end)
        else:
            sooner = nearer * wrench
            maps.add_start(sooner, end)
            maps.add_end(wrench - sooner, end)
        if not (solved and math.isfinite(np.dot(end, end))):
            raise NoFiniteResult(
                "rotor: the step has no finite result; check F0, K and C of the bearings, or halve the step"
            )
        return end, nearer, None if beyond is None else beyond.trail(share * (wrench - start))

    def _reacting(self, offset: Array, journals: Array) -> Array:
        """Wrenches under the law: an offset less what stiffness and damping take off it."""
        wrench = np.empty_like(offset)
        react(self._law, offset, journals.reshape(-1, 8), wrench)
        return wrench


def journal_motion(
    coordinates: Coordinates, motion: Array, static: Equilibrium[np.float64], trail: Trail | None = None
) -> Array:
    """Journal displacements and velocities (q, v) of a motion about an equilibrium, (n_b, 8)."""
    y = coordinates.journals(motion).reshape(-1, 8)
    y[:, :4] += static.journals.reshape(-1, 4)
    if trail is not None:
        y[:, 4:] += trail.lead.reshape(-1, 4)
    return y
