"""Reduction of the shaft by a Ritz basis: Guyan, iterated IRS, Craig-Bampton, or none.

A rotor of circular sections is reduced in one plane and the basis used in both.
The gyroscopic matrix is left out of the basis (it is projected by it).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
import scipy.linalg as sl
from numpy.typing import NDArray

from rotor_fmu.assembly import ShaftModel, plane_x, plane_y
from rotor_fmu.ritz import Basis, craig_bampton, guyan, improved_reduced_system

Array = NDArray[np.float64]
Method = Literal["irs", "guyan", "craig-bampton", "none"]
METHODS: tuple[str, ...] = get_args(Method)

DEFAULT_SIZE = 120
"""Reduced degrees of freedom, both planes."""


@dataclass(frozen=True, eq=False)
class ReducedShaft:
    """M x'' + (D + Ω G) x' + K x = f in m reduced coordinates.

    The first m/2 coordinates belong to the x-z plane, the others to the y-z plane.

    Attributes
    ----------
    M, D, G, K : ndarray, (m, m)
        Reduced matrices.
    T : ndarray, (n, m)
        Recovery: full displacement = T @ x.
    bearing : ndarray, (4 n_b, m)
        x, y, tilt_x, tilt_y of the bearings' nodes, bearing by bearing; wrenches enter as ``bearing.T @ w``.
    wheels : ndarray, (2 n_w, m)
        x, y of the wheels' nodes; forces enter as ``wheels.T @ f``.
    gravity : ndarray, (m,)
        Gravity load per unit of g.
    method : str
        The reduction.
    history : tuple of tuple of float
        For IRS the natural frequencies [rad/s] of the elastic modes of one plane after each iteration,
        the first entry being Guyan's; else empty.
    """

    M: Array
    D: Array
    G: Array
    K: Array
    T: Array
    bearing: Array
    wheels: Array
    gravity: Array
    method: str
    history: tuple[tuple[float, ...], ...] = ()

    @property
    def size(self) -> int:
        """Number m of reduced coordinates."""
        return len(self.M)


def reduce(
    model: ShaftModel,
    method: Method = "irs",
    *,
    masters: NDArray[np.intp] | None = None,
    size: int = DEFAULT_SIZE,
    tolerance: float = 1e-8,
    max_iterations: int = 200,
) -> ReducedShaft:
    """Reduce the shaft.

    Parameters
    ----------
    model : ShaftModel
        The unreduced shaft.
    method : {"irs", "guyan", "craig-bampton", "none"}
        The reduction.
    masters : ndarray of int, optional
        Degrees of freedom of one plane, 2 k for the deflection and 2 k + 1 for the slope of node k, that
        are kept; for Craig-Bampton the interface.  Default: `default_masters`, `default_interface`.
    size : int
        Reduced degrees of freedom in both planes together, for the default masters and for Craig-Bampton.
    tolerance, max_iterations : float, int
        IRS: see `improved_reduced_system`.

    Returns
    -------
    ReducedShaft
        The reduced shaft.

    Raises
    ------
    ValueError
        If the method is unknown or the masters leave a rigid-body motion free.
    ReductionError
        If IRS does not converge within `max_iterations`.
    """
    mass, stiffness = model.plane_mass, model.plane_stiffness
    half = min(size // 2, len(mass))
    if method == "none":
        basis = Basis(np.eye(len(mass)))
    elif method == "craig-bampton":
        interface = default_interface(model) if masters is None else masters
        basis = craig_bampton(mass, stiffness, interface, modes=max(half - len(interface), 0))
    elif method in ("guyan", "irs"):
        kept = default_masters(model, half) if masters is None else masters
        if method == "guyan":
            basis = guyan(mass, stiffness, kept)
        else:
            basis = improved_reduced_system(
                mass, stiffness, kept, tolerance=tolerance, max_iterations=max_iterations
            )
    else:
        raise ValueError(f"reduction {method!r} is unknown; allowed are {', '.join(METHODS)}")
    return project(model, basis, method)


def project(model: ShaftModel, basis: Basis, method: str) -> ReducedShaft:
    """Galerkin projection of the shaft on a basis of one plane, used in both.

    Parameters
    ----------
    model : ShaftModel
        The unreduced shaft.
    basis : Basis
        Columns in the plane's (deflection, slope) a node.
    method : str
        Name to record.
    """
    V = basis.vectors
    mass, stiffness, polar = (
        V.T @ A @ V for A in (model.plane_mass, model.plane_stiffness, model.plane_polar)
    )
    M, K = (sl.block_diag(A, A) for A in (_symmetric(mass), _symmetric(stiffness)))
    polar, zero = _symmetric(polar), np.zeros_like(polar)
    alpha, beta = model.rayleigh
    T = np.hstack([plane_x(model.nodes) @ V, plane_y(model.nodes) @ V])
    return ReducedShaft(
        M=M,
        D=alpha * M + beta * K,
        G=np.block([[zero, polar], [-polar, zero]]),
        K=K,
        T=T,
        bearing=T[model.bearing_dofs.ravel()],
        wheels=T[model.wheel_dofs.ravel()],
        gravity=T.T @ model.gravity,
        method=method,
        history=basis.history,
    )


def default_interface(model: ShaftModel) -> NDArray[np.intp]:
    """Deflection and slope at the bearings, in one plane."""
    nodes = model.bearing_dofs[:, 0] // 4
    return np.unique(np.concatenate([2 * nodes, 2 * nodes + 1]))


def default_masters(model: ShaftModel, count: int) -> NDArray[np.intp]:
    """Deflection and slope at the bearings, deflection at wheels and ends, then where the gaps are largest.

    Parameters
    ----------
    model : ShaftModel
        The unreduced shaft.
    count : int
        Degrees of freedom wanted in one plane; more are returned if bearings, wheels and ends are more.

    Returns
    -------
    ndarray of int
        Ascending degrees of freedom of one plane.
    """
    chosen = {int(d) for d in default_interface(model)}
    chosen |= {int(d) // 2 for d in model.wheel_dofs[:, 0]} | {0, 2 * model.nodes - 2}
    while len(chosen) < count:
        occupied = np.array(sorted({d // 2 for d in chosen}))
        distance = np.abs(model.z[:, None] - model.z[occupied]).min(axis=1)
        if distance.max() == 0.0:
            chosen |= {2 * k + 1 for k in range(model.nodes)}
            break
        chosen.add(2 * int(distance.argmax()))
    return np.array(sorted(chosen), dtype=np.intp)


def _symmetric(matrix: Array) -> Array:
    return (matrix + matrix.T) / 2.0
