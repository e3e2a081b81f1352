"""Linear response of the shaft on linearised bearings: unbalance at a speed, and weight."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla
from numpy.typing import ArrayLike, NDArray

from rotor_fmu.linear.whirl import Bearings, relative_motion, system_matrices
from rotor_fmu.reduction.reduce import ReducedShaft
from rotor_fmu.shaft.matrices import ShaftModel

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class HarmonicResponse:
    """Phasors of a steady response, displacement = Re(phasor exp(i speed t)).

    Attributes
    ----------
    speed : float
        [rad/s].
    shape : ndarray, (n,)
        Displacements of the unreduced shaft [m], [rad].
    wrench : ndarray, (n_b, 4)
        Wrenches of the bearings on the shaft [N], [N m].
    """

    speed: float
    shape: Complex
    wrench: Complex


def unbalance_response(
    shaft: ShaftModel | ReducedShaft, speed: float, bearings: Bearings, unbalance: ArrayLike
) -> HarmonicResponse:
    """Steady response to unbalance.

    Parameters
    ----------
    shaft : ShaftModel or ReducedShaft
        The shaft.
    speed : float
        [rad/s].
    bearings : Bearings
        Linearised bearings.
    unbalance : array_like of complex, (n_w,)
        U exp(i phase) of each wheel [kg m].
    """
    mass, damping, stiffness = system_matrices(shaft, speed, bearings)
    dynamic = stiffness - speed**2 * mass + 1j * speed * damping
    rotating = np.asarray(unbalance, dtype=np.complex128)[:, None] * np.array([1.0, -1j])
    load = np.zeros(len(mass.indptr) - 1, dtype=np.complex128)
    load[: shaft.M.shape[0]] = wheel_map(shaft).T @ (speed**2 * rotating.ravel())
    x = sla.spsolve(sp.csc_array(dynamic), load)
    law = bearings.stiffness + 1j * speed * bearings.damping
    return HarmonicResponse(speed, _full(shaft, x), _wrench(shaft, x, law))


def unbalance_responses(
    shaft: ShaftModel | ReducedShaft, speeds: ArrayLike, bearings: Bearings, unbalance: ArrayLike
) -> list[HarmonicResponse]:
    """`unbalance_response` over speed, with the same bearings at all speeds."""
    return [
        unbalance_response(shaft, speed, bearings, unbalance)
        for speed in np.asarray(speeds, dtype=np.float64)
    ]


def static_response(
    shaft: ShaftModel | ReducedShaft, bearings: Bearings, gravity: float = 9.80665
) -> tuple[Array, Array]:
    """Shape and bearing wrenches of the shaft under its weight on bearings in a straight line.

    Parameters
    ----------
    shaft : ShaftModel or ReducedShaft
        The shaft.
    bearings : Bearings
        Linearised bearings; their stiffness holds the shaft.
    gravity : float
        g [m/s2].  A foundation is aligned under the weight, so that the housings stay.

    Returns
    -------
    shape, wrench : ndarray, (n,), (n_b, 4)
        [m], [rad]; [N], [N m].
    """
    _, _, stiffness = system_matrices(replace(shaft, foundation=None), 0.0, bearings)
    x = sla.spsolve(stiffness, gravity * shaft.gravity)
    return _full(shaft, x), _wrench(shaft, x, bearings.stiffness)


def wheel_map(shaft: ShaftModel | ReducedShaft) -> sp.csr_array:
    """Displacements (x, y) of the wheels from the shaft's coordinates, (2 n_w, n)."""
    if isinstance(shaft, ReducedShaft):
        return sp.csr_array(shaft.wheels)
    return sp.csr_array(sp.eye_array(shaft.size, format="csr")[shaft.wheel_dofs.ravel()])


def _full(shaft: ShaftModel | ReducedShaft, x: NDArray) -> NDArray:
    own = x[: shaft.M.shape[0]]
    return shaft.T @ own if isinstance(shaft, ReducedShaft) else own


def _wrench(shaft: ShaftModel | ReducedShaft, x: NDArray, law: NDArray) -> NDArray:
    return -np.einsum("bij,bj->bi", law, relative_motion(shaft, x))
