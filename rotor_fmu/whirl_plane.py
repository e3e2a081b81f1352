"""Both bending planes of a circular shaft as one complex plane.

With r = x + i y the gyroscopic coupling of the planes is a factor i, and every map over a step
is complex linear in the state r, the slopes s = tilt_y - i tilt_x, the forces Fx + i Fy and the
moments My - i Mx.  Its matrix has half the numbers of the real one: a macro step is bound by
reading it from memory.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_ALIKE = 1e-12
"""Relative difference up to which what the two planes hold counts as the same: rounding."""

_WRENCH = np.array([0, 1, 3, 2])
_WRENCH_SIGN = np.array([1.0, 1.0, 1.0, -1.0])
"""(Fx, Fy, Mx, My) as real and imaginary parts of force and moment."""

_JOURNAL = np.array([0, 1, 5, 4, 2, 3, 7, 6])
_JOURNAL_SIGN = np.array([1.0, 1.0, -1.0, 1.0, 1.0, 1.0, -1.0, 1.0])
"""(x, y, tilt_x, tilt_y) and rates from deflection and slope, each in (p_x, p_y, p_x', p_y')."""


@dataclass(frozen=True, eq=False)
class WhirlMaps:
    """Maps over a step as `rotor_fmu.state_space.StepMaps` has them, in the complex plane.

    Attributes
    ----------
    free : ndarray of complex, (m, m + 2 n_b + 2 h)
        End state from state, wrenches w0, and the real cos and sin of each harmonic input.
    wrench_end : ndarray of complex, (m, 2 n_b)
        End state from the wrenches w1 at the end.
    """

    free: Complex
    wrench_end: Complex


def whirl_maps(free: Array, wrench_end: Array) -> WhirlMaps | None:
    """The maps in the complex plane, or None if the two planes of the shaft are not alike.

    Parameters
    ----------
    free, wrench_end : ndarray
        As in `rotor_fmu.state_space.StepMaps`, coordinates of the x-z plane first.
    """
    states, loads = wrench_end.shape
    if states % 4 or loads % 4:
        return None
    moved = _complex_columns(free[:, :states].reshape(states, 2, 2, -1).transpose(0, 1, 3, 2))
    forced = _complex_columns(_by_force_and_moment(free[:, states : states + loads]))
    held = _complex_columns(_by_force_and_moment(wrench_end))
    if moved is None or forced is None or held is None:
        return None
    turned = _complex_rows(free[:, states + loads :])
    return WhirlMaps(np.hstack([moved, forced, turned]), held)


class WhirlPlane:
    """Takes a step of a shaft in the complex plane; owns the memory it needs.

    Parameters
    ----------
    bearing : ndarray, (4 n_b, m)
        Of the `rotor_fmu.modal_shaft.ModalShaft`.
    harmonics : int
        Harmonic inputs h.
    """

    def __init__(self, bearing: Array, harmonics: int) -> None:
        count, size = len(bearing) // 4, bearing.shape[1]
        self._plane = np.ascontiguousarray(bearing.reshape(count, 4, size)[:, [0, 3], : size // 2])
        self._plane = self._plane.reshape(2 * count, size // 2)
        self._entry = np.zeros(size + 2 * count + 2 * harmonics, dtype=np.complex128)
        parts = self._entry.view(np.float64).reshape(-1, 2)
        self._state = parts[:size].reshape(2, size // 2, 2).transpose(0, 2, 1)
        self._force = parts[size : size + 2 * count].reshape(count, 4)
        self._rotation = parts[size + 2 * count :, 0]
        self._wrench = np.zeros(2 * count, dtype=np.complex128)
        self._held = self._wrench.view(np.float64).reshape(count, 4)
        self._end = np.zeros(size, dtype=np.complex128)
        self._moved = self._end.view(np.float64).reshape(2, size // 2, 2).transpose(0, 2, 1)

    def free(
        self, maps: WhirlMaps, state: Array, wrench: Array, rotation: tuple[float, ...], out: Array
    ) -> None:
        """State at the end without wrenches there, (2 m,)."""
        self._state[:] = state.reshape(2, 2, -1)
        _as_complex(wrench, self._force)
        self._rotation[:] = rotation
        np.dot(maps.free, self._entry, out=self._end)
        out.reshape(2, 2, -1)[:] = self._moved

    def add_end(self, maps: WhirlMaps, wrench: Array, out: Array) -> None:
        """Add what the wrenches at the end move."""
        _as_complex(wrench, self._held)
        np.dot(maps.wrench_end, self._wrench, out=self._end)
        out.reshape(2, 2, -1)[:] += self._moved

    def journals(self, state: Array) -> Array:
        """Displacements and velocities (q, v) of the journals, (8 n_b,)."""
        parts = (self._plane @ state.reshape(4, -1).T).reshape(-1, 8)
        return (parts[:, _JOURNAL] * _JOURNAL_SIGN).reshape(-1)


def alike(bearing: Array) -> bool:
    """Whether the journals move in both planes in the same way, coordinates of the x-z plane first."""
    rows = bearing.reshape(len(bearing) // 4, 4, -1)
    half, odd = divmod(rows.shape[2], 2)
    if odd:
        return False
    mixed = (rows[:, [0, 3], half:], rows[:, [1, 2], :half])
    return not any(np.any(part) for part in mixed) and bool(
        np.allclose(rows[:, [0, 3], :half], rows[:, [1, 2], half:] * [[1.0], [-1.0]], _ALIKE, 0.0)
    )


def _as_complex(wrench: Array, out: Array) -> None:
    np.multiply(wrench.reshape(-1, 4)[:, _WRENCH], _WRENCH_SIGN, out=out)


def _by_force_and_moment(columns: Array) -> Array:
    """Columns (Fx, Fy, Mx, My) of each bearing, (rows, n_b, 4), as (rows, n_b, 2, 2): planes last."""
    split = columns.reshape(len(columns), -1, 4)[:, :, _WRENCH] * _WRENCH_SIGN
    return split.reshape(len(columns), -1, 2, 2)


def _complex_columns(columns: Array) -> Complex | None:
    """Of columns for the real and the imaginary part of an input, last axis, if they are complex linear."""
    real, imaginary = (_complex_rows(columns[..., k].reshape(len(columns), -1)) for k in (0, 1))
    if np.abs(imaginary - 1j * real).max(initial=0.0) > _ALIKE * np.abs(real).max(initial=0.0):
        return None
    return real


def _complex_rows(columns: Array) -> Complex:
    """Rows of both planes, (2 m, k), as one complex plane, (m, k)."""
    rows = columns.reshape(2, 2, -1, columns.shape[1])
    return np.ascontiguousarray((rows[:, 0] + 1j * rows[:, 1]).reshape(-1, columns.shape[1]))
