"""Fields over the nodes of the unreduced shaft, and where they are largest."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.shaft.condensation import Equilibrium
from rotor_fmu.shaft.stress import BendingStress
from rotor_fmu.vibration.field_loops import fields_at
from rotor_fmu.vibration.modal_shaft import ModalShaft
from rotor_fmu.vibration.whirl_plane import ALIKE

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class NodeFields:
    """Values at the N nodes of the shaft.

    Attributes
    ----------
    all : ndarray, (4, N)
        The following, one below the other.
    x, y : ndarray, (N,)
        Displacements, static sag included [m].
    amplitude : ndarray, (N,)
        Vibration amplitude: radius of the displacement from the static line [m].
    stress : ndarray, (N,)
        Largest normal stress at the surface from static and dynamic bending in both planes [Pa].
    """

    all: Array

    @property
    def x(self) -> Array:
        """Displacements in x."""
        return self.all[0]

    @property
    def y(self) -> Array:
        """Displacements in y."""
        return self.all[1]

    @property
    def amplitude(self) -> Array:
        """Vibration amplitudes."""
        return self.all[2]

    @property
    def stress(self) -> Array:
        """Largest normal stresses."""
        return self.all[3]


class Extremes(NamedTuple):
    """Largest vibration amplitude [m] and normal stress [Pa] of all nodes, and their positions [m]."""

    amplitude: float
    amplitude_z: float
    stress: float
    stress_z: float


class _Instant(NamedTuple):
    """Displacements in x and y, amplitude and stress (4, N), and where the last two are largest."""

    fields: Array
    moved: int
    bent: int


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
        (_, of_x), (columns_y, of_y) = self._planes
        if _alike(of_x, of_y, nodes):  # of a circular shaft: one matrix, which is then read once for both
            self._planes[1] = columns_y, of_x
        self._flexibility = (1.0 / bending.modulus).ravel()
        self._static: Equilibrium[np.float64] | None = None
        self._line, self._static_moments = np.zeros((2, nodes)), np.zeros((2, 2 * nodes))
        self._last: tuple[Array, Equilibrium[np.float64], _Instant] | None = None

    def fields(self, moved: Array, static: Equilibrium[np.float64]) -> NodeFields:
        """All fields of modal displacements, (m,), about an equilibrium; neither changes in place."""
        return NodeFields(self._instant(moved, static).fields)

    def extremes(self, moved: Array, static: Equilibrium[np.float64]) -> Extremes:
        """Largest amplitude and stress, and where."""
        fields, k, s = self._instant(moved, static)
        return Extremes(float(fields[2, k]), float(self._z[k]), float(fields[3, s]), float(self._z[s]))

    def _instant(self, moved: Array, static: Equilibrium[np.float64]) -> _Instant:
        if self._last is not None and self._last[0] is moved and self._last[1] is static:
            return self._last[2]
        if static is not self._static:
            moments = self._bending.moments(static.shape, self._gravity)
            self._static, self._static_moments = static, np.ascontiguousarray(moments.reshape(2, -1))
            self._line = np.stack([static.shape[0::4], static.shape[1::4]])
        fields = np.empty((4, self._nodes))
        (columns_x, of_x), (columns_y, of_y) = self._planes
        about = self._line, self._static_moments, self._flexibility
        largest = fields_at(of_x, of_y, moved[columns_x], moved[columns_y], *about, fields)
        self._last = moved, static, _Instant(fields, *largest)
        return self._last[2]


def _alike(one: Array, other: Array, nodes: int) -> bool:
    """Whether rows of deflection, as many as nodes, and of moments are the same but for rounding."""
    if one.shape != other.shape:
        return False
    parts = ((part[:nodes], part[nodes:]) for part in (one, other))
    return all(
        np.abs(a - b).max(initial=0.0) <= ALIKE * np.abs(a).max(initial=0.0)
        for a, b in zip(*parts, strict=True)
    )
