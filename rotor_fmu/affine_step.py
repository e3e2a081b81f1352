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
from rotor_fmu.modal_shaft import ModalShaft
from rotor_fmu.state_space import StepMaps, journal_output
from rotor_fmu.whirl_plane import WhirlPlane, alike

Array = NDArray[np.float64]

HARMONICS = 2
"""Harmonic inputs of a step: the nominal unbalance and the lost blade's."""


class StepFailure(ArithmeticError):
    """The step has no finite result; the state before it stands."""


class AffineStep:
    """Takes macro steps; owns the memory they need.

    Parameters
    ----------
    shaft : ModalShaft
        The shaft.
    """

    def __init__(self, shaft: ModalShaft) -> None:
        states, loads, n_b = 2 * shaft.size, len(shaft.bearing), shaft.bearings
        self._output = journal_output(shaft)
        # Views share memory: what is written to one is read as the other.
        self._entry = np.zeros(states + loads + 2 * HARMONICS)
        self._start, self._wrench, self._rotation = np.split(self._entry, [states, states + loads])
        self._law = np.zeros((n_b, 4, 8))
        self._matrix = np.zeros((n_b, 4, loads))
        self._square = self._matrix.reshape(loads, loads)
        self._diagonal = self._square.reshape(-1)[:: loads + 1]
        self._plane = WhirlPlane(shaft.bearing, HARMONICS) if alike(shaft.bearing) else None
        self._reaction = np.zeros((n_b, 4, 1))

    def journals(self, state: Array, static: Equilibrium[np.float64]) -> Array:
        """Journal displacements and velocities (q, v) at a state, (n_b, 8)."""
        moved = self._output @ state if self._plane is None else self._plane.journals(state)
        y = moved.reshape(-1, 8)
        y[:, :4] += static.journals.reshape(-1, 4)
        return y

    def set_law(self, K: Array, C: Array) -> None:
        """Take stiffness and damping of the bearings, (n_b, 4, 4) each, for the steps to come."""
        self._law[:, :, :4] = K
        self._law[:, :, 4:] = C

    def wrench(self, F0: Array, journals: Array, static: Equilibrium[np.float64]) -> Array:
        """Wrenches of the law last set, counted from those of the static equilibrium, (4 n_b,)."""
        return F0.reshape(-1) - static.wrench - self._react(journals)

    def advance(
        self,
        maps: StepMaps,
        state: Array,
        journals: Array,
        F0: Array,
        rotation: tuple[float, float, float, float],
        kick: Array | None,
        static: Equilibrium[np.float64],
        out: Array,
    ) -> None:
        """Take a step under the law last set.

        Parameters
        ----------
        maps : StepMaps
            Of this speed and step; two harmonic inputs, the nominal unbalance and the lost blade's.
        state : ndarray, (2 m,)
            x = (p, p') at the start.
        journals : ndarray, (n_b, 8)
            `journals` of that state.
        F0 : ndarray, (n_b, 4)
            Constant part of the law.
        rotation : tuple of float
            cos and sin of the angle of rotation at the start, for each harmonic input; 0 to leave one out.
        kick : ndarray, (2 m,), optional
            What a force acting during a part of the step only adds to the end state.
        static : Equilibrium
            The static equilibrium.
        out : ndarray, (2 m,)
            Receives the state at the end.

        Raises
        ------
        StepFailure
            If the law has no solution at the end of the step, or numbers are not finite.
        """
        offset = F0.reshape(-1) - static.wrench
        self._free(maps, state, offset - self._react(journals), rotation, out)
        if kick is not None:
            out += kick

        wrench = offset - self._react(self.journals(out, static))
        np.matmul(self._law, maps.compliance, out=self._matrix)
        self._diagonal += 1.0
        # The matrix is stored by rows, LAPACK reads columns: factor the transpose, solve transposed.
        factor, pivots, info = lapack.dgetrf(self._square.T, overwrite_a=1)
        if info == 0:
            wrench, info = lapack.dgetrs(factor, pivots, wrench, trans=1)
        self._add_end(maps, wrench, out)
        if info != 0 or not np.isfinite(np.dot(out, out)):
            raise StepFailure(
                "rotor: the step has no finite result; check F0, K and C of the bearings, or halve the step"
            )

    def _free(
        self,
        maps: StepMaps,
        state: Array,
        wrench: Array,
        rotation: tuple[float, float, float, float],
        out: Array,
    ) -> None:
        """The end state under the wrenches of the start, which end with the step."""
        if self._plane is not None and maps.whirl is not None:
            self._plane.free(maps.whirl, state, wrench, rotation, out)
            return
        self._start[:] = state
        self._wrench[:] = wrench
        self._rotation[:] = rotation
        np.dot(maps.free, self._entry, out=out)

    def _add_end(self, maps: StepMaps, wrench: Array, out: Array) -> None:
        if self._plane is not None and maps.whirl is not None:
            self._plane.add_end(maps.whirl, wrench, out)
        else:
            out += np.dot(maps.wrench_end, wrench)

    def _react(self, journals: Array) -> Array:
        """L y: what stiffness and damping take off F0."""
        np.matmul(self._law, journals.reshape(-1, 8, 1), out=self._reaction)
        return self._reaction.reshape(-1)
