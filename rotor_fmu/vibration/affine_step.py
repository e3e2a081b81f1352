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
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.shaft.condensation import Equilibrium
from rotor_fmu.vibration.coordinates import Coordinates, Maps
from rotor_fmu.vibration.law_loops import begin, end_wrenches, factorise, mix, react
from rotor_fmu.vibration.trail import Extrapolation, Trail
from rotor_fmu.vibration.whirl_coordinates import WhirlMaps
from rotor_fmu.vibration.whirl_loops import MIXED, UNSOLVED
from rotor_fmu.vibration.whirl_loops import step as whirl_step

Array = NDArray[np.float64]


_NOT_FINITE = "rotor: the step has no finite result; check F0, K and C of the bearings, or halve the step"


class NoFiniteResult(ArithmeticError):
    """The step has no finite result; the state before it stands."""


class Step(NamedTuple):
    """A step that was taken.

    Attributes
    ----------
    motion : ndarray, (2 m,)
        At its end.
    journals : ndarray, (n_b, 8)
        Their motion there.
    nearer : ndarray, (4 n_b,), or None
        c / 2 of each wrench component, for `AffineStep.held`; None where all ran linearly.
    trail : Trail or None
        Of the extrapolation, if there is one.
    """

    motion: Array
    journals: Array
    nearer: Array | None
    trail: Trail | None


class AffineStep:
    """Takes macro steps in any coordinates; owns the memory that the law needs.

    Parameters
    ----------
    bearings : int
        Number n_b of bearings.
    """

    def __init__(self, bearings: int) -> None:
        loads = 4 * bearings
        self._law, self._offset = np.zeros((bearings, 4, 8)), np.zeros((bearings, 4))
        self._matrix, self._sizes = np.zeros((loads, loads)), np.zeros((bearings + 1, bearings))
        self._start, self._end, self._nearer = np.zeros(loads), np.zeros(loads), np.zeros(loads)
        self._moves = np.zeros((bearings, 8, loads))
        self._pivots = np.zeros(loads, dtype=np.intp)
        wrenches = self._sizes, self._start, self._end, self._nearer, self._moves
        self._of_whirl: tuple[Any, ...] = (
            self._law,
            self._matrix,
            self._pivots,
            *wrenches,
            self._offset.reshape(-1),
        )

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
    ) -> Step:
        """Take a step under the law last set.

        Parameters
        ----------
        coordinates, maps : Coordinates, Maps
            Of this speed and step; two harmonic inputs, the nominal unbalance and the lost blade's.
        motion : ndarray, (2 m,)
            At the start, in these coordinates.
        journals : ndarray, (n_b, 8)
            Their motion at the start.
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
        Step
            What it leads to.

        Raises
        ------
        NoFiniteResult
            If the law has no solution at the end of the step, or numbers are not finite.
        """
        if isinstance(maps, WhirlMaps) and beyond is None:  # in one compiled loop
            return self.advance_whirl(maps, motion, journals, F0, rotation[None], static, kick)
        np.subtract(F0, static.bearing_wrenches, out=self._offset)
        offset = self._offset.reshape(-1)
        matrix, start, compliance = self._matrix, self._start, maps.compliance
        own = compliance.own, compliance.mixed
        mixes = begin(self._law, offset, journals, *own, matrix, self._sizes, start, self._nearer)
        moves, share = compliance.end, np.ones(1)
        if not mixes:
            end = maps.coast(motion, start, rotation)
        else:
            nearer = self._nearer
            moves, share = self._moves, 1.0 - 2.0 * nearer
            mix(compliance.start, compliance.end, nearer, moves)
            later = nearer * start
            end = maps.coast(motion, start - later, rotation)
            maps.add_end(later, end)
        if kick is not None:
            end += kick
        journals = journal_motion(coordinates, end, static)
        if beyond is not None:
            journals[:, 4:] += beyond.trail(-share * start).lead.reshape(-1, 4)
            moves = moves.copy()
            moves[:, 4:] += beyond.compliance(share).reshape(moves[:, 4:].shape)
        wrench = self._end
        solved = factorise(self._law, moves, matrix, self._pivots)
        end_wrenches(self._law, offset, moves, matrix, self._pivots, journals, wrench)
        if not mixes:
            maps.add_end(wrench, end)
        else:
            sooner = nearer * wrench
            maps.add_start(sooner, end)
            maps.add_end(wrench - sooner, end)
        if not (solved and math.isfinite(np.dot(end, end))):
            raise NoFiniteResult(_NOT_FINITE)
        trail = None if beyond is None else beyond.trail(share * (wrench - start))
        return Step(end, journals, nearer.copy() if mixes else None, trail)

    def advance_whirl(
        self,
        maps: WhirlMaps,
        motion: Array,
        journals: Array,
        F0: Array,
        rotations: Array,
        static: Equilibrium[np.float64],
        kick: Array | None = None,
    ) -> Step:
        """Take steps of one length under the law last set, in one go; 1 + L S is solved for all at once.

        Parameters
        ----------
        rotations : ndarray, (steps, 4)
            Of each, otherwise as `advance` takes it.
        kick : ndarray, (2 m,), optional
            Added at the end of the last.
        others
            As `advance` takes them.

        Returns
        -------
        Step
            What all lead to.

        Raises
        ------
        NoFiniteResult
            As `advance`.
        """
        np.subtract(F0, static.bearing_wrenches, out=self._offset)
        kick = maps.no_kick if kick is None else kick
        end, where = np.empty(motion.shape), np.empty(journals.shape)
        about = static.journals_at_rest, rotations, kick, motion, journals, end, where
        given: tuple[Any, ...] = *maps.of_step, *self._of_whirl, *about
        done = whirl_step(*given)
        if done == UNSOLVED:
            raise NoFiniteResult(_NOT_FINITE)
        return Step(end, where, self._nearer.copy() if done == MIXED else None, None)

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
    y += static.journals_at_rest
    if trail is not None:
        y[:, 4:] += trail.lead.reshape(-1, 4)
    return y
