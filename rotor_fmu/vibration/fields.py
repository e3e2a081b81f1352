"""Fields over the nodes of the unreduced shaft, and where they are largest."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.shaft.condensation import Equilibrium
from rotor_fmu.shaft.stress import BendingStress
from rotor_fmu.vibration.modal_shaft import ModalShaft

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class NodeFields:
    """Values at the N nodes of the shaft.

    Attributes
    ----------
    x, y : ndarray, (N,)
        Displacements, static sag included [m].
    amplitude : ndarray, (N,)
        Vibration amplitude: radius of the displacement from the static line [m].
    stress : ndarray, (N,)
        Largest normal stress at the surface from static and dynamic bending in both planes [Pa].
    """

    x: Array
    y: Array
    amplitude: Array
    stress: Array


class Extremes(NamedTuple):
    """Largest vibration amplitude [m] and normal stress [Pa] of all nodes, and their positions [m]."""

    amplitude: float
    amplitude_z: float
    stress: float
    stress_z: float


class _Instant(NamedTuple):
    """Dynamic deflections (N,) in both planes, their square, and squares of stress at both sides of nodes."""

    x: Array
    y: Array
    deflection: Array
    stress: Array


class FieldMap:
    """From modal displacements to fields; the rows of deflection and bending moments in one matrix a plane.

    What was computed last is kept: fields and extremes of one instant read the matrices, which are larger
    than a processor's nearest memory, once.

    Parameters
    ----------
    shaft : ModalShaft
        The reduced shaft.
    bending : BendingStress
        Bending moments of the unreduced shaft.
    z : ndarray, (N,)
        Positions of the nodes [m].
    gravity : float
        [m/s2].
    """

    def __init__(self, shaft: ModalShaft, bending: BendingStress, z: Array, gravity: float) -> None:
        self._z, self._gravity, self._bending = z, gravity, bending
        nodes = self._nodes = len(z)
        moments = np.asarray(bending.operator @ shaft.T)
        self._planes = []
        for deflection, rows in (
            (shaft.T[0::4], moments[: 2 * nodes]),
            (shaft.T[1::4], moments[2 * nodes :]),
        ):
            full = np.vstack([deflection, rows])
            used = np.flatnonzero(np.any(full != 0.0, axis=0))
            # A bending plane sees its own modes only, which are neighbours.
            columns = slice(int(used[0]), int(used[-1]) + 1) if len(used) else slice(0, 0)
            self._planes.append((columns, np.ascontiguousarray(full[:, columns])))
        (columns_x, of_x), (columns_y, of_y) = self._planes
        follows = columns_x.start == 0 and columns_y == slice(columns_x.stop, 2 * columns_x.stop)
        # Of a circular shaft both planes are the same matrix, which is then read once for both.
        self._common = of_x if follows and np.array_equal(of_x, of_y) else None
        self._flexibility = (1.0 / bending.modulus).ravel()
        self._static: Equilibrium[np.float64] | None = None
        self._static_moments = np.zeros((2, 2 * nodes))
        self._last: tuple[Array, Equilibrium[np.float64], _Instant] | None = None

    def fields(self, state: Array, static: Equilibrium[np.float64]) -> NodeFields:
        """All fields of a modal state (p, p'), (2 m,), about an equilibrium; neither changes in place."""
        now = self._instant(state, static)
        return NodeFields(
            x=static.shape[0::4] + now.x,
            y=static.shape[1::4] + now.y,
            amplitude=np.sqrt(now.deflection),
            stress=np.sqrt(now.stress.reshape(2, -1).max(axis=0)),
        )

    def extremes(self, state: Array, static: Equilibrium[np.float64]) -> Extremes:
        """Largest amplitude and stress alone, of what `fields` takes."""
        now = self._instant(state, static)
        k, s = int(now.deflection.argmax()), int(now.stress.argmax())
        return Extremes(
            math.sqrt(now.deflection[k]),
            float(self._z[k]),
            math.sqrt(now.stress[s]),
            float(self._z[s % self._nodes]),
        )

    def _instant(self, state: Array, static: Equilibrium[np.float64]) -> _Instant:
        if self._last is not None and self._last[0] is state and self._last[1] is static:
            return self._last[2]
        x, y, moment_x, moment_y = self._apply(state, static)
        # Squares, for hypot is slow; moments are far from overflow.
        stress = moment_x * moment_x + moment_y * moment_y
        stress *= self._flexibility
        stress *= self._flexibility
        self._last = state, static, _Instant(x, y, x * x + y * y, stress)
        return self._last[2]

    def _apply(self, state: Array, static: Equilibrium[np.float64]) -> tuple[Array, Array, Array, Array]:
        """Dynamic deflections (N,) and total bending moments (2 N,) in both planes."""
        if static is not self._static:
            moments = self._bending.moments(static.shape, self._gravity)
            self._static, self._static_moments = static, moments.reshape(2, -1)
        if self._common is not None:
            in_x, in_y = state[: 2 * self._common.shape[1]].reshape(2, -1) @ self._common.T
        else:
            in_x, in_y = (plane @ state[columns] for columns, plane in self._planes)
        n = self._nodes
        in_x[n:] += self._static_moments[0]
        in_y[n:] += self._static_moments[1]
        return in_x[:n], in_y[:n], in_x[n:], in_y[n:]
