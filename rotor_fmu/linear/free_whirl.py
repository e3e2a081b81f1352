"""Whirl of the free shaft, sorted into branches that can be followed over speed.

A free shaft of circular sections is isotropic: its modes whirl in circles.  In the complex
coordinate x + i y they are the solutions of one plane, forward with positive and backward
with negative frequency; the k-th of each direction is the same branch at every speed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike, NDArray

from rotor_fmu.linear.eigenmodes import eigenmodes
from rotor_fmu.reduction.irs import elastic_scale, irs_iterations
from rotor_fmu.reduction.masters import default_masters
from rotor_fmu.reduction.reduce import DEFAULT_SIZE, ReducedShaft, project
from rotor_fmu.reduction.ritz import Basis, partition, static_modes
from rotor_fmu.shaft.banded import lowest_modes
from rotor_fmu.shaft.matrices import ShaftModel

Array = NDArray[np.float64]
Matrices = tuple[sp.csc_array, sp.csc_array, sp.csc_array]

RIGID = 0.1
"""Share of a mode's deflection that a rigid motion leaves over, below which the mode is rigid."""

STILL = 0.1
"""Frequency below which nothing whirls [rad/s]."""

OVERDAMPED = 0.95
"""Damping ratio from which a mode does not whirl; the highest of a fine mesh, damped as K, are beyond."""


class WhirlError(RuntimeError):
    """Modes that could not be found; `found` were in each direction."""

    def __init__(self, message: str, found: int) -> None:
        super().__init__(message)
        self.found = found


@dataclass(frozen=True, eq=False)
class WhirlBranches:
    """Elastic whirl frequencies of a free shaft over S speeds.

    Attributes
    ----------
    speeds : ndarray, (S,)
        [rad/s].
    backward, forward : ndarray, (S, count)
        Damped circular frequencies [rad/s], ascending; equal at rest.
    """

    speeds: Array
    backward: Array
    forward: Array

    @property
    def both(self) -> Array:
        """Backward, then forward, (S, 2, count)."""
        return np.stack([self.backward, self.forward], axis=1)

    def error(self, exact: WhirlBranches) -> Array:
        """Relative error of each frequency, with its sign, (S, 2, count)."""
        return self.both / exact.both - 1.0


def free_branches(shaft: ShaftModel | ReducedShaft, z: Array, speeds: ArrayLike, count: int) -> WhirlBranches:
    """Lowest elastic whirl frequencies of the free shaft in each direction.

    Parameters
    ----------
    shaft : ShaftModel or ReducedShaft
        The shaft.
    z : ndarray, (N,)
        Axial positions of the unreduced shaft's nodes [m].
    speeds : array_like, (S,)
        [rad/s], not negative.
    count : int
        Bending modes of each direction.

    Raises
    ------
    WhirlError
        If the shaft has not as many.
    """
    at = np.asarray(speeds, dtype=np.float64)
    found = [_branches(shaft, np.asarray(z), float(speed), count) for speed in at]
    return WhirlBranches(
        at,
        np.array([backward for backward, _ in found]),
        np.array([forward for _, forward in found]),
    )


def irs_iterates(model: ShaftModel, last: int, *, size: int = DEFAULT_SIZE) -> Iterator[ReducedShaft]:
    """Plain IRS after 0, 1, ... `last` iterations, the first being Guyan's condensation.

    Parameters
    ----------
    model : ShaftModel
        The unreduced shaft.
    last : int
        Number of iterations.
    size : int
        Reduced degrees of freedom in both planes together.
    """
    masters = default_masters(model, min(size, 4 * model.nodes) // 2)
    bases = irs_iterations(model.plane_mass, model.stiffness_root, masters)
    return (project(model, basis, "irs-plain") for basis in islice(bases, last + 1))


def modal_truncation(model: ShaftModel, size: int = DEFAULT_SIZE) -> ReducedShaft:
    """The lowest modes of the free shaft at rest: where iterated IRS converges to.

    What it misses of a rotating shaft is the floor that leaving the gyroscopic matrix out of the
    transformation sets: no further iteration can come below.

    Parameters
    ----------
    model : ShaftModel
        The unreduced shaft.
    size : int
        Modes of both planes together, two rigid-body motions a plane included.
    """
    mass, stiffness = model.plane_mass, model.plane_stiffness
    few = static_modes(stiffness, partition(stiffness, default_masters(model, 8)))
    shift = elastic_scale(mass, model.stiffness_root, few)
    _, modes = lowest_modes(mass, stiffness, min(size // 2, 2 * model.nodes), shift)
    return project(model, Basis(modes), "modal truncation")


def _branches(shaft: ShaftModel | ReducedShaft, z: Array, speed: float, count: int) -> tuple[Array, Array]:
    """Backward and forward frequencies of one speed."""
    matrices, recovery = _plane(shaft, speed)
    available = 2 * matrices[0].shape[0]
    wanted = min(2 * count + 8, available)
    while True:
        values, vectors = eigenmodes(*matrices, wanted)
        all_found = len(values) >= available - 8
        whirling = np.abs(values.real) < OVERDAMPED * np.abs(values)
        values, vectors = values[whirling], vectors[: available // 2, whirling]
        frequency = np.sort(values[_elastic(vectors, recovery, z)].imag)
        backward, forward = -frequency[frequency < -STILL][::-1], frequency[frequency > STILL]
        if min(len(backward), len(forward)) >= count:
            return backward[:count], forward[:count]
        if all_found or wanted >= available:
            fewer = min(len(backward), len(forward))
            raise WhirlError(
                f"at {speed:.4g} rad/s only {fewer} of {count} bending modes in each direction "
                f"were found; ask for fewer, or keep more than {available} degrees of freedom",
                fewer,
            )
        wanted = min(wanted + count, available)


def _plane(shaft: ShaftModel | ReducedShaft, speed: float) -> tuple[Matrices, Array | None]:
    """Mass, damping and stiffness in x + i y, and the plane's deflections from its coordinates.

    With r = x + i y the gyroscopic terms P y' and -P x' of the two planes become -i P r'.
    """
    if isinstance(shaft, ReducedShaft):
        half = shaft.size // 2
        here = slice(0, half)
        mass, damping, stiffness = (A[here, here] for A in (shaft.M, shaft.D, shaft.K))
        polar, recovery = shaft.G[here, half:], shaft.T[0::4, here]
    else:
        mass, stiffness, polar = shaft.plane_mass, shaft.plane_stiffness, shaft.plane_polar
        damping, recovery = shaft.plane_damping, None
    turning = sp.csc_array(damping - 1j * speed * polar)
    return (sp.csc_array(mass), turning, sp.csc_array(stiffness)), recovery


def _elastic(vectors: NDArray, recovery: Array | None, z: Array) -> NDArray[np.bool_]:
    """Which modes are bending; conical precession, though bent a little by gyroscopic moments, is not."""
    deflection = vectors[0::2] if recovery is None else recovery @ vectors
    basis, _ = np.linalg.qr(np.column_stack([np.ones_like(z), z - z.mean()]))
    rest = deflection - basis @ (basis.T @ deflection)
    return np.linalg.norm(rest, axis=0) > RIGID * np.linalg.norm(deflection, axis=0)
