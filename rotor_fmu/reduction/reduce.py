"""Reduction of the shaft by a Ritz basis: IRS, Guyan, Craig-Bampton, or none.

A rotor of circular sections is reduced in one plane and the basis used in both.
The gyroscopic matrix is left out of the basis (it is projected by it).

`irs-plain` is iterated IRS alone.  It converges to free-free modal truncation:
free-free frequencies are near exact, but the static flexibility at the bearings suffers.
`irs`, the default, complements its lowest modes by static and gyroscopic ones, at equal size.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np
import scipy.linalg as sl
from numpy.typing import NDArray

from rotor_fmu.foundation.foundation import Foundation
from rotor_fmu.reduction.irs import ReductionError, complemented, improved_reduced_system
from rotor_fmu.reduction.masters import default_interface, default_masters
from rotor_fmu.reduction.ritz import Basis, craig_bampton, guyan, symmetric
from rotor_fmu.shaft.matrices import ShaftModel, plane_x, plane_y

Array = NDArray[np.float64]
Method = Literal["irs", "irs-plain", "guyan", "craig-bampton", "none"]
METHODS: tuple[str, ...] = get_args(Method)

DEFAULT_SIZE = 220
"""Reduced degrees of freedom, both planes."""

IRS_MODES = 16
"""Elastic modes of one plane by whose frequencies IRS is judged."""

COMPLEMENT_MODES = 66
"""Elastic modes of one plane, from IRS, that complement the static ones.

At equal size they take the place of static masters.  Frequencies and unbalance response would do with 16, but
a fracture with solid contact rings modes far above; with 66 the forces of every bearing of the turbine after
it keep within 2 % of the unreduced shaft's (``python -m tests.benchmarks.reductions``).
"""

COMPLEMENT_SHARE = 0.6
"""Largest share of all reduced degrees of freedom that these modes take."""

GYROSCOPIC_MODES = 12
"""How many of these, from the lowest, bring their response to gyroscopic moments."""


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
        The reduction that was carried out.
    reason : str
        One line: why another one than was asked for; empty if it is the one asked for.
    history : tuple of tuple of float
        For IRS the natural frequencies [rad/s] of the elastic modes of one plane after each iteration,
        the first entry being Guyan's; else empty.
    foundation : Foundation or None
        What the bearings stand on, where that moves; it is not reduced.
    trace : ndarray, (n,), or None
        Of the unreduced shaft, see `ShaftModel`.
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
    reason: str = ""
    history: tuple[tuple[float, ...], ...] = ()
    foundation: Foundation | None = None
    trace: Array | None = None

    @property
    def size(self) -> int:
        """Number m of reduced coordinates."""
        return len(self.M)

    @property
    def carried_out(self) -> str:
        """The reduction in a line, with the reason where it is another one than was asked for."""
        return f"{self.method}; {self.reason}" if self.reason else self.method


def reduce(
    model: ShaftModel,
    method: Method = "irs",
    *,
    masters: NDArray[np.intp] | None = None,
    size: int = DEFAULT_SIZE,
    tolerance: float = 1e-7,
    max_iterations: int = 100,
) -> ReducedShaft:
    """Reduce the shaft.

    Parameters
    ----------
    model : ShaftModel
        The unreduced shaft.
    method : {"irs", "irs-plain", "guyan", "craig-bampton", "none"}
        The reduction.
    masters : ndarray of int, optional
        Degrees of freedom of one plane, 2 k for the deflection and 2 k + 1 for the slope of node k, that
        are kept; for Craig-Bampton the interface.  Default: `default_masters`, `default_interface`.
    size : int
        Reduced degrees of freedom in both planes together, where `masters` does not decide; a little more
        if bearings and ends alone ask for it.
    tolerance, max_iterations : float, int
        IRS: see `improved_reduced_system`.

    Returns
    -------
    ReducedShaft
        The reduced shaft.  Its `method` is another one than asked for, with a `reason`, in two cases: none
        where the shaft has no more degrees of freedom than are to be kept, Craig-Bampton where IRS does not
        converge within `max_iterations`.

    Raises
    ------
    ValueError
        If the method is unknown or the masters leave a rigid-body motion free.
    """
    if method not in METHODS:
        raise ValueError(f"reduction {method!r} is unknown; allowed are {', '.join(METHODS)}")
    full = 2 * model.nodes
    half = min(size // 2, full)
    if method == "none":
        return _unreduced(model)
    if masters is None and half == full:
        return _unreduced(model, f"the shaft has {model.size} degrees of freedom, {size} may be kept")
    try:
        basis = _basis(model, method, masters, half, tolerance, max_iterations)
    except ReductionError as error:
        basis = _basis(model, "craig-bampton", None, half, tolerance, max_iterations)
        return replace(project(model, basis, "craig-bampton"), reason=str(error))
    if basis.vectors.shape[1] >= full:
        return _unreduced(model, f"{method} would keep all {model.size} degrees of freedom of the shaft")
    return project(model, basis, method)


def _unreduced(model: ShaftModel, reason: str = "") -> ReducedShaft:
    return replace(project(model, Basis(np.eye(2 * model.nodes)), "none"), reason=reason)


def _basis(
    model: ShaftModel,
    method: Method,
    masters: NDArray[np.intp] | None,
    half: int,
    tolerance: float,
    max_iterations: int,
) -> Basis:
    """The basis of one plane; `half` its size where `masters` does not decide."""
    mass, stiffness, load = model.plane_mass, model.plane_stiffness, model.plane_gravity
    if method == "craig-bampton":
        interface = default_interface(model) if masters is None else masters
        modes = max(half - 1 - len(interface), 0)
        return craig_bampton(mass, stiffness, interface, modes=modes, load=load)
    kept = default_masters(model, half) if masters is None else masters
    if method == "guyan":
        return guyan(mass, stiffness, kept)
    modes = min(IRS_MODES, half // 4)
    converged = improved_reduced_system(
        mass, model.stiffness_root, kept, modes=modes, tolerance=tolerance, max_iterations=max_iterations
    )
    if method == "irs-plain":
        return converged
    gyroscopic, modes = min(GYROSCOPIC_MODES, modes), min(COMPLEMENT_MODES, int(COMPLEMENT_SHARE * half))
    static = default_masters(model, half - modes - gyroscopic - 1) if masters is None else masters
    return complemented(
        mass,
        stiffness,
        converged,
        static,
        load=load,
        polar=model.plane_polar,
        modes=modes,
        gyroscopic=gyroscopic,
    )


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
    mass, polar = (V.T @ (A @ V) for A in (model.plane_mass, model.plane_polar))
    strain = model.stiffness_root @ V
    M, K = (sl.block_diag(A, A) for A in (symmetric(mass), symmetric(strain.T @ strain)))
    polar, zero = symmetric(polar), np.zeros_like(polar)
    alpha, beta = model.rayleigh
    damping = alpha * M + beta * K
    if model.plane_dampers is not None:
        dampers = symmetric(V.T @ (model.plane_dampers @ V))
        damping = damping + sl.block_diag(dampers, dampers)
    T = np.hstack([plane_x(model.nodes) @ V, plane_y(model.nodes) @ V])
    return ReducedShaft(
        M=M,
        D=damping,
        G=np.block([[zero, polar], [-polar, zero]]),
        K=K,
        T=T,
        bearing=T[model.bearing_dofs.ravel()],
        wheels=T[model.wheel_dofs.ravel()],
        gravity=T.T @ model.gravity,
        method=method,
        history=basis.history,
        foundation=model.foundation,
        trace=model.trace,
    )
