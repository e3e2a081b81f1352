"""Assembly of the shaft: M q'' + (D + Ω G) q' + K q = f from a train.

Degrees of freedom: node k, component i of (x, y, tilt_x, tilt_y) at index 4 k + i.
The slopes of the centre line's cross-sections are tilt_y in the x-z plane and
-tilt_x in the y-z plane.  A shaft of circular sections has the same mass and
stiffness in both planes and no coupling between them but the gyroscopic one, so
everything follows from three *plane matrices* in (deflection, slope) a node.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from rotor_fmu.foundation.foundation import Foundation, foundation_of
from rotor_fmu.shaft.beam import element_matrices
from rotor_fmu.shaft.massless import trace_of
from rotor_fmu.train.train import Train

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ShaftModel:
    """The unreduced shaft, N nodes and n = 4 N degrees of freedom.

    Attributes
    ----------
    M, D, G, K : scipy.sparse.csr_array, (n, n)
        Mass, Rayleigh damping, gyroscopic matrix (skew, to be multiplied by the speed) and stiffness.
    plane_mass, plane_stiffness, plane_polar : scipy.sparse.csr_array, (2 N, 2 N)
        The same in one plane, order (deflection, slope) a node; polar inertia of the cross-sections.
    stiffness_root : scipy.sparse.csr_array, (2 N - 2, 2 N), less a row for each hinge
        R with R.T R = plane_stiffness.  Differences of displacements are taken before products: R q is exact
        to rounding where K q of a fine mesh is what large numbers leave over.
    z : ndarray, (N,)
        Axial positions of the nodes [m].
    bearing_dofs : ndarray of int, (n_b, 4)
        Degrees of freedom x, y, tilt_x, tilt_y of the bearings' nodes.
    wheel_dofs : ndarray of int, (n_w, 2)
        Degrees of freedom x, y of the wheels' nodes.
    gravity : ndarray, (n,)
        Consistent gravity load per unit of g, in the direction of the train's gravity [kg, kg m].
    rayleigh : tuple of float
        alpha [1/s] and beta [s].
    plane_gravity : ndarray, (2 N,)
        The same load in the plane in which gravity lies.
    plane_dampers : scipy.sparse.csr_array, (2 N, 2 N), or None
        What elastic couplings, which have dampers of their own, add to the Rayleigh damping of one plane.
    foundation : Foundation or None
        What the bearings stand on, where that moves.
    trace : ndarray, (n,), or None
        Of M what massless places have in place of inertia.
    """

    M: sp.csr_array
    D: sp.csr_array
    G: sp.csr_array
    K: sp.csr_array
    plane_mass: sp.csr_array
    plane_stiffness: sp.csr_array
    plane_polar: sp.csr_array
    stiffness_root: sp.csr_array
    z: Array
    bearing_dofs: NDArray[np.intp]
    wheel_dofs: NDArray[np.intp]
    gravity: Array
    rayleigh: tuple[float, float]
    plane_gravity: Array
    plane_dampers: sp.csr_array | None = None
    foundation: Foundation | None = None
    trace: Array | None = None

    @property
    def nodes(self) -> int:
        """Number of nodes N."""
        return len(self.z)

    @property
    def size(self) -> int:
        """Number of degrees of freedom n = 4 N."""
        return 4 * len(self.z)

    @property
    def plane_damping(self) -> sp.csr_array:
        """Damping in one plane, (2 N, 2 N)."""
        alpha, beta = self.rayleigh
        damping = alpha * self.plane_mass + beta * self.plane_stiffness
        return damping if self.plane_dampers is None else sp.csr_array(damping + self.plane_dampers)


def plane_x(nodes: int) -> sp.csr_array:
    """Full vector from the x-z plane's (x, tilt_y) a node, (4 N, 2 N)."""
    return _plane(nodes, (0, 3), (1.0, 1.0))


def plane_y(nodes: int) -> sp.csr_array:
    """Full vector from the y-z plane's (y, -tilt_x) a node, (4 N, 2 N)."""
    return _plane(nodes, (1, 2), (1.0, -1.0))


def assemble(train: Train) -> ShaftModel:
    """Assemble the matrices of a train.

    Parameters
    ----------
    train : Train
        The train; a shoulder becomes an element, a wheel or lumped mass a rigid disc on its node.

    Returns
    -------
    ShaftModel
        The unreduced shaft.
    """
    nodes = train.nodes
    elements = element_matrices(train.shoulders)
    discs, load = np.zeros((2, 2 * nodes)), np.zeros(2 * nodes)
    for k, weight in enumerate(elements.weight):
        load[2 * k : 2 * k + 4] -= weight
    for body in train.bodies:
        deflection, slope = 2 * body.node, 2 * body.node + 1
        discs[0, deflection] += body.mass
        discs[0, slope] += body.transverse_inertia
        discs[1, slope] += body.polar_inertia
        load[deflection] -= body.mass
    mass = sp.csr_array(_assembled(elements.mass) + sp.diags_array(discs[0]))
    polar = sp.csr_array(_assembled(elements.polar) + sp.diags_array(discs[1]))
    stiffness, dampers = _assembled(elements.stiffness), None
    if elements.joint.any():
        # Rayleigh's damping is that of the shaft's material.
        of_joints = np.where(elements.joint[:, None, None], elements.stiffness, 0.0)
        dampers = _assembled(elements.damping - train.rayleigh_beta * of_joints)
    trace = trace_of(mass, stiffness, train.mass)
    if trace is not None:
        mass = sp.csr_array(mass + sp.diags_array(trace))

    x, y = plane_x(nodes), plane_y(nodes)
    M = _both_planes(mass, x, y)
    K = _both_planes(stiffness, x, y)
    # Angular momentum of the spin, Ip Ω (tilt_y, -tilt_x): its rate opposes the tilting in the other plane.
    G = sp.csr_array(x @ polar @ y.T - y @ polar @ x.T)
    D = sp.csr_array(train.rayleigh_alpha * M + train.rayleigh_beta * K)
    if dampers is not None:
        D = sp.csr_array(D + _both_planes(dampers, x, y))
    root = _assembled(elements.stiffness_root)
    stiff = abs(root).max(axis=1).toarray().ravel() > 0.0  # all rows but those of hinges
    up_x, up_y = train.upwards
    at_bearings = np.array([b.node for b in train.bearings], dtype=np.intp)
    at_wheels = np.array([w.node for w in train.wheels], dtype=np.intp)
    return ShaftModel(
        M=M,
        D=D,
        G=G,
        K=K,
        plane_mass=mass,
        plane_stiffness=stiffness,
        plane_polar=polar,
        stiffness_root=root if stiff.all() else root[stiff],
        z=np.array(train.z),
        bearing_dofs=4 * at_bearings[:, None] + np.arange(4),
        wheel_dofs=4 * at_wheels[:, None] + np.arange(2),
        gravity=up_y * (y @ load) + up_x * (x @ load),
        rayleigh=(train.rayleigh_alpha, train.rayleigh_beta),
        plane_gravity=load,
        plane_dampers=dampers,
        foundation=foundation_of(train),
        trace=None if trace is None else abs(x) @ trace + abs(y) @ trace,
    )


def _plane(nodes: int, components: tuple[int, int], signs: tuple[float, float]) -> sp.csr_array:
    rows = (4 * np.arange(nodes)[:, None] + np.array(components)).ravel()
    values = np.tile(np.array(signs), nodes)
    return sp.csr_array((values, (rows, np.arange(2 * nodes))), shape=(4 * nodes, 2 * nodes))


def _assembled(blocks: Array) -> sp.csr_array:
    """Sum of element blocks (e, r, 4): r rows from row 2 k on, over the displacements of both ends."""
    count, height, _ = blocks.shape
    first = 2 * np.arange(count)[:, None, None]
    rows, columns = (
        np.broadcast_to(first + i, blocks.shape) for i in (np.arange(height)[:, None], np.arange(4))
    )
    where = (rows.ravel(), columns.ravel())
    return sp.csr_array((blocks.ravel(), where), shape=(2 * count - 2 + height, 2 * count + 2))


def _both_planes(matrix: sp.csr_array, x: sp.csr_array, y: sp.csr_array) -> sp.csr_array:
    return sp.csr_array(x @ matrix @ x.T + y @ matrix @ y.T)
