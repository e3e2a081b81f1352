"""Bending moment and normal stress of the unreduced shaft, from the end forces of its elements."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from rotor_fmu.shaft.beam import element_matrices
from rotor_fmu.shaft.matrices import plane_x, plane_y
from rotor_fmu.train.train import Train

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BendingStress:
    """Linear map from displacements to bending moments on both sides of every node.

    The 4 N moments are, N by N: in the x-z plane in front of and behind the nodes, in the y-z plane in
    front of and behind them.  They differ across a node that carries a wheel or a bearing.  Statics are exact
    at the nodes; of the inertia only that within one element is missing.

    Attributes
    ----------
    operator : scipy.sparse.csr_array, (4 N, n)
        moments = operator @ displacements + g weight.  With displacements T x of a reduced shaft
        ``operator @ T`` is small and dense and is to be computed once.
    weight : ndarray, (4 N,)
        Part of the distributed load, per unit of g.
    modulus : ndarray, (2, N)
        Section modulus of the shoulder in front of and behind each node [m3]; infinite where there is none.
    """

    operator: sp.csr_array
    weight: Array
    modulus: Array

    def moments(self, displacement: Array, gravity: float) -> Array:
        """Bending moments.

        Parameters
        ----------
        displacement : ndarray, (n,)
            Of the unreduced shaft, static sag included.
        gravity : float
            g [m/s2], in the direction of the train's gravity.

        Returns
        -------
        ndarray, (4 N,)
            E I times the slope's derivative along z [N m].
        """
        return np.asarray(self.operator @ displacement) + gravity * self.weight

    def stress(self, moments: Array) -> Array:
        """Largest normal stress at the surface of each node.

        Parameters
        ----------
        moments : ndarray, (4 N,)
            As from `moments`.

        Returns
        -------
        ndarray, (N,)
            sqrt(Mx^2 + My^2) / W of the adjacent section where it is larger [Pa].
        """
        x, y = moments.reshape(2, 2, -1)
        return (np.hypot(x, y) / self.modulus).max(axis=0)


def bending_stress(train: Train) -> BendingStress:
    """Prepare the map for a train.

    Parameters
    ----------
    train : Train
        The train.
    """
    nodes = train.nodes
    elements = element_matrices(train.shoulders)
    count = nodes - 1
    columns = 2 * np.arange(count)[:, None] + np.arange(4)
    # An element's end moments act on it: +E I slope' at its rear end, -E I slope' at its front end.
    in_front = _rows(elements.stiffness[:, 3], np.arange(count) + 1, columns, nodes)
    behind = _rows(-elements.stiffness[:, 1], np.arange(count), columns, nodes)
    side = sp.vstack([in_front, behind])
    operator = sp.vstack([side @ plane_x(nodes).T, side @ plane_y(nodes).T])
    weight = np.zeros((4, nodes))
    # In the plane of x, then of y; gravity acts against the unit vector upwards.
    for plane, up in zip((weight[:2], weight[2:]), train.upwards, strict=True):
        plane[0, 1:] = up * elements.weight[:, 3]
        plane[1, :-1] = up * -elements.weight[:, 1]
    modulus = np.full((2, nodes), np.inf)
    modulus[1, :-1], modulus[0, 1:] = zip(*(s.section_moduli for s in train.shoulders), strict=True)
    return BendingStress(sp.csr_array(operator), weight.ravel(), modulus)


def _rows(values: Array, rows: NDArray[np.intp], columns: NDArray[np.intp], nodes: int) -> sp.csr_array:
    where = (np.repeat(rows, 4), columns.ravel())
    return sp.csr_array((values.ravel(), where), shape=(nodes, 2 * nodes))
