"""Reduction of the shaft by a Ritz basis: IRS, Guyan, Craig-Bampton, or none.

A rotor of circular sections is reduced in one plane and the basis used in both.
The gyroscopic matrix is left out of the basis (it is projected by it).

`irs-plain` is the paper's iterated IRS.  It converges to free-free modal truncation:
free-free frequencies are near exact, but the static flexibility at the bearings suffers.
`irs`, the default, complements its lowest modes by static and gyroscopic ones, at equal size.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
import scipy.linalg as sl
from numpy.typing import NDArray

from rotor_fmu.reduction.irs import complemented, improved_reduced_system
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
        The reduced shaft.

    Raises
    ------
    ValueError
        If the method is unknown or the masters leave a rigid-body motion free.
    ReductionError
        If IRS does not converge within `max_iterations`.
    """
    if method not in METHODS:
        raise ValueError(f"reduction {method!r} is unknown; allowed are {', '.join(METHODS)}")
    mass, stiffness, load = model.plane_mass, model.plane_stiffness, model.plane_gravity
    half = min(size // 2, len(mass))
    if method == "none" or (half == len(mass) and masters is None):
        return project(model, Basis(np.eye(len(mass))), method)
    if method == "craig-bampton":
        interface = default_interface(model) if masters is None else masters
        modes = max(half - 1 - len(interface), 0)
        return project(model, craig_bampton(mass, stiffness, interface, modes=modes, load=load), method)
    kept = default_masters(model, half) if masters is None else masters
    if method == "guyan":
        return project(model, guyan(mass, stiffness, kept), method)
    modes = min(IRS_MODES, half // 4)
    converged = improved_reduced_system(
        mass, stiffness, kept, modes=modes, tolerance=tolerance, max_iterations=max_iterations
    )
    if method == "irs-plain":
        return project(model, converged, method)
    gyroscopic, modes = min(GYROSCOPIC_MODES, modes), min(COMPLEMENT_MODES, int(COMPLEMENT_SHARE * half))
    static = default_masters(model, half - modes - gyroscopic - 1) if masters is None else masters
    basis = complemented(
        mass,
        stiffness,
        converged,
        static,
        load=load,
        polar=model.plane_polar,
        modes=modes,
        gyroscopic=gyroscopic,
    )
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
    M, K = (sl.block_diag(A, A) for A in (symmetric(mass), symmetric(stiffness)))
    polar, zero = symmetric(polar), np.zeros_like(polar)
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
    """Deflection and slope at the bearings, deflections at the ends, then where the gaps are largest.

    The largest gaps are filled at wheels first, then at any node.

    Parameters
    ----------
    model : ShaftModel
        The unreduced shaft.
    count : int
        Degrees of freedom wanted in one plane; more are returned if bearings and ends are more.

    Returns
    -------
    ndarray of int
        Ascending degrees of freedom of one plane.
    """
    chosen = {int(d) for d in default_interface(model)} | {0, 2 * model.nodes - 2}
    wheels = np.unique(model.wheel_dofs[:, 0] // 4)
    for candidates in (wheels, np.arange(model.nodes)):
        while len(chosen) < count:
            occupied = np.array(sorted({d // 2 for d in chosen}))
            distance = np.abs(model.z[candidates, None] - model.z[occupied]).min(axis=1, initial=np.inf)
            if distance.max(initial=0.0) == 0.0:
                break
            chosen.add(2 * int(candidates[distance.argmax()]))
    slopes = (2 * k + 1 for k in range(model.nodes) if 2 * k + 1 not in chosen)
    chosen |= {slope for slope, _ in zip(slopes, range(count - len(chosen)), strict=False)}
    return np.array(sorted(chosen), dtype=np.intp)
